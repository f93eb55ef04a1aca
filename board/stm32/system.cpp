#include "palpate/ports/system.hpp"
#include "chip.hpp"
#include "core_setup.hpp"
#include "link.hpp"
#include "palpate/ports/console.hpp"
#include "palpate/ports/model_memory.hpp"
#include "setup.hpp"
#include "startup.hpp"

namespace palpate::port {
namespace {

void report(bool is_fine, const char* what) {
  if (is_fine) return;
  for (const char* text : {"board,", what, "\n"}) {
    for (; *text != '\0'; ++text) write_console(*text);
  }
}

}  // namespace

// The console's line takes a character within 25 us. Where it never does, characters are dropped.
void write_console(char character) {
  static_cast<void>(cortex_m::wait_until<stm32::Console::Status>(stm32::Console::kTransmitReady,
                                                                 stm32::Console::kTransmitReady));
  stm32::Console::TransmitData::write(static_cast<uint8_t>(character));
}

ModelMemory model_memory() {
  return {palpate_model_start, static_cast<uint32_t>(palpate_model_end - palpate_model_start)};
}

// The amplifiers' pins become outputs that are off; until then resistors keep them off.
void initialize_board() {
  stm32::enable_units();
  stm32::initialize_pins();
  const bool runs_at_speed = stm32::initialize_clocks();
  stm32::MotorModulator::make_modulator(2048);
  stm32::connect_motors();
  stm32::initialize_core();
  cortex_m::trap_mistakes();
  cortex_m::start_cycle_counter();
  stm32::Console::start((stm32::g_console_clock_hz + stm32::kConsoleBaud / 2) / stm32::kConsoleBaud);
  report(runs_at_speed, "clock: the crystal or the multiplier does not start");
  report(stm32::Watchdog::start_clock() && stm32::Watchdog::set_ten_milliseconds(), "watchdog: no clock");
  stm32::Encoder1::make_decoder();
  stm32::Encoder2::make_decoder();
  stm32::Encoder3::make_decoder();
  report(stm32::start_gimbal_converter(), "gimbal: the converter does not start");
  stm32::Link::start((stm32::g_link_clock_hz + stm32::kLinkBaud / 2) / stm32::kLinkBaud);
  stm32::start_link_receiver();
}

}  // namespace palpate::port
