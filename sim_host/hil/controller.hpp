// Who answers the device's sensors: a firmware, wherever it runs.
#pragma once

#include "palpate/telemetry/sensors_message.hpp"

namespace palpate::sim {

/// What the user of a device wants in a tick.
struct UserWish {
  safety::EventSet requests;
  firmware::SettingChange change{0, 0};

  [[nodiscard]] bool is_nothing() const { return requests.bits() == 0 && change.setting == 0; }
};

/// What enters the cycle.
inline firmware::Sensors sensors_of(const link::SensorsMessage& message, const UserWish& wish) {
  firmware::Sensors sensors = telemetry::sensors_of(message, wish.requests);
  sensors.report.change = wish.change;
  return sensors;
}

class Controller {
 public:
  Controller() = default;
  Controller(const Controller&) = delete;
  Controller(Controller&&) = delete;
  Controller& operator=(const Controller&) = delete;
  Controller& operator=(Controller&&) = delete;
  virtual ~Controller() = default;

  /// One tick.
  virtual link::ActuatorsMessage answer(const link::SensorsMessage& sensors, const UserWish& wish) = 0;
};

}  // namespace palpate::sim
