// The PHANToM Premium 1.5 seen from the desk: where the joints must be for a tool position, and what the
// encoders then read. Doubles; the figures are those of hal/phantom. Source: Cavusoglu, Feygin, Tendick 2002.
#pragma once

#include <array>
#include <optional>

#include "palpate/firmware/scenario_image.hpp"

namespace palpate::sim {

struct JointAnglesRad {
  double q1, q2, q3;  // turret; absolute angles of the two links
};

/// Device frame in metres: x forward, y left, z up. Nothing when the links do not reach.
std::optional<JointAnglesRad> inverse_kinematics(const std::array<double, 3>& position_m);
std::array<double, 3> forward_kinematics(const JointAnglesRad& angles);

/// How far the nearest joint limit is; negative beyond it.
double margin_to_limits_deg(const JointAnglesRad& angles);

/// Encoder counts with the device's directions, not yet rounded.
std::array<double, 3> encoder_counts(const JointAnglesRad& angles);

}  // namespace palpate::sim
