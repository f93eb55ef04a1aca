// A hand on the handle: a mass that moves with the tip, and a spring with a damper from the tip to where the
// hand means to be. With P the tip and A the intention:   F = k (A - P) + b (A' - P') - m P'' + tremor
#pragma once

#include "plant/figure.hpp"
#include "plant/intention.hpp"
#include "plant/noise.hpp"
#include "plant/tip_load.hpp"

namespace palpate::plant {

inline constexpr Figure kHandMass{"hand mass", 0.1, "kg", Mark::kAssumed, "a light grip of the fingers"};
inline constexpr Figure kHandStiffness{"hand stiffness", 300.0, "N/m", Mark::kAssumed,
                                       "a light grip of the fingers"};
inline constexpr Figure kHandDamping{"hand damping", 5.0, "N s/m", Mark::kAssumed,
                                     "a light grip of the fingers"};

/// A random force, first-order low pass of white noise, each axis its own.
struct Tremor {
  double rms = 0.0;         ///< N on each axis; 0: none
  double bandwidth = 10.0;  ///< Hz
  uint64_t seed = 1;
};

struct HandParameters {
  double mass = kHandMass.value;            ///< m, kg
  double stiffness = kHandStiffness.value;  ///< k, N/m
  double damping = kHandDamping.value;      ///< b, N s/m
  Tremor tremor;
};

/// Where it does not hold, it is not there: no mass, no force, and no button pressed.
class Hand {
 public:
  Hand(const HandParameters& parameters, Intention intention);

  /// Draws the tremor of the next tick of so many seconds.
  void begin_tick(double seconds);
  /// For the substep that starts at `time`, s.
  [[nodiscard]] TipLoad load(double time) const;
  [[nodiscard]] uint16_t buttons(double time) const;
  [[nodiscard]] const HandParameters& parameters() const { return parameters_; }

 private:
  HandParameters parameters_;
  Intention intention_;
  Noise noise_;
  Eigen::Vector3d tremor_ = Eigen::Vector3d::Zero();
};

}  // namespace palpate::plant
