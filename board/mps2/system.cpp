#include "palpate/ports/system.hpp"
#include "palpate/ports/console.hpp"
#include "registers.hpp"
#include "startup.hpp"

namespace palpate::port {
namespace {

// Unaligned accesses, divisions by zero and a stack that grows out of its memory become faults.
void trap_mistakes() {
  constexpr uint32_t kTrapUnaligned = 1u << 3;
  constexpr uint32_t kTrapDivisionByZero = 1u << 4;
  mps2::ConfigurationControl::write(mps2::ConfigurationControl::read() | kTrapUnaligned |
                                    kTrapDivisionByZero);
  // One region of the memory protection unit: the megabyte below the data memory, no access at all.
  constexpr uint32_t kGuardBase = 0x1FF0'0000;
  constexpr uint32_t kMegabyte = 19u << 1;  // log2(size) - 1, in bits 5 to 1
  constexpr uint32_t kNeverExecute = 1u << 28;
  constexpr uint32_t kEnable = 1u << 0;
  constexpr uint32_t kDefaultMapElsewhere = 1u << 2;
  mps2::MpuRegionNumber::write(0);
  mps2::MpuRegionBase::write(kGuardBase);
  mps2::MpuRegionAttributes::write(kNeverExecute | kMegabyte | kEnable);
  mps2::MpuControl::write(kEnable | kDefaultMapElsewhere);
  mps2::synchronize();
}

}  // namespace

void write_console(char character) {
  while ((mps2::ConsoleUart::State::read() & mps2::ConsoleUart::kTransmitFull) != 0) {
  }
  mps2::ConsoleUart::Data::write(static_cast<uint8_t>(character));
}

void initialize_board() {
  mps2::initialize_core();
  trap_mistakes();
  mps2::ConsoleUart::BaudDivider::write(mps2::kPeripheralClockHz / 115'200);
  mps2::ConsoleUart::Control::write(mps2::ConsoleUart::kTransmitEnable);
  mps2::FreeTimer::Reload::write(0xFFFF'FFFF);
  mps2::FreeTimer::Value::write(0xFFFF'FFFF);
  mps2::FreeTimer::Control::write(mps2::FreeTimer::kEnable);
}

// Semihosting: SYS_EXIT_EXTENDED hands a status to the debugger or emulator.
[[noreturn]] void exit_program(int status) {
  constexpr uint32_t kSysExitExtended = 0x20;
  constexpr uint32_t kApplicationExit = 0x20026;
  const std::array<uint32_t, 2> reason{kApplicationExit, static_cast<uint32_t>(status)};
  for (;;) {
    register uint32_t operation asm("r0") = kSysExitExtended;
    register const uint32_t* parameters asm("r1") = reason.data();
    asm volatile("bkpt 0xAB" : "+r"(operation) : "r"(parameters) : "memory");
  }
}

uint32_t stack_peak_bytes() {
  const uint32_t* word = mps2_stack_low;
  while (word < mps2_stack_top && *word == mps2::kStackPattern) ++word;
  return static_cast<uint32_t>(mps2_stack_top - word) * sizeof(uint32_t);
}

}  // namespace palpate::port
