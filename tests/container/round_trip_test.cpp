// Any sequence of chunks comes back as it was written.
#include <gtest/gtest.h>

#include "support/containers.hpp"
#include "support/random.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

File random_payload(Random& random, uint32_t length) {
  File payload(length);
  for (uint8_t& byte : payload) byte = static_cast<uint8_t>(random.below(256));
  return payload;
}

std::vector<Written> random_chunks(Random& random) {
  std::vector<Written> chunks(random.below(8));
  for (Written& chunk : chunks) {
    chunk.tag = Tag{static_cast<uint32_t>(random.bits())};
    if (chunk.tag == container::kEndTag) chunk.tag = Tag::of("ROWS");
    chunk.version = static_cast<uint16_t>(random.below(0x10000));
    chunk.is_required = random.below(2) != 0;
    chunk.payload = random_payload(random, random.below(random.below(10) == 0 ? 3000 : 40));
  }
  return chunks;
}

TEST(RoundTrip, GivesBackEveryChunk) {
  Random random(11);
  uint32_t count = 0;
  for (uint32_t round = 0; round < in_soak(200000u, 2000u); ++round) {
    const auto chunks = random_chunks(random);
    const auto kind = static_cast<Kind>(1 + random.below(3));
    const File file = file_of(kind, chunks);
    ASSERT_EQ(file.size() % 8, 0u);
    const Reading reading = read_all(file, kind);
    ASSERT_EQ(reading.last.status, ReadStatus::kEnd);
    ASSERT_EQ(reading.chunks.size(), chunks.size());
    for (std::size_t i = 0; i < chunks.size(); ++i) {
      ASSERT_TRUE(as_written(reading.chunks[i]) == chunks[i]);
    }
    count += static_cast<uint32_t>(chunks.size());
  }
  EXPECT_GT(count, 5000u);
}

/// Wherever the file lies in memory: a copy at each of eight places reads the same.
TEST(RoundTrip, DoesNotCareForAlignment) {
  Random random(12);
  for (uint32_t round = 0; round < 50; ++round) {
    const auto chunks = random_chunks(random);
    const File file = file_of(Kind::kModel, chunks);
    for (std::size_t shift = 0; shift < 8; ++shift) {
      File shifted(shift, 0);
      shifted.insert(shifted.end(), file.begin(), file.end());
      ChunkReader reader(Bytes{shifted.data() + shift, static_cast<uint32_t>(file.size())});
      Finding finding = reader.open(Kind::kModel);
      Chunk chunk{};
      while (finding.is_done() && (finding = reader.next(chunk)).is_done()) {
        ASSERT_TRUE(as_written(chunk) == chunks[reader.count() - 1]);
      }
      ASSERT_EQ(finding.status, ReadStatus::kEnd);
    }
  }
}

/// Several bytes at random places become others: refused, as far as 32 bits of check can.
TEST(RoundTrip, RandomDamageIsRefused) {
  Random random(13);
  for (uint32_t round = 0; round < in_soak(2000000u, 20000u); ++round) {
    const File whole = file_of(Kind::kRecording, random_chunks(random));
    File damaged = whole;
    const uint32_t changes = 1 + random.below(6);
    for (uint32_t i = 0; i < changes; ++i) {
      damaged[random.below(static_cast<uint32_t>(damaged.size()))] = static_cast<uint8_t>(random.below(256));
    }
    if (damaged == whole) continue;
    ASSERT_FALSE(container::is_usable(Kind::kRecording, read_all(damaged, Kind::kRecording).last.status));
  }
}

}  // namespace
}  // namespace palpate::test
