// The firmware's cycle in this process. It does with a message what the firmware's tick does with its ports.
#pragma once

#include <functional>

#include "compiled_stages.hpp"
#include "hil/controller.hpp"

namespace palpate::sim {

template <class Profile, class Probe>
class HostController final : public Controller {
 public:
  HostController(firmware::CycleState<Profile>& state, Probe& probe) : state_(state), probe_(probe) {}

  /// Sees what each cycle was fed with, after it.
  std::function<void(const firmware::Sensors&)> on_cycle = [](const firmware::Sensors&) {};

  link::ActuatorsMessage answer(const link::SensorsMessage& sensors, const UserWish& wish) override {
    firmware::Actuators actuators{};
    const firmware::Sensors read = sensors_of(sensors, wish);
    firmware::cycle(state_, read, actuators, probe_);
    on_cycle(read);
    watchdog_level_ = !watchdog_level_;
    const bool on = actuators.amplifiers_enabled;
    return {sensors.tick,
            actuators.motor_codes,
            {on, on, on},
            watchdog_level_,
            static_cast<uint8_t>(state_.fault),
            static_cast<uint8_t>(state_.safety.state),
            static_cast<uint16_t>(state_.safety.raised.bits()),
            state_.output.flags};
  }

 private:
  firmware::CycleState<Profile>& state_;
  Probe& probe_;
  bool watchdog_level_ = false;
};

}  // namespace palpate::sim
