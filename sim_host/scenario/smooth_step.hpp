#pragma once

namespace palpate::sim {

/// From 0 to 1 with least jerk: speed and acceleration are 0 at both ends (Flash and Hogan 1985). t in 0
/// .. 1.
inline double smooth_step(double t) { return t * t * t * (10.0 + t * (6.0 * t - 15.0)); }

}  // namespace palpate::sim
