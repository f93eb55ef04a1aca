// Who answers the device's sensors: a firmware, wherever it runs.
#pragma once

#include "palpate/link/messages.hpp"
#include "palpate/safety/event.hpp"

namespace palpate::sim {

class Controller {
 public:
  Controller() = default;
  Controller(const Controller&) = delete;
  Controller(Controller&&) = delete;
  Controller& operator=(const Controller&) = delete;
  Controller& operator=(Controller&&) = delete;
  virtual ~Controller() = default;

  /// One tick. `requests`: what its user asks for in it.
  virtual link::ActuatorsMessage answer(const link::SensorsMessage& sensors, safety::EventSet requests) = 0;
};

}  // namespace palpate::sim
