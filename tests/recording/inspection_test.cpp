#include "recording/inspection.hpp"

#include <nlohmann/json.hpp>

#include "support/recordings.hpp"

namespace palpate::test {
namespace {

using recording::Inspection;

const File& drag() {
  static const File file = recorded_drag(200, {20, 100});
  return file;
}

TEST(Inspection, CountsWhatIsThere) {
  const Inspection inspection = recording::inspect(bytes_of(drag()));
  ASSERT_TRUE(inspection.is_usable());
  EXPECT_FALSE(inspection.is_cut());
  EXPECT_EQ(inspection.ticks, 442u);
  EXPECT_EQ(inspection.first_tick, 0u);
  EXPECT_EQ(inspection.hash_points, 23u);
  EXPECT_EQ(inspection.snapshots, 4u);
  EXPECT_EQ(inspection.change_count, 1u);
  EXPECT_EQ(inspection.lost_ticks, 0u);
  EXPECT_EQ(inspection.mute_ticks, 0u);
  EXPECT_EQ(inspection.counts[0].least, -400);
  EXPECT_EQ(inspection.counts[0].most, 0);
  EXPECT_EQ(inspection.counts[1].most, 1);
  EXPECT_NE(inspection.peak_codes[0].code, 2048);
  EXPECT_GT(inspection.torque_ticks, 400u);
  EXPECT_NE(inspection.flags & static_cast<uint32_t>(TickFlag::kGrasping), 0u);
}

/// Each change of state with the tick that made it, and why.
TEST(Inspection, TellsTheStatesAndTheirCauses) {
  const Inspection inspection = recording::inspect(bytes_of(drag()));
  std::string told;
  for (const recording::StateChange& change : inspection.state_changes) {
    told.append(std::to_string(change.tick)).append(" ").append(safety::state_name(change.to));
    told.append(" by ").append(change.cause).append("\n");
  }
  EXPECT_EQ(told,
            "1 SelfTest by boot_done\n"
            "2 Uncalibrated by self_test_passed\n"
            "4 Calibrating by calibration_started\n"
            "5 Idle by calibration_done\n"
            "6 Ramping by enable\n"
            "25 Active by ramp_done\n"
            "437 Fault by emergency_stop\n");
  ASSERT_EQ(inspection.conditions.size(), 1u);
  EXPECT_EQ(inspection.conditions[0].condition, safety::Condition::kEmergencyStop);
  EXPECT_EQ(inspection.conditions[0].first_tick, 437u);
}

TEST(Inspection, CountsLostAndLateTicks) {
  auto chunks = chunks_of_recording(drag());
  File& rows = chunks[find_chunk(chunks, "TICK", 1)].payload;
  const auto row = [&rows](std::size_t i) { return rows.data() + 8 + recording::kRowBytes * i; };
  // The timer skips 3 numbers and is back a tick later; two messages are the one before; one is late.
  container::put_u32(row(4) + 12, container::get_u32(row(4) + 12) + 3);
  for (const std::size_t i : {7u, 8u}) container::put_u32(row(i) + 16, container::get_u32(row(6) + 16));
  row(9)[48] = 1;
  const File file = recording_of(chunks);
  const Inspection inspection = recording::inspect(bytes_of(file));
  EXPECT_EQ(inspection.lost_ticks, 3u);
  EXPECT_EQ(inspection.mute_ticks, 2u);
  EXPECT_EQ(inspection.late_ticks, 1u);
}

TEST(Inspection, SaysThatItIsCutAndWhere) {
  const File cut(drag().begin(), drag().begin() + static_cast<std::ptrdiff_t>(drag().size() - 1));
  const Inspection inspection = recording::inspect(bytes_of(cut));
  ASSERT_TRUE(inspection.is_usable());
  EXPECT_TRUE(inspection.is_cut());
  EXPECT_EQ(inspection.ticks, 442u);
  const std::string place = std::to_string(inspection.finding.offset);
  EXPECT_NE(recording::inspection_text(inspection).find("cut off at byte " + place), std::string::npos);
}

TEST(Inspection, OfADamagedFileIsNotUsable) {
  File damaged = drag();
  damaged[damaged.size() / 2] ^= 1;
  EXPECT_FALSE(recording::inspect(bytes_of(damaged)).is_usable());
  EXPECT_FALSE(recording::inspect(Bytes{damaged.data(), 100}).is_usable());
}

TEST(Inspection, HasItsFiguresInTextAndJson) {
  const Inspection inspection = recording::inspect(bytes_of(drag()));
  const std::string text = recording::inspection_text(inspection);
  for (const char* part :
       {"drag: 442 ticks, 0.442 s, whole", "profile        small", "tick 6: Idle -> Ramping by enable",
        "emergency_stop in ", "on: max force = 7", "joint 1        counts -400 to 0",
        "hashes of 23 ticks, 4 snapshots", "ends in        Fault, fault 0"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
  const auto json = nlohmann::json::parse(recording::inspection_json(inspection));
  EXPECT_EQ(json["ticks"], 442);
  EXPECT_EQ(json["profile"], "small");
  EXPECT_EQ(json["is_cut"], false);
  EXPECT_EQ(json["state_changes"].size(), 7u);
  EXPECT_EQ(json["state_changes"][6]["cause"], "emergency_stop");
  EXPECT_EQ(json["changes"][0]["setting"], "max force");
  EXPECT_EQ(json["joints"][0]["least_counts"], -400);
}

/// As many bins as fit, without losing the ends of a spike.
TEST(Inspection, ThinsItsCurvesWithoutLosingSpikes) {
  RecordedRun run(false, {0, 0});
  run.run(2500);
  auto chunks = chunks_of_recording(run.end());
  // One row of the 14th chunk shows another count.
  File& rows = chunks[find_chunk(chunks, "TICK", 13)].payload;
  container::put_u32(rows.data() + 8 + std::size_t{57} * recording::kRowBytes, 12345);
  const File file = recording_of(chunks);
  const Inspection inspection = recording::inspect(bytes_of(file));
  const recording::Curves curves = recording::read_curves(bytes_of(file), inspection);
  EXPECT_EQ(curves.time_s.size(), 834u);  // of 3 ticks each
  ASSERT_EQ(curves.counts[0].size(), curves.time_s.size());
  ASSERT_EQ(curves.state.size(), curves.time_s.size());
  const std::size_t bin = 1357 / 3;
  EXPECT_EQ(curves.counts[0][bin].most, 12345);
  EXPECT_EQ(curves.counts[0][bin].least, 0);
  EXPECT_NEAR(curves.time_s[bin], 1e-3 * (3.0 * static_cast<double>(bin) + 1.0), 1e-9);
  EXPECT_EQ(inspection.counts[0].most, 12345);
}

}  // namespace
}  // namespace palpate::test
