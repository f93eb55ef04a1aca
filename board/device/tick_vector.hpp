// The exception of the tick.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::cortex_m {

inline constexpr uint32_t kTickVector = 15;  // SysTick

}  // namespace palpate::cortex_m
