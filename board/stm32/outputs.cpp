#include "outputs.hpp"
#include "amplifier_watchdog.hpp"
#include "chip.hpp"
#include "palpate/ports/indicator.hpp"
#include "palpate/ports/motors.hpp"
#include "palpate/ports/watchdog.hpp"

namespace palpate::stm32 {

device::AmplifierWatchdog g_amplifier_watchdog;

}  // namespace palpate::stm32

namespace palpate::port {

using stm32::AmplifierPort;
using stm32::MotorModulator;

// The three codes hold from the modulator's next period on. When that begins between two writes, one code
// comes a period later than the others: 0.02 ms.
void write_motors(const std::array<uint16_t, 3>& codes) {
  MotorModulator::Compare1::write(codes[0]);
  MotorModulator::Compare2::write(codes[1]);
  MotorModulator::Compare3::write(codes[2]);
}

void set_amplifiers(bool enabled) {
  AmplifierPort::SetReset::write(stm32::level_of(stm32::kEnablePins, enabled));
}

void show(const Indication& indication) {
  stm32::LampPort::SetReset::write(stm32::level_of(stm32::Lamp::kMask, indication.is_torque_possible));
}

void feed_watchdogs() {
  const bool level = stm32::g_amplifier_watchdog.toggle();
  AmplifierPort::SetReset::write(stm32::level_of(stm32::WatchdogLine::kMask, level));
  stm32::Watchdog::Key::write(stm32::Watchdog::kFeed);
}

// Its period was set when the board was initialized: the first feeding loads it.
void start_watchdog() {
  stm32::Watchdog::Key::write(stm32::Watchdog::kStart);
  stm32::Watchdog::Key::write(stm32::Watchdog::kFeed);
}

}  // namespace palpate::port
