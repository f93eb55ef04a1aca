// Against the check values that are published for this polynomial.
#include "palpate/container/crc32c.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/containers.hpp"

namespace palpate::test {
namespace {

using container::Crc32c;
using container::crc32c;

TEST(Crc32c, HasItsCheckValue) { EXPECT_EQ(crc32c(bytes_of(std::string("123456789"))), 0xe3069283u); }

TEST(Crc32c, OfNothingIsZero) { EXPECT_EQ(crc32c(Bytes{nullptr, 0}), 0u); }

/// RFC 3720, B.4.
TEST(Crc32c, HasTheValuesOfItsStandard) {
  File ascending(32);
  std::iota(ascending.begin(), ascending.end(), uint8_t{0});
  EXPECT_EQ(crc32c(bytes_of(File(32, 0x00))), 0x8a9136aau);
  EXPECT_EQ(crc32c(bytes_of(File(32, 0xff))), 0x62a8ab43u);
  EXPECT_EQ(crc32c(bytes_of(ascending)), 0x46dd794eu);
  std::reverse(ascending.begin(), ascending.end());
  EXPECT_EQ(crc32c(bytes_of(ascending)), 0x113fdb5cu);
}

TEST(Crc32c, IsTheSameInPieces) {
  const std::string text = "123456789";
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    Crc32c crc;
    crc.add(bytes_of(text.substr(0, cut)));
    crc.add(bytes_of(text.substr(cut)));
    EXPECT_EQ(crc.value(), 0xe3069283u);
  }
}

TEST(Crc32c, TakesAsMuchAsTheLongestChunk) {
  // One byte changes what comes out, also the last one of the longest chunk's.
  File longest(Crc32c::kMostBytes, 0);
  const uint32_t before = crc32c(bytes_of(longest));
  longest.back() = 1;
  EXPECT_NE(crc32c(bytes_of(longest)), before);
  EXPECT_GE(Crc32c::kMostBytes, container::chunk_bytes(container::kMostPayloadBytes));
}

TEST(Bytes, AreLittleEndianOnEveryMachine) {
  const uint8_t bytes[8] = {0x01, 0x23, 0x45, 0x67, 0x89, 0xab, 0xcd, 0xef};
  EXPECT_EQ(container::get_u16(bytes), 0x2301u);
  EXPECT_EQ(container::get_u32(bytes), 0x67452301u);
  EXPECT_EQ(container::get_u64(bytes), 0xefcdab8967452301u);
  EXPECT_EQ(container::get<int8_t>(bytes + 4), int8_t{-0x77});
  EXPECT_EQ(container::get<int16_t>(bytes + 6), int16_t{-0x1033});
  EXPECT_EQ(container::get<int32_t>(bytes + 4), int32_t{-0x10325477});
}

template <class Integer>
void expect_round_trip(Integer value) {
  uint8_t bytes[sizeof(Integer) + 1] = {};
  bytes[sizeof(Integer)] = 0x5a;
  container::put(bytes, value);
  EXPECT_EQ(container::get<Integer>(bytes), value);
  EXPECT_EQ(bytes[sizeof(Integer)], 0x5a);
}

TEST(Bytes, GiveBackWhatWasPut) {
  for (const int64_t value : {int64_t{0}, int64_t{1}, int64_t{-1}, int64_t{0x7fedcba987654321},
                              std::numeric_limits<int64_t>::min()}) {
    expect_round_trip(static_cast<uint8_t>(value));
    expect_round_trip(static_cast<int8_t>(value));
    expect_round_trip(static_cast<uint16_t>(value));
    expect_round_trip(static_cast<int16_t>(value));
    expect_round_trip(static_cast<uint32_t>(value));
    expect_round_trip(static_cast<int32_t>(value));
    expect_round_trip(static_cast<uint64_t>(value));
    expect_round_trip(value);
  }
}

}  // namespace
}  // namespace palpate::test
