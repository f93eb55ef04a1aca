// A device on a bench, recorded from what its firmware tells, and had again.
#include "hil/line_recorder.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "hil/closed_loop.hpp"
#include "hil/host_controller.hpp"
#include "hil/touch_task.hpp"
#include "palpate/telemetry/frame_source.hpp"
#include "palpate/tick/profiles.hpp"
#include "recording/replay.hpp"
#include "simulation/capacity.hpp"

namespace palpate::sim {
namespace {

/// The frames that the firmware of a board sends, tick by tick, while a hand uses its device.
class Board {
 public:
  Board() : scenario_(built_in_scenario("touch")), source_(telemetry::Tells::kDevice) {
    scenario_.profile = "small";
    scenario_.model.level = 2;
    complete_scenario(scenario_);
    fit_to_profile(scenario_);
    restart();
  }
  [[nodiscard]] recording::Start start() const { return recording::start_of(*state_, "device", true); }
  /// From power on.
  void restart() {
    EXPECT_EQ(firmware::start(*state_, cycle_model(scenario_)), Status::kDone);
    EXPECT_TRUE(firmware::guard_device(*state_, safety::kPremium15Parameters));
    plant_.emplace(touch_plant(scenario_));
    controller_.emplace(*state_, probe_);
    loop_.emplace(*plant_, *controller_);
    controller_->on_cycle = [this](const firmware::Sensors& read) { tell(read); };
    source_ = telemetry::FrameSource(telemetry::Tells::kDevice);
  }
  std::vector<link::Frame> tick() {
    frames_.clear();
    loop_->advance();
    return frames_;
  }

 private:
  void tell(const firmware::Sensors& read) {
    telemetry::TickRecord* record = ring_.claim();
    ASSERT_NE(record, nullptr);
    telemetry::fill_record(*record, read, *state_, {}, 0);
    ring_.publish();
    link::WireFrame wire{};
    while (source_.next(ring_, {}, writer_, wire)) {
      for (const uint8_t byte : wire) {
        if (reader_.push(byte)) frames_.push_back(reader_.frame());
      }
    }
  }

  Scenario scenario_;
  std::unique_ptr<firmware::CycleState<Small>> state_ = std::make_unique<firmware::CycleState<Small>>();
  firmware::NoProbe probe_;
  std::optional<plant::Plant> plant_;
  std::optional<HostController<Small, firmware::NoProbe>> controller_;
  std::optional<ClosedLoop> loop_;
  telemetry::Ring<telemetry::TickRecord, 4> ring_;
  telemetry::FrameSource source_;
  link::FrameWriter writer_;
  link::FrameReader reader_;
  std::vector<link::Frame> frames_;
};

struct Sink {
  std::vector<uint8_t> bytes;
  bool operator()(const uint8_t* from, uint32_t count) {
    bytes.insert(bytes.end(), from, from + count);
    return true;
  }
};

uint32_t replayed_ticks(const Sink& sink) {
  const container::Bytes file{sink.bytes.data(), static_cast<uint32_t>(sink.bytes.size())};
  const recording::ReplayReport report = recording::replay(file, {}, [](const recording::Mismatch& mismatch) {
    ADD_FAILURE() << "tick " << mismatch.tick << ", " << mismatch.what << ": " << mismatch.recorded << ", "
                  << mismatch.computed;
    return false;
  });
  EXPECT_EQ(report.finding.status, container::ReadStatus::kEnd);
  return report.last_tick;
}

TEST(LineRecorder, RecordsWhatCanBeHadAgain) {
  Board board;
  Sink sink;
  LineRecorder recorder(sink, board.start());
  for (int tick = 0; tick < 3001; ++tick) {
    for (const link::Frame& frame : board.tick()) recorder.push(frame);
  }
  EXPECT_EQ(recorder.ticks(), 3001u);
  EXPECT_EQ(recorder.end(), container::WriteStatus::kDone);
  EXPECT_EQ(replayed_ticks(sink), 3001u);
}

/// Who comes late waits for the next start.
TEST(LineRecorder, BeginsWithTheFirmware) {
  Board board;
  Sink sink;
  LineRecorder recorder(sink, board.start());
  for (int tick = 0; tick < 50; ++tick) (void)board.tick();
  for (int tick = 0; tick < 50; ++tick) {
    for (const link::Frame& frame : board.tick()) recorder.push(frame);
  }
  EXPECT_EQ(recorder.phase(), decltype(recorder)::Phase::kWaiting);
  board.restart();
  for (int tick = 0; tick < 201; ++tick) {
    for (const link::Frame& frame : board.tick()) recorder.push(frame);
  }
  EXPECT_EQ(recorder.end(), container::WriteStatus::kDone);
  EXPECT_EQ(recorder.ticks(), 201u);
  EXPECT_EQ(replayed_ticks(sink), 201u);
}

/// A frame that is lost ends the recording before its tick: what is in it can be had again.
TEST(LineRecorder, EndsBeforeATickThatIsMissing) {
  using link::MessageType;
  const auto ticks_of = [](MessageType lost, int at) {
    Board board;
    Sink sink;
    LineRecorder recorder(sink, board.start());
    for (int tick = 0; tick < 300; ++tick) {
      for (const link::Frame& frame : board.tick()) {
        if (tick != at || frame.type != lost) recorder.push(frame);
      }
    }
    EXPECT_EQ(recorder.phase(), decltype(recorder)::Phase::kEnded);
    EXPECT_EQ(recorder.end(), container::WriteStatus::kDone);
    EXPECT_EQ(replayed_ticks(sink), recorder.ticks());
    return recorder.ticks();
  };
  EXPECT_EQ(ticks_of(MessageType::kSensors, 157), 151u);
  EXPECT_EQ(ticks_of(MessageType::kActuators, 157), 151u);
  EXPECT_EQ(ticks_of(MessageType::kInputs, 3), 1u);  // the request for calibration
}

}  // namespace
}  // namespace palpate::sim
