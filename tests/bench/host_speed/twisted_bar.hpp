// A bar on its way: 64 x 64 x 192 mm of E = 500 Pa and nu = 0.49, one end held, the other one drawn away by
// a fifth of the length while it is twisted by 90 degrees, and then twisted to and fro by one degree, twice a
// second. So tets are rotated and strained far more than they mostly are in use, and the body swings.
#pragma once

#include "bar.hpp"
#include "model_parameters.hpp"

namespace palpate::bench {

struct BarSetup {
  static constexpr double kFullCorotation = 0.0;

  int level = 6;
  int substeps = 1;
  double density_kg_m3 = 1000.0;
  double theta_deg = kFullCorotation;  // theta_max; kFullCorotation: a rotation of its own for every tet
};

class TwistedBar {
 public:
  explicit TwistedBar(const BarSetup& setup, MakeBar make = make_bar);

  /// 1 ms.
  void tick();
  /// Ticks until it is there and what it shook has calmed down.
  void twist();

  [[nodiscard]] Bar& bar() { return *bar_; }
  [[nodiscard]] const Bar& bar() const { return *bar_; }
  [[nodiscard]] const BarSetup& setup() const { return setup_; }
  [[nodiscard]] const sim::ModelParameters& parameters() const { return parameters_; }
  /// Since start.
  [[nodiscard]] uint32_t ticks() const { return ticks_; }
  /// Of all ticks since twist().
  [[nodiscard]] double mean_rotations() const;

 private:
  BarSetup setup_;
  sim::ModelParameters parameters_;
  std::unique_ptr<Bar> bar_;
  uint32_t ticks_ = 0;
  uint32_t twisted_at_ = 0;
  uint64_t rotations_ = 0;  // summed over the ticks since then
};

/// How the free end has moved by the end of this tick.
RigidMotion end_motion_at(uint32_t tick);

/// The largest distance of two nodes with the same number.
double distance_mm(const reference::Positions& a, const reference::Positions& b);

/// The threshold, of 0.05 to 60 degrees, with which the twisted bar has the number of rotations that is
/// nearest to this one.
double theta_for(uint32_t rotations);

}  // namespace palpate::bench
