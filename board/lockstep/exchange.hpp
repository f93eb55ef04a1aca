// The message that came in last and the one that goes out next: what the ports of a board in lockstep read
// and write.
#pragma once

#include "palpate/link/messages.hpp"

namespace palpate::lockstep {

struct Exchange {
  link::SensorsMessage sensors;
  link::ActuatorsMessage actuators;
};
extern Exchange g_exchange;

}  // namespace palpate::lockstep
