// Makes frames of the records in a ring, in the background, one frame a call: as fast as the line takes them.
//
//   every record               telemetry
//   every kMotorsEvery-th      also stage cycles, in two parts, and motors
//   every kCountersEvery-th    also counters
//
// Of a device that the link itself does not carry (Tells::kDevice) a recorder gets all that enters a tick and
// comes of it, and telemetry makes room for it:
//
//   every record               sensors and actuators; inputs, where the record before does not imply them
//   every kTelemetryEvery-th   telemetry
#pragma once

#include "palpate/link/frame_reader.hpp"
#include "palpate/link/frame_writer.hpp"
#include "palpate/link/telemetry_messages.hpp"
#include "palpate/telemetry/sensors_message.hpp"
#include "palpate/telemetry/tick_record.hpp"

namespace palpate::telemetry {

enum class Tells : uint8_t { kBody, kDevice };

inline constexpr uint32_t kTelemetryEvery = 10;
inline constexpr uint32_t kMotorsEvery = 10;
inline constexpr uint32_t kCountersEvery = 100;

namespace wire {

/// value x per_unit, rounded; beyond 16 bits it saturates.
template <class Integer, int I, int F>
constexpr Integer scaled(Q<I, F> value, int32_t per_unit) {
  constexpr int64_t kLeast = std::numeric_limits<Integer>::min();
  constexpr int64_t kMost = std::numeric_limits<Integer>::max();
  const int64_t units = shift_right_rounded(int64_t{value.raw()} * per_unit, F);
  return static_cast<Integer>(units < kLeast ? kLeast : units > kMost ? kMost : units);
}
template <class Integer, int I, int F>
constexpr std::array<Integer, 3> scaled(const std::array<Q<I, F>, 3>& values, int32_t per_unit) {
  return {scaled<Integer>(values[0], per_unit), scaled<Integer>(values[1], per_unit),
          scaled<Integer>(values[2], per_unit)};
}

inline link::TelemetryMessage telemetry(const TickRecord& record) {
  static_assert(link::kHighestState + 1 == safety::kStateCount, "palpate: the wire has every state");
  static_assert(safety::kConditionCount <= 16, "palpate: the wire has 16 conditions");
  return {record.tick,
          static_cast<uint8_t>(record.state),
          static_cast<uint8_t>(record.fault),
          static_cast<uint16_t>(record.raised.bits()),
          scaled<int16_t>(record.tool, 50000),
          scaled<int16_t>(record.force, 1000),
          record.flags};
}

inline link::StageCyclesMessage stage_cycles(const TickRecord& record, uint8_t part) {
  static_assert(link::kStageParts * link::kStagesInPart == firmware::kStageCount,
                "palpate: the wire has every stage");
  link::StageCyclesMessage message{record.tick, part, {}};
  for (const uint32_t i : bounded<link::kStagesInPart>(link::kStagesInPart, [] {})) {
    message.cycles[i] = record.stage_cycles[part * link::kStagesInPart + i];
  }
  return message;
}

inline link::MotorsMessage motors(const TickRecord& record) {
  return {record.tick, record.motor_codes, record.amplifiers_enabled, scaled<int16_t>(record.winding, 100),
          scaled<uint16_t>(record.current_limit, 1000)};
}

/// What others than the device report.
constexpr safety::ConditionSet findings(const firmware::DeviceReport& report) {
  return report.reported.without(safety::kDeviceReports);
}

constexpr link::InputsMessage inputs(const TickRecord& record) {
  const firmware::DeviceReport& report = record.sensors.report;
  return {report.timing.tick_number, report.timing.message_number, report.requests.bits(),
          findings(report).bits(),   report.timing.is_late,        record.is_setting_refused,
          report.change.setting,     report.change.value};
}

/// `has_inputs`: what stands for the watchdog's level, which nobody here has.
inline link::ActuatorsMessage actuators(const TickRecord& record, bool has_inputs) {
  const bool on = record.amplifiers_enabled;
  return {record.sensors.report.timing.tick_number,
          record.motor_codes,
          {on, on, on},
          has_inputs,
          static_cast<uint8_t>(record.fault),
          static_cast<uint8_t>(record.state),
          static_cast<uint16_t>(record.raised.bits()),
          record.flags};
}

inline link::CountersMessage counters(const TickRecord& record, uint32_t dropped_records,
                                      const link::ReaderCounters& reader) {
  const uint32_t rejected_frames =
      reader.bad_lengths + reader.crc_failures + reader.bad_blocks + reader.bad_versions + reader.bad_types;
  return {record.tick,     dropped_records,    record.overruns,
          rejected_frames, reader.lost_frames, reader.discarded_bytes};
}

}  // namespace wire

class FrameSource {
 public:
  explicit FrameSource(Tells tells) : tells_(tells) {}

