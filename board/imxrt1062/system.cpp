#include "palpate/ports/system.hpp"

#include "core_setup.hpp"
#include "palpate/ports/console.hpp"
#include "palpate/ports/model_memory.hpp"
#include "startup.hpp"
#include "units.hpp"

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
  static_cast<void>(cortex_m::wait_until<imxrt::Console::Status>(imxrt::Console::kTransmitReady,
                                                                 imxrt::Console::kTransmitReady));
  imxrt::Console::Data::write(static_cast<uint8_t>(character));
}

ModelMemory model_memory() {
  return {palpate_model_start, static_cast<uint32_t>(palpate_model_end - palpate_model_start)};
}

// The amplifiers' pins become outputs that are off; until then resistors keep them off.
void initialize_board() {
  const bool runs_at_speed = imxrt::initialize_clocks();
  imxrt::initialize_pins();
  imxrt::start_motor_modulator();
  imxrt::connect_motors();
  cortex_m::disable_branch_cache();
  cortex_m::trap_mistakes();
  cortex_m::start_cycle_counter();
  imxrt::Console::start(imxrt::kConsoleDivider);
  report(runs_at_speed, "clock: the multiplier or the regulator does not start");
  imxrt::Encoder1::start();
  imxrt::Encoder2::start();
  imxrt::Encoder3::start();
  report(imxrt::start_gimbal_converter(), "gimbal: the converter does not start");
  imxrt::Link::start(imxrt::kLinkDivider);
  imxrt::start_link_receiver();
}

}  // namespace palpate::port
