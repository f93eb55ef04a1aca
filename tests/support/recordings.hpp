// Runs of a small device that are recorded into memory.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "compiled_stages.hpp"
#include "model_parameters.hpp"
#include "recording/recording_reader.hpp"
#include "recording/run_recorder.hpp"
#include "support/containers.hpp"

namespace palpate::test {

/// A bar whose mesh changes, and a tool that takes hold of it wherever it is.
inline firmware::CycleModel dragged_bar() {
  sim::ModelParameters parameters;
  parameters.level = 2;
  parameters.substeps = 1;
  parameters.regions[0].density_kg_m3 = 1000.0;
  parameters.regions[0].least_level = 2;
  parameters.regions[0].most_level = 4;
  parameters.grasp_reach_m = 0.25;
  return {compile_model(parameters), compile_scene({}, parameters)};
}

inline safety::Parameters quick_ramp() {
  safety::Parameters parameters;
  parameters.ramp.step_per_tick = safety::ramp_step(16);
  return parameters;
}

/// Drags the bar by turning the turret, and reports as a board does.
class RecordedRun {
 public:
  using Recorder = recording::RunRecorder<Small, MemorySink>;

  /// `before`: ticks that are not recorded.
  explicit RecordedRun(bool is_guarded, recording::Pace pace = {}, uint32_t before = 0) {
    EXPECT_EQ(firmware::start(*state_, dragged_bar()), Status::kDone);
    const bool is_usable = !is_guarded || firmware::guard_device(*state_, quick_ramp());
    EXPECT_TRUE(is_usable);
    const recording::Start start = recording::start_of(*state_, "drag", is_guarded);
    for (uint32_t i = 0; i < before; ++i) cycle({}, {});
    recorder_ = std::make_unique<Recorder>(sink_, *state_, start, pace);
  }

  void tick(safety::EventSet requests = {}, safety::ConditionSet reported = {}) {
    cycle(requests, reported);
    recorder_->note(sensors_);
  }
  void tick(safety::Event request) { tick(safety::EventSet::of(request)); }
  /// In the next tick.
  void change(const firmware::SettingChange& change) { change_ = change; }
  void run(uint32_t ticks) {
    for (uint32_t i = 0; i < ticks; ++i) tick();
  }
  /// Through self-test and calibration to where the ramp begins.
  void enable() {
    run(3);
    for (const auto event :
         {safety::Event::kCalibrationStarted, safety::Event::kCalibrationDone, safety::Event::kEnable}) {
      tick(event);
    }
  }
  [[nodiscard]] Recorder& recorder() { return *recorder_; }
  [[nodiscard]] const firmware::CycleState<Small>& state() const { return *state_; }
  /// What has been written so far, and with end the rest.
  [[nodiscard]] const File& file() const { return sink_.file; }
  [[nodiscard]] const File& end() {
    EXPECT_EQ(recorder_->end(), WriteStatus::kDone);
    return sink_.file;
  }

  bool is_dragging = false;

 private:
  void cycle(safety::EventSet requests, safety::ConditionSet reported) {
    ++number_;
    if (is_dragging && turned_ < 400) turned_ += 2;
    sensors_.encoder_counts = {-turned_, static_cast<int32_t>(number_ % 2), 0};
    sensors_.grasp_button = is_dragging;
    sensors_.gimbal = {2048, static_cast<uint16_t>(number_ % 4096), 1};
    sensors_.report = {{number_, number_, false}, reported, requests, std::exchange(change_, {})};
    firmware::Actuators actuators{};
    firmware::NoProbe probe;
    firmware::cycle(*state_, sensors_, actuators, probe);
  }

  std::unique_ptr<firmware::CycleState<Small>> state_ = std::make_unique<firmware::CycleState<Small>>();
  MemorySink sink_;
  std::unique_ptr<Recorder> recorder_;
  firmware::Sensors sensors_{};
  firmware::SettingChange change_{};
  uint32_t number_ = 0;
  int32_t turned_ = 0;
};

/// Active, dragged, a threshold changed, stopped: `ticks` of it.
inline File recorded_drag(uint32_t ticks, recording::Pace pace = {}) {
  RecordedRun run(true, pace);
  run.enable();
  run.run(30);
  run.is_dragging = true;
  run.run(ticks);
  run.change({4, phantom::Newton::ratio(7, 1).raw()});
  run.run(ticks);
  run.tick({}, safety::ConditionSet::of(safety::Condition::kEmergencyStop));
  run.run(5);
  return run.end();
}

/// All that a reader gives, as chunks that tests can change and write again.
inline std::vector<Written> chunks_of_recording(const File& file) {
  std::vector<Written> chunks;
  for (const Chunk& chunk : read_all(file, Kind::kRecording).chunks) chunks.push_back(as_written(chunk));
  return chunks;
}
inline File recording_of(const std::vector<Written>& chunks) { return file_of(Kind::kRecording, chunks); }

/// The place of the n-th chunk with this tag.
inline std::size_t find_chunk(const std::vector<Written>& chunks, const char (&tag)[5], std::size_t n = 0) {
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    if (chunks[i].tag == Tag::of(tag) && n-- == 0) return i;
  }
  ADD_FAILURE() << "no chunk " << tag;
  return 0;
}

/// Remembers everything.
class Listener final : public recording::Visitor {
 public:
  struct Change {
    uint32_t tick;
    firmware::SettingChange change;
  };
  void see_row(uint32_t tick, const recording::TickRow& row) override {
    ticks.push_back(tick);
    rows.push_back(row);
  }
  void see_hashes(const recording::HashPoint& point) override { hashes.push_back(point); }
  void see_change(uint32_t tick, const firmware::SettingChange& change) override {
    changes.push_back({tick, change});
  }
  void see_snapshot(const recording::SnapshotPart& part) override {
    parts.push_back(part);
    if (part.offset == 0) snapshot.clear();
    snapshot.insert(snapshot.end(), part.bytes.data, part.bytes.data + part.bytes.size);
  }

  std::vector<uint32_t> ticks;
  std::vector<recording::TickRow> rows;
  std::vector<recording::HashPoint> hashes;
  std::vector<Change> changes;
  std::vector<recording::SnapshotPart> parts;  // without their bytes once the file is gone
  File snapshot;                               // bytes of the last one
};

struct Heard {
  recording::Start start;
  Listener listener;
  Finding finding = Finding::nothing();
  bool has_start = false;

  [[nodiscard]] bool is_usable() const {
    return has_start && container::is_usable(Kind::kRecording, finding.status);
  }
};

inline std::unique_ptr<Heard> heard(const File& file) {
  auto result = std::make_unique<Heard>();
  recording::RecordingReader reader(bytes_of(file));
  result->finding = reader.open(result->start);
  result->has_start = result->finding.is_done();
  if (result->has_start) result->finding = reader.read(result->listener);
  return result;
}

}  // namespace palpate::test
