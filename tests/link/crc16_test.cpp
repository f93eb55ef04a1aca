#include "palpate/link/crc16.hpp"

#include <gtest/gtest.h>

#include <string>

#include "support/link_reference.hpp"

namespace palpate::test {
namespace {

constexpr std::size_t kCodewordBits = 8 * link::kEncodedSize + 16;
constexpr std::size_t kLongestCodewordBits = 257;

uint16_t crc_of(const Bytes& bytes) {
  link::Crc16 crc;
  for (const uint8_t byte : bytes) crc.add(byte);
  return crc.value();
}

TEST(Crc16, HasThePublishedCheckValue) {
  const std::string text = "123456789";
  EXPECT_EQ(crc_of(Bytes(text.begin(), text.end())), 0x772b);
  EXPECT_EQ(crc_of({}), 0xffff);
}

TEST(Crc16, IsTheRemainderOfTheLongDivision) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    Bytes bytes(2 + random.below(40));
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.bits());
    ASSERT_EQ(crc_of(bytes), reference_crc(bytes)) << i;
  }
}

/// The difference that one wrong bit makes to the CRC, for each place counted from the codeword's end.
std::vector<uint32_t> differences_of_bits(std::size_t bits, uint32_t polynomial) {
  std::vector<uint32_t> differences;
  for (uint32_t difference = 1; differences.size() < bits;) {
    differences.push_back(difference);
    difference <<= 1;
    if ((difference & 0x10000u) != 0) difference ^= 0x10000u | polynomial;
  }
  return differences;
}

/// The least number of wrong bits that leave a codeword, if below 5: with at most 4, a pair or a bit has the
/// difference of another, or none. Else 5 for "5 or more".
uint32_t distance(std::size_t bits, uint32_t polynomial) {
  const std::vector<uint32_t> differences = differences_of_bits(bits, polynomial);
  std::vector<bool> is_single(0x10000);
  for (const uint32_t single : differences) {
    if (is_single[single]) return 2;
    is_single[single] = true;
  }
  std::vector<bool> is_pair(0x10000);
  uint32_t least = 5;
  for (std::size_t i = 0; i < bits; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const uint32_t pair = differences[i] ^ differences[j];
      if (is_single[pair]) return 3;
      if (is_pair[pair]) least = 4;
      is_pair[pair] = true;
    }
  }
  return least;
}

TEST(Crc16, FindsAnyFourWrongBitsInAFrame) {
  EXPECT_EQ(distance(kCodewordBits, 0x5935), 5u);
  EXPECT_EQ(distance(8 * link::kCrc16CoveredBytes + 16, 0x5935), 5u);
  EXPECT_EQ(distance(kLongestCodewordBits, 0x5935), 5u);
  EXPECT_EQ(distance(kLongestCodewordBits + 1, 0x5935), 2u);
}

TEST(Crc16, IsFartherApartThanTheUsualOnes) {
  EXPECT_EQ(distance(kCodewordBits, 0x1021), 4u);
  EXPECT_EQ(distance(kCodewordBits, 0x8005), 4u);
  EXPECT_EQ(distance(kCodewordBits, 0x3d65), 2u);
}

/// Whether any four wrong bits are found, and no more than that asked: most polynomials fail soon.
bool finds_four(uint32_t polynomial) {
  const std::vector<uint32_t> differences = differences_of_bits(kCodewordBits, polynomial);
  std::vector<bool> is_taken(0x10000);
  const auto is_new = [&is_taken](uint32_t difference) {
    const bool was_taken = is_taken[difference];
    is_taken[difference] = true;
    return !was_taken && difference != 0;
  };
  for (const uint32_t single : differences) {
    if (!is_new(single)) return false;
  }
  for (std::size_t i = 0; i < differences.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_new(differences[i] ^ differences[j])) return false;
    }
  }
  return true;
}

/// Three wrong bits that have the difference of two others: five together leave a codeword.
bool has_five(uint32_t polynomial) {
  const std::vector<uint32_t> one = differences_of_bits(kCodewordBits, polynomial);
  std::vector<bool> is_pair(0x10000);
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) is_pair[one[i] ^ one[j]] = true;
  }
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        if (is_pair[one[i] ^ one[j] ^ one[k]]) return true;
      }
    }
  }
  return false;
}

TEST(Crc16, NoPolynomialHasMoreThanFive) {
  uint32_t with_five = 0;
  for (uint32_t polynomial = 1; polynomial < 0x10000; polynomial += 2) {
    if (!finds_four(polynomial)) continue;
    ++with_five;
    ASSERT_TRUE(has_five(polynomial)) << polynomial;
  }
  EXPECT_EQ(with_five, 64u);
}

}  // namespace
}  // namespace palpate::test
