// Files whose chunks are known by name.
#include "palpate/container/chunk_table.hpp"

#include <gtest/gtest.h>

#include "support/containers.hpp"

namespace palpate::test {
namespace {

using container::ChunkRule;

constexpr Tag kTets = Tag::of("TETS");
constexpr Tag kNote = Tag::of("NOTE");
constexpr Tag kNews = Tag::of("NEWS");

constexpr std::array<ChunkRule, 3> kRules = {
    {{kNode, 2, 8, 8, false}, {kTets, 1, 4, 12, false}, {kNote, 1, 0, 16, true}}};

const Written kGoodNode{kNode, 2, true, File(8, 1)};
const Written kGoodTets{kTets, 1, true, File(12, 2)};
const Written kGoodNote{kNote, 1, false, File(3, 3)};

struct Collected {
  Finding finding;
  std::array<Chunk, 3> chunks;
};

Collected collect_from(const File& file, Kind kind = Kind::kSnapshot) {
  Collected collected{Finding::nothing(), {}};
  collected.finding = container::collect(bytes_of(file), kind, kRules, collected.chunks);
  return collected;
}

Finding refusal(const std::vector<Written>& chunks) {
  return collect_from(file_of(Kind::kSnapshot, chunks)).finding;
}

TEST(ChunkTable, FindsItsChunksInAnyOrder) {
  const File file = file_of(Kind::kSnapshot, {kGoodNote, kGoodTets, kGoodNode});
  const Collected collected = collect_from(file);
  ASSERT_TRUE(collected.finding.is_done());
  EXPECT_TRUE(as_written(collected.chunks[0]) == kGoodNode);
  EXPECT_TRUE(as_written(collected.chunks[1]) == kGoodTets);
  EXPECT_TRUE(as_written(collected.chunks[2]) == kGoodNote);
}

TEST(ChunkTable, DoesWithoutAnOptionalOne) {
  const Collected collected = collect_from(file_of(Kind::kSnapshot, {kGoodNode, kGoodTets}));
  ASSERT_TRUE(collected.finding.is_done());
  EXPECT_EQ(collected.chunks[2].offset, 0u);
}

TEST(ChunkTable, MissesARequiredOne) {
  EXPECT_EQ(refusal({kGoodNode, kGoodNote}).status, ReadStatus::kMissingChunk);
  EXPECT_EQ(refusal({kGoodNode, kGoodNote}).tag, kTets);
  EXPECT_EQ(refusal({kGoodTets}).tag, kNode);
}

TEST(ChunkTable, RefusesASecondOne) {
  const Finding finding = refusal({kGoodNode, kGoodTets, kGoodNode});
  EXPECT_EQ(finding.status, ReadStatus::kDuplicateChunk);
  EXPECT_EQ(finding.tag, kNode);
  EXPECT_EQ(finding.least, 16);
  EXPECT_EQ(finding.found, finding.offset);
  EXPECT_EQ(refusal({kGoodNode, kGoodTets, kGoodNote, kGoodNote}).status, ReadStatus::kDuplicateChunk);
}

TEST(ChunkTable, SkipsWhatItNeedNotKnow) {
  EXPECT_TRUE(refusal({{kNews, 9, false, File(100, 1)}, kGoodNode, kGoodTets}).is_done());
  EXPECT_TRUE(refusal({kGoodNode, {kNews, 1, false, {}}, {kNews, 1, false, {}}, kGoodTets}).is_done());
}

TEST(ChunkTable, RefusesWhatItMustKnow) {
  const Finding finding = refusal({kGoodNode, {kNews, 1, true, {}}, kGoodTets});
  EXPECT_EQ(finding.status, ReadStatus::kUnknownChunk);
  EXPECT_EQ(finding.tag, kNews);
  EXPECT_EQ(finding.offset, 16u + container::chunk_bytes(8));
}

TEST(ChunkTable, RefusesAnotherVersion) {
  for (const uint16_t version : std::array<uint16_t, 2>{1, 3}) {
    const Finding finding = refusal({{kNode, version, true, File(8, 1)}, kGoodTets});
    EXPECT_EQ(finding.status, ReadStatus::kFutureChunk);
    EXPECT_EQ(finding.least, 2);
    EXPECT_EQ(finding.found, version);
  }
}

TEST(ChunkTable, RefusesAnotherLength) {
  for (const std::size_t length : {3u, 13u}) {
    const Finding finding = refusal({kGoodNode, {kTets, 1, true, File(length, 2)}});
    EXPECT_EQ(finding.status, ReadStatus::kWrongLength);
    EXPECT_EQ(finding.least, 4);
    EXPECT_EQ(finding.most, 12);
    EXPECT_EQ(finding.found, static_cast<int64_t>(length));
  }
}

/// Damage is named before anything that it may have caused, and a cut file is not collected.
TEST(ChunkTable, TakesNothingFromAFileThatIsNotWhole) {
  File file = file_of(Kind::kSnapshot, {{kNews, 1, true, {}}, kGoodNode, kGoodTets});
  file[file.size() - 40] ^= 1;
  EXPECT_EQ(collect_from(file).finding.status, ReadStatus::kChunkDamaged);
  const File whole = file_of(Kind::kSnapshot, {kGoodNode, kGoodTets});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    ASSERT_EQ(
        collect_from(File(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))).finding.status,
        ReadStatus::kCut);
  }
  EXPECT_EQ(collect_from(whole, Kind::kModel).finding.status, ReadStatus::kWrongKind);
}

}  // namespace
}  // namespace palpate::test
