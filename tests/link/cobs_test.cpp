#include "palpate/link/cobs.hpp"

#include <gtest/gtest.h>

#include "support/link_reference.hpp"

namespace palpate::test {
namespace {

using link::CobsDecoder;
using link::CobsEvent;

template <std::size_t Size>
Bytes encoded(const std::array<uint8_t, Size>& plain) {
  std::array<uint8_t, Size + 1> out{};
  link::cobs_encode(plain, out);
  return {out.begin(), out.end()};
}

struct Decoded {
  Bytes bytes;
  CobsEvent end;
};

/// The bytes and then a 0.
Decoded decoded(CobsDecoder& decoder, const Bytes& stream) {
  Decoded result{};
  for (const uint8_t byte : stream) {
    const CobsEvent event = decoder.push(byte);
    EXPECT_TRUE(event == CobsEvent::kNone || event == CobsEvent::kByte);
    if (event == CobsEvent::kByte) result.bytes.push_back(decoder.byte());
  }
  result.end = decoder.push(0);
  return result;
}

TEST(Cobs, EncodesThePublishedExamples) {
  EXPECT_EQ(encoded<0>({}), (Bytes{0x01}));
  EXPECT_EQ(encoded<1>({0x00}), (Bytes{0x01, 0x01}));
  EXPECT_EQ(encoded<2>({0x00, 0x00}), (Bytes{0x01, 0x01, 0x01}));
  EXPECT_EQ(encoded<3>({0x00, 0x11, 0x00}), (Bytes{0x01, 0x02, 0x11, 0x01}));
  EXPECT_EQ(encoded<4>({0x11, 0x22, 0x00, 0x33}), (Bytes{0x03, 0x11, 0x22, 0x02, 0x33}));
  EXPECT_EQ(encoded<5>({0x11, 0x00, 0x00, 0x22, 0x33}), (Bytes{0x02, 0x11, 0x01, 0x03, 0x22, 0x33}));
  EXPECT_EQ(encoded<4>({0x11, 0x22, 0x33, 0x44}), (Bytes{0x05, 0x11, 0x22, 0x33, 0x44}));
}

TEST(Cobs, ReachesAcrossTheLongestFrame) {
  std::array<uint8_t, 253> plain{};
  plain.fill(0xff);
  const Bytes bytes = encoded(plain);
  EXPECT_EQ(bytes.front(), 254);
  CobsDecoder decoder;
  const Decoded back = decoded(decoder, bytes);
  EXPECT_EQ(back.end, CobsEvent::kEnd);
  EXPECT_EQ(back.bytes, Bytes(plain.begin(), plain.end()));
}

/// Every pattern of zeros in 12 bytes, against the reference and back.
TEST(Cobs, TurnsEveryPatternOfZerosThereAndBack) {
  CobsDecoder decoder;
  for (uint32_t pattern = 0; pattern < 4096; ++pattern) {
    std::array<uint8_t, 12> plain{};
    for (uint32_t i = 0; i < 12; ++i) plain[i] = (pattern >> i & 1u) != 0 ? static_cast<uint8_t>(i + 1) : 0;
    const Bytes bytes = encoded(plain);
    ASSERT_EQ(bytes, reference_cobs(Bytes(plain.begin(), plain.end())));
    ASSERT_EQ(std::count(bytes.begin(), bytes.end(), 0), 0);
    const Decoded back = decoded(decoder, bytes);
    ASSERT_EQ(back.end, CobsEvent::kEnd);
    ASSERT_EQ(back.bytes, Bytes(plain.begin(), plain.end()));
  }
}

/// Any bytes, also those that no encoder makes.
TEST(Cobs, AgreesWithTheReferenceOnAnyBytes) {
  Random random(2);
  CobsDecoder decoder;
  uint32_t whole = 0;
  for (int i = 0; i < 20000; ++i) {
    Bytes bytes(1 + random.below(12));
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(1 + random.below(5));
    const std::optional<Bytes> expected = reference_cobs_decoded(bytes);
    const Decoded got = decoded(decoder, bytes);
    ASSERT_EQ(got.end, expected ? CobsEvent::kEnd : CobsEvent::kCut);
    if (!expected) continue;
    ASSERT_EQ(got.bytes, *expected);
    ++whole;
  }
  EXPECT_GT(whole, 5000u);
}

TEST(Cobs, IsInStepAgainAfterAnyZero) {
  const Bytes frame = {0x03, 0x11, 0x22, 0x02, 0x33};
  for (std::size_t cut = 0; cut < frame.size(); ++cut) {
    CobsDecoder decoder;
    const Decoded part = decoded(decoder, Bytes(frame.begin(), frame.begin() + static_cast<int>(cut)));
    const bool ends_where_a_distance_points = cut == 3;
    EXPECT_EQ(part.end, cut == 0                       ? CobsEvent::kNone
                        : ends_where_a_distance_points ? CobsEvent::kEnd
                                                       : CobsEvent::kCut);
    EXPECT_EQ(decoder.push(0), CobsEvent::kNone);
    const Decoded whole = decoded(decoder, frame);
    EXPECT_EQ(whole.end, CobsEvent::kEnd);
    EXPECT_EQ(whole.bytes, (Bytes{0x11, 0x22, 0x00, 0x33}));
  }
}

}  // namespace
}  // namespace palpate::test
