// What is recorded comes back as it was.
#include "recording/mapped_file.hpp"
#include "recording/snapshot.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/recordings.hpp"

namespace palpate::test {
namespace {

using recording::HashPoint;
using recording::TickRow;

bool is_same(const TickRow& a, const TickRow& b) {
  return a.encoder_counts == b.encoder_counts && a.timing.tick_number == b.timing.tick_number &&
         a.timing.message_number == b.timing.message_number && a.timing.is_late == b.timing.is_late &&
         a.requests.bits() == b.requests.bits() && a.reported == b.reported && a.gimbal == b.gimbal &&
         a.buttons == b.buttons && a.device_status == b.device_status && a.motor_codes == b.motor_codes &&
         a.raised == b.raised && a.flags == b.flags && a.amplifiers_enabled == b.amplifiers_enabled &&
         a.state == b.state && a.fault == b.fault;
}

template <class Integer>
Integer any(Random& random) {
  return static_cast<Integer>(random.bits() >> 32);
}

TickRow random_row(Random& random) {
  TickRow row{};
  for (int32_t& counts : row.encoder_counts) counts = any<int32_t>(random);
  row.timing = {any<uint32_t>(random), any<uint32_t>(random), random.below(2) == 1};
  row.requests = safety::EventSet::of_bits(any<uint32_t>(random));
  row.reported = safety::ConditionSet::of_bits(any<uint32_t>(random));
  for (uint16_t& code : row.gimbal) code = any<uint16_t>(random);
  row.buttons = any<uint8_t>(random);
  row.device_status = static_cast<uint8_t>(random.below(8));
  for (uint16_t& code : row.motor_codes) code = static_cast<uint16_t>(random.below(4096));
  row.raised = safety::ConditionSet::of_bits(any<uint32_t>(random));
  row.flags = any<uint32_t>(random);
  row.amplifiers_enabled = random.below(2) == 1;
  row.state = static_cast<safety::State>(random.below(safety::kStateCount));
  row.fault = static_cast<firmware::Fault>(random.below(4));
  return row;
}

recording::Start sample_start() {
  safety::Parameters parameters = quick_ramp();
  parameters.ignored = safety::ConditionSet::of(safety::Condition::kEncoderStuck);
  return {Small::kName, "some run", sample_model(), true, parameters};
}

/// Any number of rows, and whatever stands between them.
TEST(Recording, GivesBackRowsAndWhatStandsBetween) {
  Random random(51);
  for (uint32_t round = 0; round < 100; ++round) {
    MemorySink sink;
    recording::RecordingWriter<MemorySink> writer(sink);
    writer.begin(sample_start());
    std::vector<TickRow> rows;
    std::vector<HashPoint> hashes;
    std::vector<Listener::Change> changes;
    const auto ticks = [&rows] { return static_cast<uint32_t>(rows.size()); };
    for (uint32_t step = random.below(40); step > 0; --step) {
      for (uint32_t i = random.below(random.below(5) == 0 ? 250 : 4); i > 0; --i) {
        rows.push_back(random_row(random));
        writer.add(rows.back());
      }
      if (random.below(2) == 0) {
        HashPoint point{ticks(), {}, random.bits()};
        for (uint64_t& hash : point.stages) hash = random.bits();
        hashes.push_back(point);
        writer.add(point);
      }
      if (random.below(3) == 0) {
        changes.push_back({ticks(), {static_cast<uint16_t>(1 + random.below(24)), any<int32_t>(random)}});
        writer.add(ticks(), changes.back().change);
      }
    }
    ASSERT_EQ(writer.end(), WriteStatus::kDone);
    const auto read = heard(sink.file);
    ASSERT_EQ(read->finding.status, ReadStatus::kEnd);
    const Listener& listener = read->listener;
    ASSERT_EQ(listener.rows.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ASSERT_TRUE(is_same(listener.rows[i], rows[i])) << i;
      ASSERT_EQ(listener.ticks[i], i + 1);
    }
    ASSERT_EQ(listener.hashes.size(), hashes.size());
    for (std::size_t i = 0; i < hashes.size(); ++i) {
      ASSERT_EQ(listener.hashes[i].tick, hashes[i].tick);
      ASSERT_EQ(listener.hashes[i].stages, hashes[i].stages);
      ASSERT_EQ(listener.hashes[i].state, hashes[i].state);
    }
    ASSERT_EQ(listener.changes.size(), changes.size());
    for (std::size_t i = 0; i < changes.size(); ++i) {
      ASSERT_EQ(listener.changes[i].tick, changes[i].tick);
      ASSERT_EQ(listener.changes[i].change.setting, changes[i].change.setting);
      ASSERT_EQ(listener.changes[i].change.value, changes[i].change.value);
    }
  }
}

TEST(Recording, GivesBackHowTheRunBegan) {
  const recording::Start written = sample_start();
  MemorySink sink;
  recording::RecordingWriter<MemorySink> writer(sink);
  writer.begin(written);
  ASSERT_EQ(writer.end(), WriteStatus::kDone);
  const auto read = heard(sink.file);
  ASSERT_EQ(read->finding.status, ReadStatus::kEnd);
  EXPECT_EQ(read->start.profile, "small");
  EXPECT_EQ(read->start.scenario, "some run");
  EXPECT_TRUE(read->start.is_guarded);
  expect_same(read->start.model, written.model);
  MemorySink again;
  recording::RecordingWriter<MemorySink> rewriter(again);
  rewriter.begin(read->start);
  ASSERT_EQ(rewriter.end(), WriteStatus::kDone);
  EXPECT_EQ(again.file, sink.file);
}

/// The recorder's rows are what went into the cycle and what came out of it.
TEST(Recording, HasWhatTheCycleSaw) {
  const File file = recorded_drag(50);
  const auto read = heard(file);
  ASSERT_EQ(read->finding.status, ReadStatus::kEnd);
  const auto& rows = read->listener.rows;
  ASSERT_EQ(rows.size(), 3 + 3 + 30 + 100 + 6u);
  EXPECT_EQ(rows[0].state, safety::State::kSelfTest);
  EXPECT_TRUE(rows[5].requests.has(safety::Event::kEnable));
  EXPECT_EQ(rows[100].encoder_counts[0], -2 * 65);
  EXPECT_EQ(rows[100].buttons, 1);
  EXPECT_EQ(rows[100].gimbal[1], 101);
  EXPECT_EQ(rows[100].timing.message_number, 101u);
  EXPECT_TRUE(rows[100].amplifiers_enabled);
  EXPECT_NE(rows[100].motor_codes[0], 2048);
  EXPECT_EQ(rows[136].device_status, 1);
  EXPECT_EQ(rows[137].device_status, 0);
  EXPECT_EQ(rows[136].state, safety::State::kFault);
  ASSERT_EQ(read->listener.changes.size(), 1u);
  EXPECT_EQ(read->listener.changes[0].tick, 86u);
}

TEST(Recording, GivesBackASnapshotByteByByte) {
  RecordedRun run(true, {0, 40});
  run.enable();
  run.is_dragging = true;
  run.run(34);
  const auto read = heard(run.end());
  ASSERT_EQ(read->finding.status, ReadStatus::kEnd);
  ASSERT_EQ(read->listener.parts.size(), 1u);
  EXPECT_EQ(read->listener.parts[0].tick, 40u);
  const auto* bytes = reinterpret_cast<const uint8_t*>(&run.state());
  EXPECT_EQ(read->listener.snapshot, File(bytes, bytes + sizeof(run.state())));
}

/// Larger states come in parts.
TEST(Recording, GivesBackASnapshotInParts) {
  const auto state = std::make_unique<firmware::CycleState<Workstation>>();
  ASSERT_EQ(firmware::start(*state, dragged_bar()), Status::kDone);
  MemorySink sink;
  recording::RecordingWriter<MemorySink> writer(sink);
  writer.begin(recording::start_of(*state, "drag", false));
  writer.add_snapshot(0, *state);
  ASSERT_EQ(writer.end(), WriteStatus::kDone);
  const auto read = heard(sink.file);
  ASSERT_EQ(read->finding.status, ReadStatus::kEnd);
  EXPECT_GT(read->listener.parts.size(), 2u);
  const auto* bytes = reinterpret_cast<const uint8_t*>(state.get());
  EXPECT_EQ(read->listener.snapshot, File(bytes, bytes + sizeof(*state)));
  const auto again = std::make_unique<firmware::CycleState<Workstation>>();
  for (recording::SnapshotPart part : read->listener.parts) {
    part.bytes.data = read->listener.snapshot.data() + part.offset;
    ASSERT_TRUE(recording::restore(part, *again).is_done());
  }
  EXPECT_EQ(firmware::state_hash(*again), firmware::state_hash(*state));
}

TEST(Recording, SaysWhatItCouldNotWrite) {
  const std::size_t size = recorded_drag(5).size();
  for (std::size_t room = 0; room < size; room += 7) {
    MemorySink sink(room);
    recording::RecordingWriter<MemorySink> writer(sink);
    writer.begin(sample_start());
    for (uint32_t i = 0; i < 200; ++i) writer.add(TickRow{});
    ASSERT_EQ(writer.end(), WriteStatus::kSinkFull);
  }
}

TEST(MappedFile, RefusesWhatIsNoFile) {
  EXPECT_THROW(recording::MappedFile("/"), sim::BadInput);
  EXPECT_THROW(recording::MappedFile("no such file"), sim::BadInput);
  EXPECT_THROW(recording::MappedFile("/dev/null"), sim::BadInput);
}

}  // namespace
}  // namespace palpate::test
