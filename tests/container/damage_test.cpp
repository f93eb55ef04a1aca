// What happens to files: a bit flips, the end is cut off, something is appended, chunks are lost, doubled or
// in another order, a transfer takes them for text. All of it is refused at its place.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/containers.hpp"

namespace palpate::test {
namespace {

using container::is_usable;
using container::kChunkHeaderBytes;
using container::kFileHeaderBytes;

constexpr std::array<Kind, 3> kKinds = {Kind::kModel, Kind::kSnapshot, Kind::kRecording};

/// Payloads with every length of padding.
std::vector<Written> some_chunks() {
  std::vector<Written> chunks;
  for (uint8_t length = 0; length < 9; ++length) {
    File payload(length);
    for (uint8_t i = 0; i < length; ++i) payload[i] = static_cast<uint8_t>(37 * i + length);
    chunks.push_back({length % 2 == 0 ? kRows : kNode, length, length % 3 == 0, payload});
  }
  return chunks;
}

/// Where chunk i begins, END too.
uint32_t offset_of(const std::vector<Written>& chunks, std::size_t i) {
  uint32_t offset = kFileHeaderBytes;
  for (std::size_t k = 0; k < i; ++k) {
    offset += container::chunk_bytes(static_cast<uint32_t>(chunks[k].payload.size()));
  }
  return offset;
}

/// The chunk that byte `at` belongs to; 0 for the file header.
uint32_t chunk_at(const std::vector<Written>& chunks, uint32_t at) {
  uint32_t begin = 0;
  for (std::size_t i = 0; i <= chunks.size() && offset_of(chunks, i) <= at; ++i) begin = offset_of(chunks, i);
  return begin;
}

TEST(Damage, EveryFlippedBitIsRefusedAtItsPlace) {
  const auto chunks = some_chunks();
  for (const Kind kind : kKinds) {
    const File whole = file_of(kind, chunks);
    ASSERT_EQ(read_all(whole, kind).last.status, ReadStatus::kEnd);
    for (uint32_t bit = 0; bit < 8 * whole.size(); ++bit) {
      File damaged = whole;
      damaged[bit / 8] = static_cast<uint8_t>(damaged[bit / 8] ^ (1u << (bit % 8)));
      const Reading reading = read_all(damaged, kind);
      ASSERT_FALSE(is_usable(kind, reading.last.status)) << "bit " << bit;
      ASSERT_NE(reading.last.least, reading.last.found) << "bit " << bit;
      const uint32_t chunk = chunk_at(chunks, bit / 8);
      if (chunk == 0) {
        ASSERT_LE(reading.last.offset, 12u) << "bit " << bit;
        ASSERT_EQ(reading.last.tag, container::kNoTag);
      } else {
        ASSERT_EQ(reading.last.offset, chunk) << "bit " << bit;
        const bool is_in_header = bit / 8 - chunk < kChunkHeaderBytes;
        ASSERT_EQ(reading.last.status,
                  is_in_header ? ReadStatus::kChunkHeaderDamaged : ReadStatus::kChunkDamaged);
        ASSERT_EQ(reading.last.tag.word, container::get_u32(damaged.data() + chunk));
      }
    }
  }
}

/// All chunks before the cut, and its name; a model or a snapshot is of no use then.
TEST(Damage, EveryCutIsNamed) {
  const auto chunks = some_chunks();
  for (const Kind kind : kKinds) {
    const File whole = file_of(kind, chunks);
    for (uint32_t size = 0; size < whole.size(); ++size) {
      const File cut(whole.begin(), whole.begin() + size);
      const Reading reading = read_all(cut, kind);
      ASSERT_EQ(reading.last.status, ReadStatus::kCut) << size;
      ASSERT_EQ(is_usable(kind, reading.last.status), kind == Kind::kRecording);
      std::size_t complete = 0;
      while (complete < chunks.size() && offset_of(chunks, complete + 1) <= size) ++complete;
      ASSERT_EQ(reading.chunks.size(), complete) << size;
      for (std::size_t i = 0; i < complete; ++i) ASSERT_TRUE(as_written(reading.chunks[i]) == chunks[i]);
      ASSERT_EQ(reading.last.offset, size < kFileHeaderBytes ? 0 : offset_of(chunks, complete)) << size;
      ASSERT_EQ(reading.last.found, size - reading.last.offset) << size;
      ASSERT_GT(reading.last.least, reading.last.found) << size;
    }
  }
}

/// The length is checked before it is believed, so that damage is not taken for a cut.
TEST(Damage, ALongerLengthIsNotACut) {
  const auto chunks = some_chunks();
  File file = file_of(Kind::kRecording, chunks);
  file[kFileHeaderBytes + 9] = 0x70;
  const Finding last = read_all(file, Kind::kRecording).last;
  EXPECT_EQ(last.status, ReadStatus::kChunkHeaderDamaged);
  EXPECT_EQ(last.offset, kFileHeaderBytes);
}

TEST(Damage, AppendedBytesAreRefused) {
  for (const Kind kind : kKinds) {
    const File whole = file_of(kind, some_chunks());
    for (const std::size_t count : {1u, 7u, 8u, 80u}) {
      File longer = whole;
      longer.insert(longer.end(), count, 0);
      const Reading reading = read_all(longer, kind);
      EXPECT_EQ(reading.last.status, ReadStatus::kBytesAfterEnd);
      EXPECT_EQ(reading.last.offset, whole.size());
      EXPECT_EQ(reading.last.least, static_cast<int64_t>(whole.size()));
      EXPECT_EQ(reading.last.found, static_cast<int64_t>(longer.size()));
    }
    File twice = whole;
    twice.insert(twice.end(), whole.begin(), whole.end());
    EXPECT_EQ(read_all(twice, kind).last.status, ReadStatus::kBytesAfterEnd);
  }
}

TEST(Damage, ALostChunkIsMissed) {
  const auto chunks = some_chunks();
  const File whole = file_of(Kind::kRecording, chunks);
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    File without = whole;
    without.erase(without.begin() + offset_of(chunks, i), without.begin() + offset_of(chunks, i + 1));
    const Finding last = read_all(without, Kind::kRecording).last;
    EXPECT_EQ(last.status, ReadStatus::kChunksMissing) << i;
    EXPECT_EQ(last.least, 9);
    EXPECT_EQ(last.found, 8);
    EXPECT_EQ(last.tag, container::kEndTag);
  }
}

TEST(Damage, ADoubledChunkIsSeen) {
  const auto chunks = some_chunks();
  const File whole = file_of(Kind::kRecording, chunks);
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    File doubled = whole;
    doubled.insert(doubled.begin() + offset_of(chunks, i), whole.begin() + offset_of(chunks, i),
                   whole.begin() + offset_of(chunks, i + 1));
    EXPECT_EQ(read_all(doubled, Kind::kRecording).last.status, ReadStatus::kChunksMissing) << i;
  }
}

