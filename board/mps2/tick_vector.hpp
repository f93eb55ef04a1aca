// The interrupt of the tick.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::cortex_m {

inline constexpr uint32_t kTickInterrupt = 8;  // timer 0
inline constexpr uint32_t kTickVector = 16 + kTickInterrupt;

}  // namespace palpate::cortex_m
