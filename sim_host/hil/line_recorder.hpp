// A recording of a device on a bench, from what its firmware tells over the link (docs/wire-protocol.md): all
// that entered each tick, and what came of it.
//
// It begins with the firmware's first tick after a start, since only from there a run can be had again. Rows
// wait until the telemetry's tick number says that none is missing before them; when one is, the recording
// ends before the gap.
#pragma once

#include <optional>
#include <vector>

#include "hil/link_rows.hpp"
#include "palpate/link/telemetry_messages.hpp"
#include "palpate/telemetry/sensors_message.hpp"

namespace palpate::sim {

template <class Sink>
class LineRecorder {
 public:
  enum class Phase { kWaiting, kRecording, kEnded };

  LineRecorder(Sink& sink, const recording::Start& start) : writer_(sink) { writer_.begin(start); }

  void push(const link::Frame& frame) {
    if (phase_ == Phase::kEnded) return;
    link::SensorsMessage sensors{};
    link::InputsMessage inputs{};
    link::ActuatorsMessage actuators{};
    link::TelemetryMessage telemetry{};
    if (link::decode(frame, sensors) == link::DecodeStatus::kDone) {
      sensors_ = sensors;
      inputs_.reset();
    } else if (link::decode(frame, inputs) == link::DecodeStatus::kDone) {
      inputs_ = inputs;
    } else if (link::decode(frame, actuators) == link::DecodeStatus::kDone) {
      add(actuators);
    } else if (link::decode(frame, telemetry) == link::DecodeStatus::kDone) {
      confirm(telemetry.tick);
    }
  }
  /// No tick more. The last ones, which no telemetry has confirmed, are left out.
  [[nodiscard]] container::WriteStatus end() { return writer_.end(); }

  [[nodiscard]] Phase phase() const { return phase_; }
  /// In the recording.
  [[nodiscard]] uint32_t ticks() const { return confirmed_; }

 private:
  void add(const link::ActuatorsMessage& actuators) {
    // Where one of them is lost, a tick will be missing.
    if (!sensors_ || sensors_->tick != actuators.tick || actuators.watchdog_level != inputs_.has_value())
      return;
    firmware::Sensors sensors = telemetry::sensors_of(*sensors_, {});
    firmware::DeviceReport& report = sensors.report;
    report.timing.message_number = inputs_ ? inputs_->message_number : last_message_ + 1;
    if (inputs_) {
      report.timing.is_late = inputs_->is_late;
      report.requests = safety::EventSet::of_bits(inputs_->requests);
      report.reported |= safety::ConditionSet::of_bits(inputs_->findings);
      if (!inputs_->is_refused) report.change = {inputs_->setting, inputs_->value};
    }
    last_message_ = report.timing.message_number;
    sensors_.reset();
    if (phase_ == Phase::kWaiting) waiting_.clear();
    waiting_.push_back(link_tick(sensors, actuators));
  }
  void confirm(uint32_t tick) {
    if (phase_ == Phase::kWaiting) {
      if (tick != 1 || waiting_.empty()) return;
      phase_ = Phase::kRecording;
    }
    if (tick != confirmed_ + waiting_.size()) {
      phase_ = Phase::kEnded;
      return;
    }
    for (const LinkTick& one : waiting_) record_after(confirmed_++, one, writer_);
    waiting_.clear();
  }

  recording::RecordingWriter<Sink> writer_;
  Phase phase_ = Phase::kWaiting;
  std::optional<link::SensorsMessage> sensors_;  // of the tick whose actuators are to come
  std::optional<link::InputsMessage> inputs_;
  uint32_t last_message_ = 0;
  std::vector<LinkTick> waiting_;
  uint32_t confirmed_ = 0;
};

}  // namespace palpate::sim
