// Ticks of a recording from messages of the link.
#pragma once

#include "palpate/link/messages.hpp"
#include "recording/recording_writer.hpp"
#include "recording/row.hpp"

namespace palpate::sim {

struct LinkTick {
  firmware::SettingChange change;
  recording::TickRow row;
};

/// What went into a tick, and what the firmware answered.
inline LinkTick link_tick(const firmware::Sensors& sensors, const link::ActuatorsMessage& answer) {
  recording::TickRow row = recording::row_of(sensors);
  row.motor_codes = answer.motor_codes;
  row.raised = safety::ConditionSet::of_bits(answer.conditions);
  row.flags = answer.flags;
  row.amplifiers_enabled = answer.is_amplifier_enabled[0];
  row.state = static_cast<safety::State>(answer.safety_state);
  row.fault = static_cast<firmware::Fault>(answer.fault);
  return {sensors.report.change, row};
}

/// The tick after so many.
template <class Sink>
void record_after(uint32_t ticks, const LinkTick& tick, recording::RecordingWriter<Sink>& writer) {
  if (tick.change.setting != 0) writer.add(ticks, tick.change);
  writer.add(tick.row);
}

}  // namespace palpate::sim
