// What a damaged stream costs: the frames that were hit, no other, and none of them is taken for whole.
#include <gtest/gtest.h>

#include "support/link_reference.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

constexpr std::size_t kBits = 8 * link::kWireSize;

Bytes joined(const std::vector<Bytes>& parts) {
  Bytes stream;
  for (const Bytes& part : parts) append(stream, part);
  return stream;
}

/// Of one type, so that their numbers are their places.
std::vector<Bytes> random_frames(Random& random, std::size_t count) {
  link::FrameWriter writer;
  const link::MessageType type = random_type(random);
  std::vector<Bytes> frames;
  while (frames.size() < count) frames.push_back(written(writer, type, random_payload(random)));
  return frames;
}

std::vector<uint16_t> accepted_sequences(const Bytes& stream) {
  std::vector<uint16_t> sequences;
  for (const link::Frame& frame : read_stream(stream).frames) sequences.push_back(frame.sequence);
  return sequences;
}

void flip(Bytes& stream, std::size_t bit) { stream[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8); }

/// The middle one of three frames is hit: its two neighbours are accepted, and they alone.
void expect_only_the_middle_is_lost(const Bytes& stream) {
  ASSERT_EQ(accepted_sequences(stream), (std::vector<uint16_t>{0, 2}));
}

TEST(LinkErrors, EverySingleBitIsFound) {
  Random random(11);
  for (uint32_t i = 0; i < in_soak(100000u, 300u); ++i) {
    Bytes stream = joined(random_frames(random, 3));
    for (std::size_t bit = kBits; bit < 2 * kBits; ++bit) {
      flip(stream, bit);
      expect_only_the_middle_is_lost(stream);
      flip(stream, bit);
      if (HasFatalFailure()) return;
    }
  }
}

/// Why the check covers the encoded bytes: of this body with its check inside COBS, a single wrong bit makes
/// another body whose check is right.
TEST(LinkErrors, ACheckInsideCobsWouldMissASingleBit) {
  const Bytes body = {0x01, 0x01, 0xa9, 0x09, 0xa9, 0x09, 0x00, 0x00, 0x02, 0x00, 0x03, 0x02, 0x01, 0x01,
                      0x03, 0x03, 0x00, 0x01, 0x01, 0x02, 0x01, 0x00, 0x00, 0x00, 0x00, 0x02, 0x02, 0x02};
  const uint16_t crc = reference_crc(body);
  Bytes plain = body;
  append(plain, {static_cast<uint8_t>(crc / 256), static_cast<uint8_t>(crc % 256)});
  Bytes encoded = reference_cobs(plain);
  flip(encoded, 64);
  const std::optional<Bytes> received = reference_cobs_decoded(encoded);
  ASSERT_TRUE(received);
  const Bytes other(received->begin(), received->end() - 2);
  EXPECT_EQ(other.size(), body.size());
  EXPECT_NE(other, body);
  EXPECT_EQ(reference_crc(other), received->end()[-2] * 256 + received->end()[-1]);

  const Bytes frame = between_zeros(reference_piece(body));
  ASSERT_EQ(accepted_sequences(frame).size(), 1u);
  for (std::size_t bit = 0; bit < kBits; ++bit) {
    Bytes damaged = frame;
    flip(damaged, bit);
    EXPECT_TRUE(accepted_sequences(joined({{0}, damaged, {0}})).empty()) << bit;
  }
}

TEST(LinkErrors, EveryTwoBitsAreFound) {
  Random random(12);
  for (uint32_t i = 0; i < in_soak(1000u, 3u); ++i) {
    Bytes frame = random_frames(random, 1)[0];
    for (std::size_t first = 0; first < kBits; ++first) {
      flip(frame, first);
      for (std::size_t second = first + 1; second < kBits; ++second) {
        flip(frame, second);
        // The zeros of its neighbours.
        ASSERT_TRUE(accepted_sequences(joined({{0}, frame, {0}})).empty()) << first << " " << second;
        flip(frame, second);
      }
      flip(frame, first);
    }
  }
}

