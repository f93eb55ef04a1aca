#include "palpate/ports/system.hpp"
#include "core_setup.hpp"
#include "palpate/ports/console.hpp"
#include "palpate/ports/model_memory.hpp"
#include "registers.hpp"
#include "semihosting.hpp"
#include "startup.hpp"

namespace palpate::port {

void write_console(char character) {
  while ((mps2::ConsoleUart::State::read() & mps2::ConsoleUart::kTransmitFull) != 0) {
  }
  mps2::ConsoleUart::Data::write(static_cast<uint8_t>(character));
}

void initialize_board() {
  mps2::initialize_core();
  cortex_m::trap_mistakes();
  mps2::ConsoleUart::BaudDivider::write(mps2::kPeripheralClockHz / 115'200);
  mps2::ConsoleUart::Control::write(mps2::ConsoleUart::kTransmitEnable);
  mps2::FreeTimer::Reload::write(0xFFFF'FFFF);
  mps2::FreeTimer::Value::write(0xFFFF'FFFF);
  mps2::FreeTimer::Control::write(mps2::FreeTimer::kEnable);
}

// SYS_EXIT_EXTENDED hands a status to the debugger or emulator.
[[noreturn]] void exit_program(int status) {
  constexpr uint32_t kApplicationExit = 0x20026;
  for (;;)
    mps2::semihosting_call(mps2::Semihosting::kExitExtended,
                           {kApplicationExit, static_cast<uint32_t>(status)});
}

ModelMemory model_memory() {
  return {palpate_model_start, static_cast<uint32_t>(palpate_model_end - palpate_model_start)};
}

}  // namespace palpate::port
