#pragma once

namespace palpate::plant {

/// From 0 to 1 with least jerk: speed and acceleration are 0 at both ends (Flash and Hogan 1985). t in 0
/// .. 1.
inline double smooth_step(double t) { return t * t * t * (10.0 + t * (6.0 * t - 15.0)); }

/// Its derivative.
inline double smooth_step_rate(double t) { return 30.0 * t * t * (1.0 - t) * (1.0 - t); }

}  // namespace palpate::plant
