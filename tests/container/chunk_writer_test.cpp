// The writer says what it could not do, and writes nothing after that.
#include "palpate/container/chunk_writer.hpp"

#include <gtest/gtest.h>

#include "support/containers.hpp"

namespace palpate::test {
namespace {

using container::kRequiredFlag;

constexpr uint8_t kBytes[5] = {};

using Writer = ChunkWriter<MemorySink>;

WriteStatus write_two_chunks(MemorySink& sink) {
  Writer writer(sink);
  writer.begin(Kind::kRecording);
  for (const uint8_t length : std::array<uint8_t, 2>{5, 12}) {
    writer.begin_chunk(kRows, 1, kRequiredFlag, length);
    for (uint8_t i = 0; i < length; ++i) writer.put(Bytes{&i, 1});
    writer.end_chunk();
  }
  return writer.end();
}

TEST(ChunkWriter, GivesTheSameBytesInPieces) {
  MemorySink sink;
  ASSERT_EQ(write_two_chunks(sink), WriteStatus::kDone);
  const File expected = file_of(Kind::kRecording, {{kRows, 1, true, {0, 1, 2, 3, 4}},
                                                   {kRows, 1, true, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}}});
  EXPECT_EQ(sink.file, expected);
}

/// The sink fills up at every byte: what it took is the beginning of the file, and the writer says so.
TEST(ChunkWriter, StopsWhereTheSinkIsFull) {
  MemorySink whole;
  ASSERT_EQ(write_two_chunks(whole), WriteStatus::kDone);
  for (std::size_t room = 0; room < whole.file.size(); ++room) {
    MemorySink sink(room);
    ASSERT_EQ(write_two_chunks(sink), WriteStatus::kSinkFull) << room;
    ASSERT_LE(sink.file.size(), room);
    ASSERT_TRUE(std::equal(sink.file.begin(), sink.file.end(), whole.file.begin()));
    ASSERT_EQ(read_all(sink.file, Kind::kRecording).last.status, ReadStatus::kCut);
  }
}

template <class Misuse>
void expect_misuse(WriteStatus expected, Misuse misuse) {
  MemorySink sink;
  Writer writer(sink);
  misuse(writer);
  EXPECT_EQ(writer.status(), expected);
  const std::size_t written = sink.file.size();
  // Nothing gets it to go on.
  writer.begin(Kind::kModel);
  writer.begin_chunk(kRows, 1, 0, 0);
  writer.end_chunk();
  EXPECT_EQ(writer.end(), expected);
  EXPECT_EQ(sink.file.size(), written);
}

TEST(ChunkWriter, WantsItsCallsInOrder) {
  expect_misuse(WriteStatus::kWrongOrder, [](Writer& w) { w.begin_chunk(kRows, 1, 0, 0); });
  expect_misuse(WriteStatus::kWrongOrder, [](Writer& w) { w.put(Bytes{kBytes, 1}); });
  expect_misuse(WriteStatus::kWrongOrder, [](Writer& w) { w.end_chunk(); });
  expect_misuse(WriteStatus::kWrongOrder, [](Writer& w) { (void)w.end(); });
  expect_misuse(WriteStatus::kWrongOrder, [](Writer& w) {
    w.begin(Kind::kModel);
    w.begin(Kind::kModel);
  });
  expect_misuse(WriteStatus::kWrongOrder, [](Writer& w) {
    w.begin(Kind::kModel);
    w.begin_chunk(kRows, 1, 0, 4);
    w.begin_chunk(kRows, 1, 0, 4);
  });
  expect_misuse(WriteStatus::kWrongOrder, [](Writer& w) {
    w.begin(Kind::kModel);
    w.begin_chunk(kRows, 1, 0, 0);
    (void)w.end();
  });
  expect_misuse(WriteStatus::kWrongOrder, [](Writer& w) {
    w.begin(Kind::kModel);
    w.begin_chunk(container::kEndTag, 1, 0, 0);
  });
  expect_misuse(WriteStatus::kWrongOrder, [](Writer& w) {
    w.begin(Kind::kModel);
    w.begin_chunk(kRows, 1, 2, 0);
  });
}

TEST(ChunkWriter, EndsOnce) {
  MemorySink sink;
  Writer writer(sink);
  writer.begin(Kind::kModel);
  ASSERT_EQ(writer.end(), WriteStatus::kDone);
  const std::size_t written = sink.file.size();
  EXPECT_EQ(writer.end(), WriteStatus::kWrongOrder);
  EXPECT_EQ(sink.file.size(), written);
}

TEST(ChunkWriter, WantsTheLengthThatWasAnnounced) {
  for (const uint32_t given : {3u, 5u}) {
    expect_misuse(WriteStatus::kWrongLength, [given](Writer& w) {
      w.begin(Kind::kModel);
      w.begin_chunk(kRows, 1, 0, 4);
      w.put(Bytes{kBytes, given});
      w.end_chunk();
    });
  }
  expect_misuse(WriteStatus::kTooLong, [](Writer& w) {
    w.begin(Kind::kModel);
    w.begin_chunk(kRows, 1, 0, container::kMostPayloadBytes + 1);
  });
}

/// Both count to the same limit.
TEST(ChunkWriter, HasAMostNumberOfChunks) {
  MemorySink sink;
  Writer writer(sink);
  writer.begin(Kind::kRecording);
  for (uint32_t i = 0; i < container::kMostChunks; ++i) {
    writer.begin_chunk(kRows, 1, 0, 0);
    writer.end_chunk();
  }
  ASSERT_EQ(writer.status(), WriteStatus::kDone);
  const File chunks = sink.file;
  ASSERT_EQ(writer.end(), WriteStatus::kDone);
  ASSERT_EQ(read_all(sink.file, Kind::kRecording).last.status, ReadStatus::kEnd);

  File one_more = chunks;
  one_more.insert(one_more.end(), chunks.end() - container::chunk_bytes(0), chunks.end());
  const Reading reading = read_all(one_more, Kind::kRecording);
  EXPECT_EQ(reading.last.status, ReadStatus::kTooManyChunks);
  EXPECT_EQ(reading.last.offset, chunks.size());
}

}  // namespace
}  // namespace palpate::test
