// Places that the linker script names, and the reset handler's stack pattern.
#pragma once

#include "palpate/numeric/platform.hpp"

extern "C" {
extern uint32_t palpate_stack_low[];
extern uint32_t palpate_stack_top[];
// The code as it is stored, and the memory to copy it to: nothing, where it runs from where it is stored.
extern const uint32_t palpate_code_image[];
extern uint32_t palpate_code_place[];
extern uint32_t palpate_code_place_end[];
extern const uint32_t palpate_data_image[];
extern uint32_t palpate_data_start[];
extern uint32_t palpate_data_end[];
extern uint32_t palpate_bss_start[];
extern uint32_t palpate_bss_end[];
extern const uint8_t palpate_model_start[];
extern const uint8_t palpate_model_end[];
// Below the stack, without any access: its address and size, which is a power of two.
extern uint8_t palpate_guard_start[];
extern uint8_t palpate_guard_size_log2[];
}

namespace palpate::cortex_m {

inline constexpr uint32_t kStackPattern = 0xA5A5'A5A5;

}  // namespace palpate::cortex_m
