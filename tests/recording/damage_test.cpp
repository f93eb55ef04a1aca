// What happens to recordings: they are cut off, bits flip, chunks are put where they do not belong.
#include <functional>

#include "recording/snapshot.hpp"
#include "support/recordings.hpp"

namespace palpate::test {
namespace {

/// A row, a hash, a change, and rows after them.
File small_recording() {
  RecordedRun run(true, {3, 0});
  run.run(3);
  run.change({3, 7});
  run.run(2);
  return run.end();
}

/// What whole chunks tell, in numbers.
struct Told {
  std::size_t rows = 0, hashes = 0, changes = 0, parts = 0;
};

/// By the chunks before `size`.
Told told_before(const File& file, std::size_t size, bool& has_start) {
  Told told;
  has_start = false;
  for (const Chunk& chunk : read_all(file, Kind::kRecording).chunks) {
    if (chunk.offset + container::chunk_bytes(chunk.payload.size) > size) break;
    if (chunk.tag == Tag::of("SAFE")) has_start = true;
    if (chunk.tag == Tag::of("TICK")) told.rows += container::get_u32(chunk.payload.data + 4);
    if (chunk.tag == Tag::of("HASH")) ++told.hashes;
    if (chunk.tag == Tag::of("CHNG")) ++told.changes;
    if (chunk.tag == Tag::of("SNAP")) ++told.parts;
  }
  return told;
}

void expect_whole_chunks_before(const File& file, std::size_t size) {
  const File cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
  const auto read = heard(cut);
  bool has_start = false;
  const Told told = told_before(file, size, has_start);
  ASSERT_EQ(read->finding.status, ReadStatus::kCut) << size;
  ASSERT_EQ(read->has_start, has_start) << size;
  ASSERT_LE(read->finding.offset, size);
  ASSERT_EQ(read->listener.rows.size(), told.rows) << size;
  ASSERT_EQ(read->listener.hashes.size(), told.hashes) << size;
  ASSERT_EQ(read->listener.changes.size(), told.changes) << size;
  ASSERT_EQ(read->listener.parts.size(), told.parts) << size;
}

TEST(RecordingDamage, EveryCutLeavesTheWholeChunksBefore) {
  const File file = small_recording();
  for (std::size_t size = 0; size < file.size(); ++size) {
    expect_whole_chunks_before(file, size);
    if (HasFatalFailure()) return;
  }
}

TEST(RecordingDamage, ACutInASnapshotLeavesWhatIsBefore) {
  const File file = recorded_drag(10, {20, 30});
  for (std::size_t size = 0; size < file.size(); size += 97) {
    expect_whole_chunks_before(file, size);
    if (HasFatalFailure()) return;
  }
}

void expect_refused(const File& file, std::size_t bit) {
  File damaged = file;
  damaged[bit / 8] = static_cast<uint8_t>(damaged[bit / 8] ^ (1u << (bit % 8)));
  const auto read = heard(damaged);
  ASSERT_FALSE(read->is_usable()) << bit;
  // At the chunk of the bit or, in the file header, at most at its check.
  ASSERT_LE(read->finding.offset, bit / 8 < 16 ? 12 : bit / 8);
  ASSERT_NE(read->finding.least, read->finding.found);
}

TEST(RecordingDamage, EveryFlippedBitIsRefusedAtItsPlace) {
  const File file = small_recording();
  for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
    expect_refused(file, bit);
    if (HasFatalFailure()) return;
  }
}

TEST(RecordingDamage, FlippedBitsOfASnapshotAreRefused) {
  const File file = recorded_drag(10, {20, 30});
  for (std::size_t bit = 5; bit < 8 * file.size(); bit += 1013) {
    expect_refused(file, bit);
    if (HasFatalFailure()) return;
  }
}

/// Chunks that are right in themselves, but say what cannot be.
struct Case {
  const char* what;
  ReadStatus status;
  const char* field;  // or nullptr
  std::function<void(std::vector<Written>&)> change;
};

void put_u32_at(File& payload, std::size_t at, uint32_t value) {
  container::put_u32(payload.data() + at, value);
}

const std::vector<Case>& contradictions() {
  using Chunks = std::vector<Written>;
  constexpr auto kRange = ReadStatus::kOutOfRange;
  constexpr auto kPair = ReadStatus::kContradiction;
  static const auto erase = [](Chunks& c, std::size_t i) {
    c.erase(c.begin() + static_cast<std::ptrdiff_t>(i));
  };
  static const std::vector<Case> cases = {
      {"a hash without its rows", kPair, "tick", [](Chunks& c) { erase(c, find_chunk(c, "TICK")); }},
      {"rows twice", kRange, "first tick",
       [](Chunks& c) {
         const std::size_t at = find_chunk(c, "TICK");
         const Written twice = c[at];
         c.insert(c.begin() + static_cast<std::ptrdiff_t>(at), twice);
       }},
      {"no rows", kRange, "rows", [](Chunks& c) { put_u32_at(c[find_chunk(c, "TICK")].payload, 4, 0); }},
      {"too many rows", kRange, "rows",
       [](Chunks& c) { put_u32_at(c[find_chunk(c, "TICK")].payload, 4, 101); }},
      {"more rows than it says", ReadStatus::kWrongLength, nullptr,
       [](Chunks& c) { put_u32_at(c[find_chunk(c, "TICK")].payload, 4, 2); }},
      {"fewer rows than it says", ReadStatus::kWrongLength, nullptr,
       [](Chunks& c) { put_u32_at(c[find_chunk(c, "TICK")].payload, 4, 4); }},
      {"a state that is none", kRange, "state",
       [](Chunks& c) { c[find_chunk(c, "TICK")].payload[8 + 50] = 8; }},
      {"a motor code of 13 bits", kRange, "motor code",
       [](Chunks& c) { c[find_chunk(c, "TICK")].payload[8 + 39] = 0x10; }},
      {"a hash of another tick", kPair, "tick",
       [](Chunks& c) { put_u32_at(c[find_chunk(c, "HASH")].payload, 0, 2); }},
      {"a change of another tick", kPair, "tick",
       [](Chunks& c) { put_u32_at(c[find_chunk(c, "CHNG")].payload, 0, 4); }},
      {"a setting that is none", kRange, "setting",
       [](Chunks& c) { c[find_chunk(c, "CHNG")].payload[4] = 25; }},
      {"a snapshot of another tick", kPair, "tick",
       [](Chunks& c) { put_u32_at(c[find_chunk(c, "SNAP")].payload, 0, 2); }},
      {"a snapshot of another profile", kPair, "name of the profile",
       [](Chunks& c) { c[find_chunk(c, "SNAP")].payload[32] = 'S'; }},
      {"a snapshot without its begin", kPair, "offset of the bytes",
       [](Chunks& c) { put_u32_at(c[find_chunk(c, "SNAP")].payload, 24, 8); }},
      {"a snapshot without its end", kPair, "bytes of the snapshot before",
       [](Chunks& c) { c[find_chunk(c, "SNAP")].payload.pop_back(); }},
      {"a snapshot with too many bytes", kPair, "bytes of the state",
       [](Chunks& c) { c[find_chunk(c, "SNAP")].payload.push_back(0); }},
      {"a snapshot without bytes", ReadStatus::kWrongLength, nullptr,
       [](Chunks& c) { c[find_chunk(c, "SNAP")].payload.resize(48); }},
      {"no thresholds", ReadStatus::kMissingChunk, nullptr,
       [](Chunks& c) { erase(c, find_chunk(c, "SAFE")); }},
      {"no profile", ReadStatus::kMissingChunk, nullptr, [](Chunks& c) { erase(c, find_chunk(c, "PROF")); }},
      {"no scene", ReadStatus::kMissingChunk, nullptr, [](Chunks& c) { erase(c, find_chunk(c, "SCEN")); }},
      {"a profile that nobody has", kRange, "profiles of this name",
       [](Chunks& c) { c[find_chunk(c, "PROF")].payload[0] = 'S'; }},
      {"a threshold out of range", kRange, "ramp step",
       [](Chunks& c) { put_u32_at(c[find_chunk(c, "SAFE")].payload, 4, 0); }},
      {"thresholds that contradict each other", kPair, "usable thresholds",
       [](Chunks& c) { put_u32_at(c[find_chunk(c, "SAFE")].payload, 4 + 44, 0x40000000); }},
      {"thresholds twice", ReadStatus::kDuplicateChunk, nullptr,
       [](Chunks& c) { c.push_back(c[find_chunk(c, "SAFE")]); }},
      {"a newer kind of rows", ReadStatus::kFutureChunk, nullptr,
       [](Chunks& c) { c[find_chunk(c, "TICK")].version = 2; }},
      {"a chunk that must be known", ReadStatus::kUnknownChunk, nullptr,
       [](Chunks& c) {
         c.push_back({Tag::of("NEWS"), 1, true, {}});
       }},
  };
  return cases;
}

File sample_recording() {
  RecordedRun run(true, {3, 4});
  run.run(3);
  run.change({3, 7});
  run.run(3);
  return run.end();
}

TEST(RecordingDamage, WhatCannotBeIsRefused) {
  const File file = sample_recording();
  ASSERT_EQ(heard(file)->finding.status, ReadStatus::kEnd);
  for (const Case& one : contradictions()) {
    SCOPED_TRACE(one.what);
    auto chunks = chunks_of_recording(file);
    one.change(chunks);
    const auto read = heard(recording_of(chunks));
    EXPECT_FALSE(read->is_usable());
    EXPECT_EQ(read->finding.status, one.status);
    EXPECT_NE(read->finding.offset, 0u);
    if (one.field == nullptr) {
      EXPECT_EQ(read->finding.field, nullptr);
    } else {
      EXPECT_STREQ(read->finding.field, one.field);
    }
  }
}

TEST(RecordingDamage, WhatIsNotRequiredIsSkipped) {
  auto chunks = chunks_of_recording(sample_recording());
  chunks.insert(chunks.begin() + 2, {Tag::of("NEWS"), 4, false, File(10, 1)});
  chunks.insert(chunks.end() - 2, {Tag::of("NEWS"), 4, false, File(10, 1)});
  EXPECT_EQ(heard(recording_of(chunks))->finding.status, ReadStatus::kEnd);
}

/// Another build's snapshot is no damage; who would take it refuses it.
TEST(RecordingDamage, ASnapshotOfAnotherLayoutIsNotTaken) {
  const auto state = std::make_unique<firmware::CycleState<Small>>();
  const File file = sample_recording();
  const auto read = heard(file);
  ASSERT_EQ(read->listener.parts.size(), 1u);
  recording::SnapshotPart part = read->listener.parts[0];
  part.bytes.data = read->listener.snapshot.data();
  const auto refusal = [&state](const recording::SnapshotPart& wrong) {
    const Finding finding = recording::restore(wrong, *state);
    EXPECT_EQ(finding.status, ReadStatus::kContradiction);
    EXPECT_EQ(finding.offset, wrong.place);
    return std::string(finding.field == nullptr ? "" : finding.field);
  };
  ASSERT_TRUE(recording::restore(part, *state).is_done());
  auto other = part;
  other.fingerprint ^= 1;
  EXPECT_EQ(refusal(other), "layout");
  other = part;
  other.state_bytes -= 8;
  EXPECT_EQ(refusal(other), "bytes of the state");
  other = part;
  other.state_hash ^= 1;
  EXPECT_EQ(refusal(other), "hash of the state");
}

}  // namespace
}  // namespace palpate::test
