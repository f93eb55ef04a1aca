// Fields come back as they were put, and a reader names the first one that is out of its range.
#include <gtest/gtest.h>

#include "palpate/container/field_reader.hpp"
#include "palpate/container/field_writer.hpp"
#include "support/containers.hpp"
#include "support/random.hpp"

namespace palpate::test {
namespace {

using container::FieldReader;
using container::FieldWriter;

enum class Colour : uint8_t { kRed, kGreen, kBlue };
using Fixed = Q<4, 27>;

struct Record {
  uint8_t u8;
  int8_t i8;
  uint16_t u16;
  int16_t i16;
  uint32_t u32;
  int32_t i32;
  uint64_t u64;
  Colour colour;
  Fixed fixed;
  std::array<Fixed, 3> fixed_array;
};
constexpr uint32_t kRecordBytes = 1 + 1 + 2 + 2 + 4 + 4 + 8 + 1 + 4 + 12 + 5;

template <class Fields, class ARecord>
void describe(Fields& fields, ARecord& record) {
  fields.number("u8", record.u8);
  fields.number("i8", record.i8);
  fields.number("u16", record.u16);
  fields.number("i16", record.i16);
  fields.number("u32", record.u32);
  fields.number("i32", record.i32);
  fields.number("u64", record.u64);
  fields.choice("colour", record.colour, Colour::kBlue);
  fields.fixed("fixed", record.fixed);
  fields.fixed_array("fixed array", record.fixed_array);
  fields.zeros(5);
}

File payload_of(const Record& record) {
  MemorySink sink;
  ChunkWriter<MemorySink> writer(sink);
  writer.begin(Kind::kSnapshot);
  writer.begin_chunk(Tag::of("TEST"), 1, 0, kRecordBytes);
  FieldWriter<MemorySink> fields(writer);
  describe(fields, record);
  writer.end_chunk();
  EXPECT_EQ(writer.end(), WriteStatus::kDone);
  return File(sink.file.begin() + 32, sink.file.begin() + 32 + kRecordBytes);
}

Chunk chunk_of(const File& payload) { return Chunk{Tag::of("TEST"), 1, false, 1000, bytes_of(payload)}; }

template <class Integer>
Integer any(Random& random) {
  return static_cast<Integer>(random.bits());
}

Record random_record(Random& random) {
  Record record{};
  record.u8 = any<uint8_t>(random);
  record.i8 = any<int8_t>(random);
  record.u16 = any<uint16_t>(random);
  record.i16 = any<int16_t>(random);
  record.u32 = any<uint32_t>(random);
  record.i32 = any<int32_t>(random);
  record.u64 = any<uint64_t>(random);
  record.colour = static_cast<Colour>(random.below(3));
  record.fixed = Fixed::from_raw(any<int32_t>(random));
  for (Fixed& fixed : record.fixed_array) fixed = Fixed::from_raw(any<int32_t>(random));
  return record;
}

TEST(Fields, ComeBackAsTheyWere) {
  Random random(7);
  for (int round = 0; round < 500; ++round) {
    const Record written = random_record(random);
    const File payload = payload_of(written);
    Record read{};
    FieldReader fields(chunk_of(payload));
    describe(fields, read);
    ASSERT_TRUE(fields.finish().is_done());
    ASSERT_EQ(read.u8, written.u8);
    ASSERT_EQ(read.i8, written.i8);
    ASSERT_EQ(read.u16, written.u16);
    ASSERT_EQ(read.i16, written.i16);
    ASSERT_EQ(read.u32, written.u32);
    ASSERT_EQ(read.i32, written.i32);
    ASSERT_EQ(read.u64, written.u64);
    ASSERT_EQ(read.colour, written.colour);
    ASSERT_EQ(read.fixed, written.fixed);
    ASSERT_EQ(read.fixed_array, written.fixed_array);
  }
}

TEST(Fields, HaveTheirPlaces) {
  Record record{};
  record.u8 = 0x01;
  record.i8 = -2;
  record.u16 = 0x0304;
  record.i16 = -2;
  record.u32 = 0x05060708;
  record.i32 = -2;
  record.u64 = 0x0102030405060708;
  record.colour = Colour::kBlue;
  record.fixed = Fixed::from_raw(0x11223344);
  record.fixed_array = {Fixed::from_raw(1), Fixed::from_raw(-1), Fixed::min()};
  const File expected = {0x01, 0xfe, 0x04, 0x03, 0xfe, 0xff, 8, 7, 6,    5,    0xfe, 0xff, 0xff, 0xff, 8,
                         7,    6,    5,    4,    3,    2,    1, 2, 0x44, 0x33, 0x22, 0x11, 1,    0,    0,
                         0,    0xff, 0xff, 0xff, 0xff, 0,    0, 0, 0x80, 0,    0,    0,    0,    0};
  EXPECT_EQ(payload_of(record), expected);
}

/// Shorter or longer than the fields: refused, and nothing beyond the payload is read.
TEST(Fields, FillTheirPayload) {
  Random random(8);
  const File payload = payload_of(random_record(random));
  for (uint32_t length = 0; length <= kRecordBytes + 3; ++length) {
    File other = payload;
    other.resize(length);
    other.shrink_to_fit();
    Record read{};
    FieldReader fields(chunk_of(other));
    describe(fields, read);
    const Finding finding = fields.finish();
    ASSERT_EQ(finding.is_done(), length == kRecordBytes) << length;
    if (length == kRecordBytes) continue;
    ASSERT_EQ(finding.status, ReadStatus::kWrongLength);
    ASSERT_EQ(finding.found, length);
    ASSERT_EQ(finding.offset, 1000u);
  }
}

struct Range {
  int16_t value;
  bool is_inside;
};

TEST(Fields, HaveRanges) {
  for (const Range range : {Range{-301, false}, Range{-300, true}, Range{0, true}, Range{200, true},
                            Range{201, false}, Range{-32768, false}, Range{32767, false}}) {
    File payload(6, 0);
    container::put(payload.data() + 2, range.value);
    FieldReader fields(chunk_of(payload));
    uint16_t first = 1;
    int16_t second = 77;
    uint16_t third = 77;
    fields.number("first", first);
    fields.number("second", second, -300, 200);
    fields.number("third", third);
    const Finding finding = fields.finish();
    EXPECT_EQ(first, 0);
    EXPECT_EQ(finding.is_done(), range.is_inside);
    EXPECT_EQ(second, range.is_inside ? range.value : 77);
    EXPECT_EQ(third, range.is_inside ? 0 : 77);
    if (range.is_inside) continue;
    EXPECT_EQ(finding.status, ReadStatus::kOutOfRange);
    EXPECT_EQ(finding.offset, 1000u + 16u + 2u);
    EXPECT_STREQ(finding.field, "second");
    EXPECT_EQ(finding.least, -300);
    EXPECT_EQ(finding.most, 200);
    EXPECT_EQ(finding.found, range.value);
  }
}

TEST(Fields, KnowAllValuesOfAnEnum) {
  for (uint32_t value = 0; value < 256; ++value) {
    const File payload = {static_cast<uint8_t>(value)};
    FieldReader fields(chunk_of(payload));
    Colour colour = Colour::kGreen;
    fields.choice("colour", colour, Colour::kBlue);
    EXPECT_EQ(fields.finish().is_done(), value < 3);
    EXPECT_EQ(colour, value < 3 ? static_cast<Colour>(value) : Colour::kGreen);
  }
}

TEST(Fields, WantZerosWhereNothingIs) {
  for (std::size_t byte = 0; byte < 7; ++byte) {
    File payload(7, 0);
    payload[byte] = 1;
    FieldReader fields(chunk_of(payload));
    fields.zeros(7);
    EXPECT_EQ(fields.finish().status, ReadStatus::kOutOfRange);
    EXPECT_EQ(fields.finish().offset, 1016 + byte);
  }
}

}  // namespace
}  // namespace palpate::test
