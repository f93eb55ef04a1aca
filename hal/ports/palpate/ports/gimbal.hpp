// Port: the three potentiometers of the stylus gimbal.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

/// The converters' raw codes, 12 bits, in the device's joint order; 2048 where there is no gimbal. The force
/// does not depend on them: they are recorded and sent on.
///
/// Called by: the cycle, once a tick, after read_encoders.
/// Bounded by: straight-line code, at most 3 device-register accesses. Never waits: it takes what the
/// converters finished last.
std::array<uint32_t, 3> read_gimbal();

}  // namespace palpate::port