TEST(LinkErrors, EveryTwoBytesSideBySideAreFound) {
  Random random(13);
  for (uint32_t i = 0; i < in_soak(20000u, 100u); ++i) {
    const std::vector<Bytes> frames = random_frames(random, 3);
    for (std::size_t place = 1; place + 2 < link::kWireSize; ++place) {
      Bytes stream = joined(frames);
      stream[link::kWireSize + place] ^= static_cast<uint8_t>(1 + random.below(255));
      stream[link::kWireSize + place + 1] ^= static_cast<uint8_t>(random.below(256));
      expect_only_the_middle_is_lost(stream);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(LinkErrors, EveryTruncationIsRejected) {
  Random random(14);
  for (int i = 0; i < 100; ++i) {
    const std::vector<Bytes> frames = random_frames(random, 2);
    for (int size = 0; size < static_cast<int>(link::kWireSize); ++size) {
      const Bytes head(frames[0].begin(), frames[0].begin() + size);
      const Bytes tail(frames[0].end() - size, frames[0].end());
      ASSERT_TRUE(accepted_sequences(head).empty());
      // A new reader begins as after a zero: a frame without its first one is whole.
      ASSERT_EQ(accepted_sequences(tail).size(), size == 33 ? 1u : 0u);
      // The next frame is read, and its first zero stands in for a last one that is missing.
      const std::vector<uint16_t> both = {0, 1};
      const std::vector<uint16_t> next = {1};
      ASSERT_EQ(accepted_sequences(joined({head, frames[1]})), size == 33 ? both : next);
      ASSERT_EQ(accepted_sequences(joined({tail, frames[1]})), size == 33 ? both : next);
    }
  }
}

/// The pieces of a stream that are one of these frames, by number.
std::vector<uint16_t> whole_pieces(const Bytes& stream, const std::vector<Bytes>& frames) {
  std::vector<uint16_t> found;
  auto begin = stream.begin();
  for (auto zero = begin; (zero = std::find(begin, stream.end(), uint8_t{0})) != stream.end();
       begin = zero + 1) {
    const Bytes piece = between_zeros(Bytes(begin, zero));
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (piece == frames[i]) found.push_back(static_cast<uint16_t>(i));
    }
  }
  return found;
}

void expect_splices_found(const std::vector<Bytes>& frames) {
  for (int head = 0; head <= static_cast<int>(link::kWireSize); ++head) {
    for (int tail = 0; tail <= static_cast<int>(link::kWireSize); ++tail) {
      const Bytes splice = joined({Bytes(frames[0].begin(), frames[0].begin() + head),
                                   Bytes(frames[1].begin() + tail, frames[1].end())});
      ASSERT_EQ(accepted_sequences(splice), whole_pieces(splice, frames)) << head << " " << tail;
    }
  }
}

TEST(LinkErrors, EverySpliceOfTwoFramesIsRejected) {
  Random random(15);
  for (int i = 0; i < 40 && !HasFatalFailure(); ++i) expect_splices_found(random_frames(random, 2));
}

/// The message of one tick continued by the same bytes of the next.
TEST(LinkErrors, EverySpliceOfSuccessiveTicksIsRejected) {
  for (uint32_t tick = 0; tick < 600 && !HasFatalFailure(); tick += 15) {
    link::FrameWriter writer;
    link::Payload payload{};
    payload[4] = static_cast<uint8_t>(tick % 100 + 1);
    payload[0] = static_cast<uint8_t>(tick & 0xffu);
    payload[1] = static_cast<uint8_t>(tick >> 8);
    const Bytes first = written(writer, link::MessageType::kSensors, payload);
    payload[0] = static_cast<uint8_t>((tick + 1) & 0xffu);
    payload[1] = static_cast<uint8_t>((tick + 1) >> 8);
    expect_splices_found({first, written(writer, link::MessageType::kSensors, payload)});
  }
}

TEST(LinkErrors, AnInsertedByteLosesOnlyItsFrame) {
  Random random(16);
  for (uint32_t i = 0; i < in_soak(100u, 2u); ++i) {
    const Bytes stream = joined(random_frames(random, 5));
    for (std::size_t place = 0; place <= stream.size(); ++place) {
      const std::size_t within = place % link::kWireSize;
      for (uint32_t value = 0; value < 256; ++value) {
        Bytes damaged = stream;
        damaged.insert(damaged.begin() + static_cast<int>(place), static_cast<uint8_t>(value));
        std::vector<uint16_t> expected = {0, 1, 2, 3, 4};
        // Between two frames nothing is hit, and a zero beside a zero changes nothing.
        const bool is_harmless = within == 0 || (value == 0 && (within == 1 || within == 33));
        if (!is_harmless) expected.erase(expected.begin() + static_cast<int>(place / link::kWireSize));
        ASSERT_EQ(accepted_sequences(damaged), expected) << place << " " << value;
      }
    }
  }
}

TEST(LinkErrors, ADeletedByteLosesOnlyItsFrame) {
  Random random(17);
  for (uint32_t i = 0; i < in_soak(10000u, 50u); ++i) {
    const Bytes stream = joined(random_frames(random, 5));
    for (std::size_t place = 0; place < 4 * link::kWireSize; ++place) {
      Bytes damaged = stream;
      damaged.erase(damaged.begin() + static_cast<int>(place));
      std::vector<uint16_t> expected = {0, 1, 2, 3, 4};
      // Two zeros stand between frames, and one is enough.
      if (stream[place] != 0) expected.erase(expected.begin() + static_cast<int>(place / link::kWireSize));
      ASSERT_EQ(accepted_sequences(damaged), expected) << place;
    }
  }
}

/// Changes one byte in a hundred. Whether it changed any.
bool corrupt(Random& random, Bytes& frame) {
  bool is_hit = false;
  for (uint8_t& byte : frame) {
    if (random.below(100) != 0) continue;
    byte ^= static_cast<uint8_t>(1 + random.below(255));
    is_hit = true;
  }
  return is_hit;
}

/// The test's own books of a noisy line.
struct Books {
  uint64_t whole = 0;          // frames that were not hit
  uint64_t lost = 0;           // hit, between two that were not
  uint64_t wrong = 0;          // hit and yet accepted
  uint64_t hit_in_a_row = 0;   // since the last one that was not
  uint64_t nonzero_bytes = 0;  // as received

  void note(bool is_hit, const Bytes& received) {
    nonzero_bytes +=
        received.size() - static_cast<std::size_t>(std::count(received.begin(), received.end(), 0));
    if (is_hit) {
      ++hit_in_a_row;
      return;
    }
    if (whole != 0) lost += hit_in_a_row;
    hit_in_a_row = 0;
    ++whole;
  }
};

/// In the seeded slice no bad frame is accepted. A longer run meets what the check's 16 bits must let through
/// at such a rate of errors: frames hit twice or more often, about one in 65536 of them.
TEST(LinkErrors, OfANoisyStreamExactlyTheHitFramesAreLost) {
  Random random(18);
  link::FrameWriter writer;
  link::FrameReader reader;
  Books books;
  const auto frames = in_soak(uint64_t{10000000}, uint64_t{50000});
  for (uint64_t i = 0; i < frames; ++i) {
    const Bytes sent = written(writer, link::MessageType::kTelemetry, random_payload(random));
    Bytes received = sent;
    const bool is_hit = corrupt(random, received);
    books.note(is_hit, received);
    bool is_accepted = false;
    for (const uint8_t byte : received) is_accepted = reader.push(byte) || is_accepted;
    if (is_hit) books.wrong += is_accepted ? 1 : 0;
    ASSERT_TRUE(is_hit || is_accepted) << i;
    ASSERT_TRUE(is_hit || reader.frame().sequence == i % 65536) << i;
  }
  const link::ReaderCounters& counters = reader.counters();
  std::printf("noisy line: %llu frames, %llu hit, %llu bad ones accepted\n",
              static_cast<unsigned long long>(frames), static_cast<unsigned long long>(frames - books.whole),
              static_cast<unsigned long long>(books.wrong));
  EXPECT_LE(books.wrong, frames * 2 / 1000000);
  EXPECT_EQ(counters.accepted, books.whole + books.wrong);
  EXPECT_EQ(counters.discarded_bytes,
            (books.nonzero_bytes - 32 * uint64_t{counters.accepted}) % (uint64_t{1} << 32));
  EXPECT_TRUE(books.wrong != 0 || counters.lost_frames == books.lost);
}

}  // namespace
}  // namespace palpate::test
