// Headers that are written well but say what this reader cannot or must not take.
#include <gtest/gtest.h>

#include "support/containers.hpp"

namespace palpate::test {
namespace {

using container::kFileHeaderBytes;

constexpr uint32_t kFirstChunk = kFileHeaderBytes;
constexpr uint32_t kEndChunk = kFirstChunk + 24;

/// One chunk of 4 bytes, whose padding is 0 and total 24.
File small_file() { return file_of(Kind::kSnapshot, {{kRows, 3, true, File(4, 7)}}); }

void expect_refused(const File& file, ReadStatus status, uint32_t offset, int64_t expected, int64_t found) {
  const Finding last = read_all(file, Kind::kSnapshot).last;
  EXPECT_EQ(last.status, status);
  EXPECT_EQ(last.offset, offset);
  EXPECT_EQ(last.most, expected);
  EXPECT_EQ(last.found, found);
}

TEST(Header, OfAnEmptyFileIsWhole) {
  for (const Kind kind : {Kind::kModel, Kind::kSnapshot, Kind::kRecording}) {
    const File file = file_of(kind, {});
    EXPECT_EQ(file.size(), 48u);
    const Reading reading = read_all(file, kind);
    EXPECT_EQ(reading.last.status, ReadStatus::kEnd);
    EXPECT_TRUE(reading.chunks.empty());
  }
}

TEST(Header, OfAnotherKindIsRefused) {
  const File file = small_file();
  for (const Kind kind : {Kind::kModel, Kind::kRecording}) {
    const Finding last = read_all(file, kind).last;
    EXPECT_EQ(last.status, ReadStatus::kWrongKind);
    EXPECT_EQ(last.offset, 10u);
    EXPECT_EQ(last.least, static_cast<int64_t>(kind));
    EXPECT_EQ(last.found, static_cast<int64_t>(Kind::kSnapshot));
  }
}

TEST(Header, OfAnotherFormatVersionIsRefused) {
  for (const uint16_t version : std::array<uint16_t, 4>{0, 2, 3, 0xffff}) {
    File file = small_file();
    container::put_u16(file.data() + 8, version);
    renew_checks(file, 0);
    expect_refused(file, ReadStatus::kFutureFormat, 8, 1, version);
  }
}

TEST(Header, HasAZeroByte) {
  File file = small_file();
  file[11] = 1;
  renew_checks(file, 0);
  expect_refused(file, ReadStatus::kPaddingNotZero, 11, 0, 1);
}

TEST(ChunkHeader, WithUnknownFlagsIsRefused) {
  for (const uint16_t flags : std::array<uint16_t, 3>{2, 3, 0x8000}) {
    File file = small_file();
    container::put_u16(file.data() + kFirstChunk + 6, flags);
    renew_checks(file, kFirstChunk);
    expect_refused(file, ReadStatus::kUnknownFlags, kFirstChunk, flags & 1, flags);
  }
}

TEST(ChunkHeader, WithALongerPayloadThanAnyIsRefused) {
  for (const uint32_t length : {container::kMostPayloadBytes + 1, 0xffffffffu, 0xfffffff0u}) {
    File file = small_file();
    container::put_u32(file.data() + kFirstChunk + 8, length);
    // Only the header's own check: the other one has no place in the file.
    container::put_u32(file.data() + kFirstChunk + 12,
                       container::crc32c(Bytes{file.data() + kFirstChunk, 12}));
    expect_refused(file, ReadStatus::kTooLong, kFirstChunk, container::kMostPayloadBytes, length);
  }
}

TEST(ChunkHeader, OfTheLongestPayloadIsRead) {
  File payload(container::kMostPayloadBytes, 0x3c);
  payload.back() = 0x3d;
  const File file = file_of(Kind::kSnapshot, {{kRows, 1, true, payload}});
  const Reading reading = read_all(file, Kind::kSnapshot);
  ASSERT_EQ(reading.last.status, ReadStatus::kEnd);
  EXPECT_EQ(as_written(reading.chunks[0]).payload, payload);
}

/// A file has one form: what is padding is zero, though the check covers it.
TEST(ChunkHeader, IsFollowedByZerosBehindThePayload) {
  for (uint32_t byte = 0; byte < 3; ++byte) {
    File file = file_of(Kind::kSnapshot, {{kRows, 1, true, File(1, 9)}});
    file[kFirstChunk + 17 + byte] = 5;
    renew_checks(file, kFirstChunk);
    expect_refused(file, ReadStatus::kPaddingNotZero, kFirstChunk, 0, 5);
  }
}

TEST(EndChunk, OfAnotherVersionIsRefused) {
  File file = small_file();
  container::put_u16(file.data() + kEndChunk + 4, 2);
  renew_checks(file, kEndChunk);
  expect_refused(file, ReadStatus::kFutureChunk, kEndChunk, 1, 2);
}

TEST(EndChunk, OfAnotherLengthIsRefused) {
  File file = small_file();
  container::put_u32(file.data() + kEndChunk + 8, 4);
  file.resize(kEndChunk + container::chunk_bytes(4));
  renew_checks(file, kEndChunk);
  expect_refused(file, ReadStatus::kWrongLength, kEndChunk, 8, 4);
}

TEST(EndChunk, IsRequired) {
  File file = small_file();
  container::put_u16(file.data() + kEndChunk + 6, 0);
  renew_checks(file, kEndChunk);
  expect_refused(file, ReadStatus::kUnknownFlags, kEndChunk, 1, 0);
}

TEST(EndChunk, CountsTheChunksBeforeIt) {
  File file = small_file();
  container::put_u32(file.data() + kEndChunk + 16, 2);
  renew_checks(file, kEndChunk);
  expect_refused(file, ReadStatus::kChunksMissing, kEndChunk, 2, 1);
}

/// What is refused stays refused, however often one asks.
TEST(ChunkReader, StaysWhereItRefused) {
  File file = small_file();
  file[kFirstChunk + 17] ^= 1;
  ChunkReader reader(bytes_of(file));
  ASSERT_TRUE(reader.open(Kind::kSnapshot).is_done());
  Chunk chunk{};
  for (int i = 0; i < 3; ++i) EXPECT_EQ(reader.next(chunk).status, ReadStatus::kChunkDamaged);
  EXPECT_EQ(reader.count(), 0u);
}

TEST(ChunkReader, StaysAtTheEnd) {
  const File file = small_file();
  ChunkReader reader(bytes_of(file));
  Chunk chunk{};
  ASSERT_TRUE(reader.open(Kind::kSnapshot).is_done());
  ASSERT_TRUE(reader.next(chunk).is_done());
  for (int i = 0; i < 3; ++i) EXPECT_EQ(reader.next(chunk).status, ReadStatus::kEnd);
  EXPECT_EQ(reader.count(), 1u);
}

TEST(ChunkReader, GivesNothingBeforeItIsOpened) {
  const File file = small_file();
  ChunkReader reader(bytes_of(file));
  Chunk chunk{};
  EXPECT_EQ(reader.next(chunk).status, ReadStatus::kNotAContainer);
}

TEST(ChunkReader, CanStartAgain) {
  const File file = file_of(Kind::kSnapshot, {{kRows, 1, true, {}}, {kRows, 2, true, {}}});
  ChunkReader reader(bytes_of(file));
  Chunk chunk{};
  EXPECT_EQ(reader.open(Kind::kModel).status, ReadStatus::kWrongKind);
  for (uint32_t chunks = 0; chunks < 3; ++chunks) {
    ASSERT_TRUE(reader.open(Kind::kSnapshot).is_done());
    for (uint32_t i = 0; i < chunks; ++i) ASSERT_TRUE(reader.next(chunk).is_done());
  }
  EXPECT_EQ(reader.next(chunk).status, ReadStatus::kEnd);
}

/// What it gives lies in the file, aligned as the file is.
TEST(ChunkReader, CopiesNothing) {
  const File file = file_of(Kind::kSnapshot, {{kRows, 1, true, File(3, 1)}, {kRows, 1, false, File(5, 2)}});
  for (const Chunk& chunk : read_all(file, Kind::kSnapshot).chunks) {
    EXPECT_EQ(chunk.payload.data, file.data() + chunk.payload_offset());
    EXPECT_EQ(chunk.payload_offset() % 8, 0u);
  }
}

}  // namespace
}  // namespace palpate::test
