// Port: what the board shows of the device's condition.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

struct Indication {
  uint8_t safety_state;     // safety::State
  uint8_t fault;            // firmware::Fault; 0: none
  uint16_t conditions;      // raised now, bit n is safety::Condition n
  uint32_t flags;           // TickFlag bits of the tick
  bool is_torque_possible;  // the amplifiers are on
};

/// Shows it, as the board can: a lamp that is on while torque is possible is the least.
///
/// Called by: the cycle, once a tick, after set_amplifiers. Bounded by: straight-line code, at most 1
/// device-register access. Never waits.
void show(const Indication& indication);

}  // namespace palpate::port
