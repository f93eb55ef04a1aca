// Every exception that nobody expects: the board says on the console what happened and where, and ends
// with 1.
#include "palpate/ports/console.hpp"
#include "palpate/ports/motors.hpp"
#include "palpate/ports/system.hpp"
#include "startup.hpp"
#include "system_registers.hpp"

namespace palpate::cortex_m {
namespace {

void print(const char* text) {
  for (; *text != '\0'; ++text) port::write_console(*text);
}

void print_hex(const char* name, uint32_t value) {
  print(name);
  for (int shift = 28; shift >= 0; shift -= 4) port::write_console("0123456789abcdef"[(value >> shift) & 15]);
}

const char* exception_name(uint32_t number) {
  switch (number) {
    case 2:
      return "non-maskable interrupt";
    case 3:
      return "hard fault";
    case 4:
      return "memory management fault";
    case 5:
      return "bus fault";
    case 6:
      return "usage fault";
    case 11:
      return "supervisor call";
    default:
      return "unexpected exception";
  }
}

// Why a fault came, by the bits of the configurable fault status register (Armv7-M, B3.2.15).
const char* fault_cause(uint32_t status) {
  if ((status & (1u << 25)) != 0) return "division by zero";
  if ((status & (1u << 24)) != 0) return "unaligned access";
  if ((status & (1u << 19)) != 0) return "no coprocessor";
  if ((status & (7u << 16)) != 0) return "undefined instruction or state";
  // The only protected memory is the guard below the stack; bits 4 and 12 are an exception's frame that had
  // no room.
  if ((status & ((1u << 12) | (1u << 4) | (1u << 1))) != 0) return "stack overflow";
  if ((status & (3u << 9)) != 0) return "bus error on data";
  if ((status & (1u << 8)) != 0) return "bus error on an instruction";
  if ((status & 1u) != 0) return "execution of data";
  return "cause unknown";
}

}  // namespace
}  // namespace palpate::cortex_m

/// The second half of the handler, on its own stack; frame is what the exception stacked, if it could.
extern "C" [[noreturn, gnu::used]] void palpate_report_fault(const uint32_t* frame) {
  namespace port = palpate::port;
  namespace cortex_m = palpate::cortex_m;
  port::write_motors({2048, 2048, 2048});
  port::set_amplifiers(false);
  uint32_t exception = 0;
  asm volatile("mrs %0, ipsr" : "=r"(exception));
  const uint32_t status = cortex_m::ConfigurableFaultStatus::read();
  cortex_m::print("\nfault,");
  cortex_m::print(cortex_m::exception_name(exception));
  cortex_m::print(",");
  cortex_m::print(cortex_m::fault_cause(status));
  cortex_m::print_hex(",exception=", exception);
  cortex_m::print_hex(",cfsr=", status);
  cortex_m::print_hex(",hfsr=", cortex_m::HardFaultStatus::read());
  cortex_m::print_hex(",mmfar=", cortex_m::MemoryFaultAddress::read());
  cortex_m::print_hex(",bfar=", cortex_m::BusFaultAddress::read());
  cortex_m::print_hex(",sp=", static_cast<uint32_t>(reinterpret_cast<uintptr_t>(frame)));
  constexpr uint32_t kFrameWords = 8;
  if (frame >= palpate_stack_low && frame + kFrameWords <= palpate_stack_top) {
    cortex_m::print_hex(",lr=", frame[5]);
    cortex_m::print_hex(",pc=", frame[6]);
  }
  cortex_m::print("\n");
  port::exit_program(1);
}

/// Its own stack: the old one may be full, and what the exception stacked is still to be read.
extern "C" {
alignas(8) std::array<uint32_t, 128> palpate_fault_stack;
}

/// Takes that stack and goes on above.
extern "C" [[gnu::naked]] void palpate_fault_handler() {
  asm volatile(
      "cpsid i\n\t"
      "mov r0, sp\n\t"
      "ldr r1, =palpate_fault_stack + 512\n\t"
      "mov sp, r1\n\t"
      "b palpate_report_fault\n\t"
      ".ltorg");
}
