// Places that the linker script names, and the reset handler's stack pattern.
#pragma once

#include "palpate/numeric/platform.hpp"

extern "C" {
extern uint32_t mps2_stack_low[];
extern uint32_t mps2_stack_top[];
extern const uint32_t mps2_data_image[];
extern uint32_t mps2_data_start[];
extern uint32_t mps2_data_end[];
extern uint32_t mps2_bss_start[];
extern uint32_t mps2_bss_end[];
}

namespace palpate::mps2 {

inline constexpr uint32_t kStackPattern = 0xA5A5'A5A5;

}  // namespace palpate::mps2
