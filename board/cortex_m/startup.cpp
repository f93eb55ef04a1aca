// Reset handler and vector table. No constructor runs: the linker script refuses an .init_array.
#include "startup.hpp"

#include "palpate/ports/system.hpp"
#include "system_registers.hpp"
#include "tick_vector.hpp"

extern "C" {

extern const uint32_t palpate_vectors[];
void palpate_tick_handler();
void palpate_fault_handler();
[[noreturn]] void palpate_reset_handler();

// Fills the free part of the stack with the pattern, then copies and clears. Nothing is initialized yet, so
// it uses no static object, and no function that may have to be copied first.
[[noreturn, gnu::section(".boot_code"), gnu::used]] void palpate_reset_handler() {
  const auto* const frame = static_cast<const uint32_t*>(__builtin_frame_address(0));
  constexpr uint32_t kOwnWords = 16;
  for (uint32_t* word = palpate_stack_low; word + kOwnWords < frame; ++word)
    *word = palpate::cortex_m::kStackPattern;
  const uint32_t* code = palpate_code_image;
  for (uint32_t* word = palpate_code_place; word < palpate_code_place_end; ++word) *word = *code++;
  const uint32_t* image = palpate_data_image;
  for (uint32_t* word = palpate_data_start; word < palpate_data_end; ++word) *word = *image++;
  for (uint32_t* word = palpate_bss_start; word < palpate_bss_end; ++word) *word = 0;
  palpate::cortex_m::VectorTableOffset::write(reinterpret_cast<uintptr_t>(palpate_vectors));
  palpate::port::run_firmware();
}

}  // extern "C"

namespace palpate::cortex_m {
namespace {

using Handler = void (*)();
// The stack pointer and exceptions 1 to 15, and no more device interrupts than up to the tick's: no other one
// is ever enabled.
constexpr uint32_t kVectors = kTickVector < 16 ? 16 : kTickVector + 1;

struct VectorTable {
  uint32_t* stack_top;
  std::array<Handler, kVectors - 1> handlers;
};

constexpr VectorTable make_vector_table() {
  VectorTable table{palpate_stack_top, {}};
  for (Handler& handler : table.handlers) handler = palpate_fault_handler;
  table.handlers[0] = palpate_reset_handler;
  table.handlers[kTickVector - 1] = palpate_tick_handler;
  return table;
}

[[gnu::used, gnu::section(".vectors")]] constexpr VectorTable kTable = make_vector_table();

}  // namespace
}  // namespace palpate::cortex_m