TEST(Damage, AnotherOrderIsSeen) {
  const std::vector<Written> chunks = {{kRows, 1, true, File(4, 1)}, {kRows, 1, true, File(4, 2)}};
  File file = file_of(Kind::kRecording, chunks);
  const auto first = file.begin() + offset_of(chunks, 0);
  std::rotate(first, file.begin() + offset_of(chunks, 1), file.begin() + offset_of(chunks, 2));
  const Finding last = read_all(file, Kind::kRecording).last;
  EXPECT_EQ(last.status, ReadStatus::kChunksReplaced);
  EXPECT_NE(last.least, last.found);
}

/// A chunk that is good in itself, from another file.
TEST(Damage, AForeignChunkIsSeen) {
  const std::vector<Written> chunks = {{kRows, 1, true, File(4, 1)}};
  File file = file_of(Kind::kRecording, chunks);
  const File other = file_of(Kind::kRecording, {{kRows, 1, true, File(4, 2)}});
  std::copy(other.begin() + offset_of(chunks, 0), other.begin() + offset_of(chunks, 1),
            file.begin() + offset_of(chunks, 0));
  EXPECT_EQ(read_all(file, Kind::kRecording).last.status, ReadStatus::kChunksReplaced);
}

/// A header that is good in itself, of a chunk that is as long: the payload's check is of both.
TEST(Damage, AForeignChunkHeaderIsSeen) {
  const std::vector<Written> chunks = {{kRows, 1, true, File(4, 1)}};
  for (const Written& other : {Written{kNode, 1, true, File(4, 1)}, Written{kRows, 2, true, File(4, 1)},
                               Written{kRows, 1, false, File(4, 1)}}) {
    File file = file_of(Kind::kRecording, chunks);
    const File foreign = file_of(Kind::kRecording, {other});
    std::copy(foreign.begin() + kFileHeaderBytes, foreign.begin() + kFileHeaderBytes + kChunkHeaderBytes,
              file.begin() + kFileHeaderBytes);
    EXPECT_EQ(read_all(file, Kind::kRecording).last.status, ReadStatus::kChunkDamaged);
  }
}

TEST(Damage, AForeignHeaderIsSeen) {
  const File model = file_of(Kind::kModel, some_chunks());
  File file = file_of(Kind::kSnapshot, some_chunks());
  std::copy(model.begin(), model.begin() + kFileHeaderBytes, file.begin());
  EXPECT_EQ(read_all(file, Kind::kModel).last.status, ReadStatus::kChunksReplaced);
}

/// What text modes do to all bytes of a file.
File replaced(const File& file, const std::string& from, const std::string& to) {
  std::string text(file.begin(), file.end());
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return File(text.begin(), text.end());
}

TEST(Damage, ATransferAsTextIsCalledThat) {
  const File whole = file_of(Kind::kModel, some_chunks());
  File seven_bits = whole;
  for (uint8_t& byte : seven_bits) byte = byte & 0x7f;
  const auto status = [](const File& file) { return read_all(file, Kind::kModel).last.status; };
  EXPECT_EQ(status(seven_bits), ReadStatus::kTextMode);
  EXPECT_EQ(status(replaced(whole, "\r\n", "\n")), ReadStatus::kTextMode);
  EXPECT_EQ(status(replaced(whole, "\n", "\r\n")), ReadStatus::kTextMode);
  EXPECT_EQ(status(replaced(whole, "\r", "\n")), ReadStatus::kTextMode);
  EXPECT_EQ(status(replaced(whole, "\n", "\r")), ReadStatus::kTextMode);
  EXPECT_EQ(status(File{'P', 'L', 'P', '\r'}), ReadStatus::kNotAContainer);
}

TEST(Damage, OtherFilesAreNotContainers) {
  for (const char* text : {"x", "# Palpate",
                           "\x7f"
                           "ELF",
                           "\x89PNG\r\n\x1a\n"}) {
    const std::string other = text;
    const Finding last = read_all(File(other.begin(), other.end()), Kind::kModel).last;
    EXPECT_EQ(last.status, ReadStatus::kNotAContainer) << text;
    EXPECT_NE(last.least, last.found) << text;
  }
}

}  // namespace
}  // namespace palpate::test
