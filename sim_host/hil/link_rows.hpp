// Rows of a recording from messages of the link.
#pragma once

#include "palpate/link/messages.hpp"
#include "recording/row.hpp"

namespace palpate::sim {

/// What went into a tick, and what the firmware answered.
inline recording::TickRow row_of(const firmware::Sensors& sensors, const link::ActuatorsMessage& answer) {
  recording::TickRow row = recording::row_of(sensors);
  row.motor_codes = answer.motor_codes;
  row.raised = safety::ConditionSet::of_bits(answer.conditions);
  row.flags = answer.flags;
  row.amplifiers_enabled = answer.is_amplifier_enabled[0];
  row.state = static_cast<safety::State>(answer.safety_state);
  row.fault = static_cast<firmware::Fault>(answer.fault);
  return row;
}

}  // namespace palpate::sim
