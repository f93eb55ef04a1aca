// A recording that is run again does the same, or the replay says where it does not.
#include "recording/replay.hpp"

#include "support/recordings.hpp"

namespace palpate::test {
namespace {

using recording::Mismatch;
using recording::ReplayReport;

ReplayReport replayed(const File& file, uint32_t from_tick = 0) {
  return recording::replay(bytes_of(file), {from_tick}, [](const Mismatch&) { return false; });
}

std::string difference(const ReplayReport& report) {
  if (!report.first) return "none";
  return std::to_string(report.first->tick) + " " + report.first->what;
}

TEST(Replay, DoesTheSame) {
  const File file = recorded_drag(200, {10, 0});
  const ReplayReport report = replayed(file);
  ASSERT_EQ(report.finding.status, ReadStatus::kEnd);
  EXPECT_EQ(difference(report), "none");
  EXPECT_EQ(report.first_tick, 0u);
  EXPECT_EQ(report.last_tick, 442u);
  EXPECT_EQ(report.hash_points, 45u);
  EXPECT_EQ(report.mismatches, 0u);
}

TEST(Replay, DoesTheSameAsAScript) {
  RecordedRun run(false, {50, 0});
  run.is_dragging = true;
  run.run(300);
  EXPECT_EQ(difference(replayed(run.end())), "none");
}

TEST(Replay, BeginsWithTheLastSnapshotBefore) {
  const File file = recorded_drag(200, {10, 100});
  for (const auto& [from, first] : {std::pair{0u, 0u}, {99u, 0u}, {100u, 100u}, {250u, 200u}, {999u, 400u}}) {
    const ReplayReport report = replayed(file, from);
    EXPECT_EQ(report.first_tick, first);
    EXPECT_EQ(report.last_tick, 442u);
    EXPECT_EQ(difference(report), "none") << from;
  }
}

TEST(Replay, BeginsInTheMiddleOfARun) {
  RecordedRun run(false, {50, 0}, 70);
  run.is_dragging = true;
  run.run(100);
  const ReplayReport report = replayed(run.end());
  ASSERT_EQ(report.finding.status, ReadStatus::kEnd);
  EXPECT_EQ(report.first_tick, 70u);
  EXPECT_EQ(report.last_tick, 170u);
  EXPECT_EQ(difference(report), "none");
}

TEST(Replay, RunsWhatIsBeforeACut) {
  const File file = recorded_drag(200, {10, 0});
  const File cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(file.size() / 2));
  const ReplayReport report = replayed(cut);
  EXPECT_EQ(report.finding.status, ReadStatus::kCut);
  EXPECT_GT(report.last_tick, 150u);
  EXPECT_EQ(difference(report), "none");
}

TEST(Replay, RefusesADamagedFileBeforeTheFirstTick) {
  File file = recorded_drag(200, {10, 0});
  file[file.size() - 30] ^= 1;
  const ReplayReport report = replayed(file);
  EXPECT_FALSE(report.is_usable());
  EXPECT_EQ(report.last_tick, 0u);
  EXPECT_EQ(report.hash_points, 0u);
}

/// One bit of what a hash point says of a stage: that stage is named.
TEST(Replay, NamesTheStageThatDiffers) {
  const File file = recorded_drag(50, {20, 0});
  for (uint32_t stage = 0; stage < firmware::kStageCount; ++stage) {
    auto chunks = chunks_of_recording(file);
    chunks[find_chunk(chunks, "HASH", 2)].payload[8 + 8 * stage] ^= 1;
    const ReplayReport report = replayed(recording_of(chunks));
    const char* name = firmware::stage_name(static_cast<firmware::Stage>(stage));
    EXPECT_EQ(difference(report), std::string("60 stage ") + name);
  }
  auto chunks = chunks_of_recording(file);
  chunks[find_chunk(chunks, "HASH", 2)].payload[8 + 8 * firmware::kStageCount] ^= 1;
  EXPECT_EQ(difference(replayed(recording_of(chunks))), "60 state");
}

struct Change {
  std::size_t offset;  // in the row
  uint8_t flip;
  const char* what;
};

/// What came out of a tick, changed in its row.
TEST(Replay, NamesWhatCameOutOtherwise) {
  const File file = recorded_drag(50);
  const Change changes[] = {{28, 1, "flags"},        {38, 1, "motor code 1"},
                            {42, 1, "motor code 3"}, {44, 1, "raised conditions"},
                            {49, 1, "amplifiers"},   {50, 1, "state of the safety layer"},
                            {51, 1, "fault"}};
  for (const Change& change : changes) {
    auto chunks = chunks_of_recording(file);
    Written& rows = chunks[find_chunk(chunks, "TICK")];
    rows.payload[8 + recording::kRowBytes * 70 + change.offset] ^= change.flip;
    EXPECT_EQ(difference(replayed(recording_of(chunks))), std::string("71 ") + change.what);
  }
}

/// A single count of one joint in one tick.
TEST(Replay, FindsAChangedInput) {
  auto chunks = chunks_of_recording(recorded_drag(50, {1, 0}));
  // With hashes every tick a row is a chunk.
  chunks[find_chunk(chunks, "TICK", 69)].payload[8] ^= 1;
  EXPECT_EQ(difference(replayed(recording_of(chunks))), "70 stage kinematics");
}

/// A change that is not made again is missed: nothing else of the recording is another.
TEST(Replay, NeedsTheChangesOfSettings) {
  RecordedRun run(true, {0, 0});
  run.enable();
  run.change({1, safety::ramp_step(64).raw()});
  run.is_dragging = true;
  run.run(150);
  auto chunks = chunks_of_recording(run.end());
  EXPECT_EQ(difference(replayed(recording_of(chunks))), "none");
  chunks.erase(chunks.begin() + static_cast<std::ptrdiff_t>(find_chunk(chunks, "CHNG")));
  EXPECT_NE(difference(replayed(recording_of(chunks))), "none");
}

TEST(Replay, GoesOnWhenItIsAskedTo) {
  auto chunks = chunks_of_recording(recorded_drag(50, {20, 0}));
  for (const std::size_t n : {1u, 3u}) chunks[find_chunk(chunks, "HASH", n)].payload[8] ^= 1;
  const File file = recording_of(chunks);
  std::vector<uint32_t> ticks;
  const ReplayReport report = recording::replay(bytes_of(file), {}, [&ticks](const Mismatch& mismatch) {
    ticks.push_back(mismatch.tick);
    return true;
  });
  EXPECT_EQ(ticks, (std::vector<uint32_t>{40, 80}));
  EXPECT_EQ(report.mismatches, 2u);
  EXPECT_EQ(report.last_tick, 142u);
}

TEST(Replay, RefusesASnapshotOfAnotherLayout) {
  auto chunks = chunks_of_recording(recorded_drag(50, {20, 60}));
  chunks[find_chunk(chunks, "SNAP")].payload[8] ^= 1;
  const File file = recording_of(chunks);
  EXPECT_EQ(difference(replayed(file)), "none");
  const ReplayReport report = replayed(file, 60);
  EXPECT_FALSE(report.is_usable());
  EXPECT_STREQ(report.finding.field, "layout");
}

}  // namespace
}  // namespace palpate::test
