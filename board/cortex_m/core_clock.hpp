// The processor's clock, as the board's start-up has set it.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::cortex_m {

inline uint32_t g_core_hz = 0;

}  // namespace palpate::cortex_m
