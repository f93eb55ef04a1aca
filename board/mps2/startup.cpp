// Reset handler and vector table. No constructor runs: the linker script refuses an .init_array.
#include "startup.hpp"

#include "palpate/ports/system.hpp"

extern "C" {

void palpate_tick_handler();
void palpate_fault_handler();
[[noreturn]] void palpate_reset_handler();

// Fills the free part of the stack with the pattern, then copies and clears. Nothing is initialized yet, so
// it uses no static object and no function.
[[noreturn]] void palpate_reset_handler() {
  const auto* const frame = static_cast<const uint32_t*>(__builtin_frame_address(0));
  constexpr uint32_t kOwnWords = 16;
  for (uint32_t* word = mps2_stack_low; word + kOwnWords < frame; ++word)
    *word = palpate::mps2::kStackPattern;
  const uint32_t* image = mps2_data_image;
  for (uint32_t* word = mps2_data_start; word < mps2_data_end; ++word) *word = *image++;
  for (uint32_t* word = mps2_bss_start; word < mps2_bss_end; ++word) *word = 0;
  palpate::port::run_firmware();
}

}  // extern "C"

namespace palpate::mps2 {
namespace {

using Handler = void (*)();
constexpr uint32_t kSystemVectors = 16;  // the stack pointer and exceptions 1 to 15
constexpr uint32_t kDeviceVectors = 32;
constexpr uint32_t kTickVector = kSystemVectors + 8;

struct VectorTable {
  uint32_t* stack_top;
  std::array<Handler, kSystemVectors + kDeviceVectors - 1> handlers;
};

constexpr VectorTable make_vector_table() {
  VectorTable table{mps2_stack_top, {}};
  for (Handler& handler : table.handlers) handler = palpate_fault_handler;
  table.handlers[0] = palpate_reset_handler;
  table.handlers[kTickVector - 1] = palpate_tick_handler;
  return table;
}

[[gnu::used, gnu::section(".vectors")]] constexpr VectorTable kVectors = make_vector_table();

}  // namespace
}  // namespace palpate::mps2
