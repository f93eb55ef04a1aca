// A device on a bench, recorded from what its firmware tells, and had again.
#include "hil/line_recorder.hpp"

#include <gtest/gtest.h>

#include "recording/inspection.hpp"
#include "telling_board.hpp"

namespace palpate::sim {
namespace {

struct Sink {
  std::vector<uint8_t> bytes;
  bool operator()(const uint8_t* from, uint32_t count) {
    bytes.insert(bytes.end(), from, from + count);
    return true;
  }
  [[nodiscard]] container::Bytes file() const { return {bytes.data(), static_cast<uint32_t>(bytes.size())}; }
};

TEST(LineRecorder, RecordsWhatCanBeHadAgain) {
  TellingBoard board;
  Sink sink;
  LineRecorder recorder(sink, board.start());
  for (int tick = 0; tick < 3001; ++tick) {
    for (const link::Frame& frame : board.tick()) recorder.push(frame);
  }
  EXPECT_EQ(recorder.ticks(), 3001u);
  EXPECT_EQ(recorder.end(), container::WriteStatus::kDone);
  EXPECT_EQ(replayed_ticks(sink.file()), 3001u);
}

/// A change that the firmware refuses is none.
TEST(LineRecorder, RecordsChangesOfSettings) {
  TellingBoard board;
  board.plan({{150, {1, safety::ramp_step(64).raw()}}, {151, {4, -1}}});
  Sink sink;
  LineRecorder recorder(sink, board.start());
  for (int tick = 0; tick < 301; ++tick) {
    for (const link::Frame& frame : board.tick()) recorder.push(frame);
  }
  EXPECT_EQ(recorder.end(), container::WriteStatus::kDone);
  EXPECT_EQ(replayed_ticks(sink.file()), 301u);
  const recording::Inspection inspection = recording::inspect(sink.file());
  ASSERT_EQ(inspection.changes.size(), 1u);
  EXPECT_EQ(inspection.changes[0].tick, 149u);
  EXPECT_EQ(inspection.changes[0].change.setting, 1u);
}

/// Who comes late waits for the next start.
TEST(LineRecorder, BeginsWithTheFirmware) {
  TellingBoard board;
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
  EXPECT_EQ(replayed_ticks(sink.file()), 201u);
}

/// A frame that is lost ends the recording before its tick: what is in it can be had again.
TEST(LineRecorder, EndsBeforeATickThatIsMissing) {
  using link::MessageType;
  const auto ticks_of = [](MessageType lost, int at) {
    TellingBoard board;
    Sink sink;
    LineRecorder recorder(sink, board.start());
    for (int tick = 0; tick < 300; ++tick) {
      for (const link::Frame& frame : board.tick()) {
        if (tick != at || frame.type != lost) recorder.push(frame);
      }
    }
    EXPECT_EQ(recorder.phase(), decltype(recorder)::Phase::kEnded);
    EXPECT_EQ(recorder.end(), container::WriteStatus::kDone);
    EXPECT_EQ(replayed_ticks(sink.file()), recorder.ticks());
    return recorder.ticks();
  };
  EXPECT_EQ(ticks_of(MessageType::kSensors, 157), 151u);
  EXPECT_EQ(ticks_of(MessageType::kActuators, 157), 151u);
  EXPECT_EQ(ticks_of(MessageType::kInputs, 3), 1u);  // the request for calibration
}

}  // namespace
}  // namespace palpate::sim