  /// False: nothing to send now. `reader`: of the commands, 0 without any. `writer` numbers all frames of
  /// this sender.
  template <uint32_t Capacity>
  [[nodiscard]] bool next(Ring<TickRecord, Capacity>& ring, const link::ReaderCounters& reader,
                          link::FrameWriter& writer, link::WireFrame& frame) {
    if (due_ == 0 && !take(ring)) return false;
    const auto write = [&writer, &frame](const auto& message) {
      writer.write(message.kType, link::encode(message), frame);
    };
    if (is_due(kSensors)) {
      write(message_of(record_.sensors));
    } else if (is_due(kInputs)) {
      write(wire::inputs(record_));
    } else if (is_due(kActuators)) {
      write(wire::actuators(record_, has_inputs_));
    } else if (is_due(kTelemetry)) {
      write(wire::telemetry(record_));
    } else if (is_due(kFirstStages)) {
      write(wire::stage_cycles(record_, 0));
    } else if (is_due(kLastStages)) {
      write(wire::stage_cycles(record_, 1));
    } else if (is_due(kMotors)) {
      write(wire::motors(record_));
    } else {
      write(wire::counters(record_, ring.dropped(), reader));
    }
    due_ &= due_ - 1;
    return true;
  }

 private:
  // Frames of one record, in this order.
  static constexpr uint32_t kSensors = 1, kInputs = 2, kActuators = 4, kTelemetry = 8, kFirstStages = 16,
                            kLastStages = 32, kMotors = 64, kCounters = 128;

  [[nodiscard]] bool is_due(uint32_t frame) const { return (due_ & frame) != 0; }

  /// The first record has all frames.
  template <uint32_t Capacity>
  bool take(Ring<TickRecord, Capacity>& ring) {
    const TickRecord* record = ring.oldest();
    if (record == nullptr) return false;
    const safety::TimingReport before = record_.sensors.report.timing;
    record_ = *record;
    ring.release();
    has_inputs_ = tells_ == Tells::kDevice && !follows(before);
    if (tells_ == Tells::kDevice) due_ |= kSensors | kActuators | (has_inputs_ ? kInputs : 0);
    if (tells_ == Tells::kBody || to_telemetry_ == 0) due_ |= kTelemetry;
    if (to_motors_ == 0) due_ |= kFirstStages | kLastStages | kMotors;
    if (to_counters_ == 0) due_ |= kCounters;
    to_telemetry_ = (to_telemetry_ == 0 ? kTelemetryEvery : to_telemetry_) - 1;
    to_motors_ = (to_motors_ == 0 ? kMotorsEvery : to_motors_) - 1;
    to_counters_ = (to_counters_ == 0 ? kCountersEvery : to_counters_) - 1;
    return true;
  }

  /// Whether a recorder knows the record's inputs without being told.
  [[nodiscard]] bool follows(const safety::TimingReport& before) const {
    const firmware::DeviceReport& report = record_.sensors.report;
    const safety::TimingReport& now = report.timing;
    return now.tick_number == before.tick_number + 1 && now.message_number == before.message_number + 1 &&
           !now.is_late && report.requests.bits() == 0 && report.change.setting == 0 &&
           wire::findings(report).is_empty();
  }

  Tells tells_;
  TickRecord record_{};
  uint32_t due_ = 0;  // of record_
  bool has_inputs_ = false;
  uint32_t to_telemetry_ = 0;
  uint32_t to_motors_ = 0;
  uint32_t to_counters_ = 0;
};

}  // namespace palpate::telemetry
