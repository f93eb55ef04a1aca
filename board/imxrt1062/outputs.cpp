#include "outputs.hpp"

#include "palpate/ports/indicator.hpp"
#include "palpate/ports/motors.hpp"
#include "palpate/ports/watchdog.hpp"
#include "units.hpp"

namespace palpate::imxrt {

device::AmplifierWatchdog g_amplifier_watchdog;

}  // namespace palpate::imxrt

namespace palpate::port {

using imxrt::AmplifierPort;

// The last write makes all three hold from the next period on. It was taken back by the modulator within a
// period of the last tick, so that the values can be written.
void write_motors(const std::array<uint16_t, 3>& codes) {
  imxrt::Motor1::Fall::write(codes[0]);
  imxrt::Motor2::Fall::write(codes[1]);
  imxrt::Motor3::Fall::write(codes[2]);
  imxrt::MotorModulator::MasterControl::write(imxrt::MotorModulator::kLoad);
}

void set_amplifiers(bool enabled) {
  if (enabled) {
    AmplifierPort::Set::write(imxrt::kEnablePins);
  } else {
    AmplifierPort::Clear::write(imxrt::kEnablePins);
  }
}

void show(const Indication& indication) {
  if (indication.is_torque_possible) {
    AmplifierPort::Set::write(imxrt::kLamp);
  } else {
    AmplifierPort::Clear::write(imxrt::kLamp);
  }
}

void feed_watchdogs() {
  static_cast<void>(imxrt::g_amplifier_watchdog.toggle());
  AmplifierPort::Toggle::write(imxrt::kWatchdogLine);
  imxrt::Watchdog::Counter::write(imxrt::Watchdog::kFeed);
}

// 328 periods of 32.768 kHz: 10 ms. After the first write there are 128 bus clocks for the others.
void start_watchdog() {
  // CMD32EN, CLK = 01: the slow oscillator, EN. UPDATE, bit 5, is 0: until reset nothing changes it again.
  constexpr uint32_t kSettings = (1u << 13) | (1u << 8) | (1u << 7);
  imxrt::Watchdog::Counter::write(imxrt::Watchdog::kUnlock);
  imxrt::Watchdog::Timeout::write(328);
  imxrt::Watchdog::Control::write(kSettings);
}

}  // namespace palpate::port
