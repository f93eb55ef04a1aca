// What a hand means to do: where it wants the tip over time, when it holds the handle, which buttons it
// presses.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace palpate::plant {

/// Of `buttons`.
inline constexpr uint16_t kGraspButton = 1;

/// A moment of an intention; position in the device's frame, m. `holds` and `buttons` last until the next
/// one.
struct Knot {
  double time;  ///< s
  Eigen::Vector3d position;
  bool holds = true;
  uint16_t buttons = 0;  ///< one bit each, as hal/ports' read_buttons
};

struct Intent {
  Eigen::Vector3d position;  ///< m
  Eigen::Vector3d velocity;  ///< m/s
  bool holds;
  uint16_t buttons;
};

class Intention {
 public:
  /// At rest at each knot, with least jerk between them. One knot or more, times rising.
  static Intention scripted(std::vector<Knot> knots);
  /// Samples of a recording, times rising, joined smoothly: cubic Hermite pieces whose slope at a sample is
  /// that of the chord between its neighbours (Catmull and Rom). Two samples or more.
  static Intention recorded(std::vector<Knot> samples);

  /// Before the first knot and after the last one: at that knot, at rest.
  [[nodiscard]] Intent at(double time) const;

 private:
  enum class Join { kLeastJerk, kHermite };
  Intention(std::vector<Knot> knots, Join join);
  [[nodiscard]] Eigen::Vector3d slope(std::size_t index) const;

  std::vector<Knot> knots_;
  Join join_;
};

}  // namespace palpate::plant
