// Writer and reader against the protocol's other implementation, and each counter by itself.
#include <gtest/gtest.h>

#include <map>

#include "support/link_messages.hpp"
#include "support/link_reference.hpp"

namespace palpate::test {
namespace {

using link::FrameReader;
using link::FrameWriter;
using link::MessageType;
using link::ReaderCounters;

Bytes framed(uint8_t version, uint8_t type, uint16_t sequence) {
  return between_zeros(reference_piece(reference_body(version, type, sequence, Bytes(24, 7))));
}

TEST(FrameWriter, WritesWhatTheDocumentSays) {
  Random random(5);
  FrameWriter writer;
  std::map<MessageType, uint16_t> written_frames;
  for (uint32_t i = 0; i < 500000; ++i) {
    const MessageType type = random_type(random);
    const link::Payload payload = random_payload(random);
    const Bytes body = reference_body(1, static_cast<uint8_t>(type), written_frames[type]++,
                                      Bytes(payload.begin(), payload.end()));
    const Bytes wire = written(writer, type, payload);
    ASSERT_EQ(wire, between_zeros(reference_piece(body))) << i;
    ASSERT_EQ(std::count(wire.begin(), wire.end(), 0), 2);
  }
}

template <class Message>
void expect_round_trip(Message (*draw)(Random&)) {
  Random random(6);
  FrameWriter writer;
  FrameReader reader;
  for (uint32_t i = 0; i < 20000; ++i) {
    const Message sent = draw(random);
    const Reading reading = read_on(reader, written(writer, Message::kType, link::encode(sent)));
    ASSERT_EQ(reading.frames.size(), 1u);
    ASSERT_EQ(reading.frames[0].sequence, i);
    Message received{};
    ASSERT_EQ(link::decode(reading.frames[0], received), link::DecodeStatus::kDone);
    ASSERT_TRUE(is_same(received, sent));
  }
  ReaderCounters expected{};
  expected.accepted = 20000;
  EXPECT_EQ(listed(reader.counters()), listed(expected));
}

TEST(FrameReader, ReturnsSensors) { expect_round_trip(random_sensors); }
TEST(FrameReader, ReturnsActuators) { expect_round_trip(random_actuators); }
TEST(FrameReader, ReturnsCommands) { expect_round_trip(random_command); }
TEST(FrameReader, ReturnsTelemetry) { expect_round_trip(random_telemetry); }
TEST(FrameReader, ReturnsStageCycles) { expect_round_trip(random_stage_cycles); }
TEST(FrameReader, ReturnsCounters) { expect_round_trip(random_counters); }
TEST(FrameReader, ReturnsMotors) { expect_round_trip(random_motors); }

TEST(FrameReader, YieldsTheFrameWithItsLastByteAndNotBefore) {
  FrameReader reader;
  const Bytes frame = framed(1, 2, 0x1234);
  for (std::size_t i = 0; i < frame.size(); ++i) EXPECT_EQ(reader.push(frame[i]), i + 1 == frame.size());
  EXPECT_EQ(reader.frame().sequence, 0x1234);
  EXPECT_EQ(reader.frame().type, MessageType::kActuators);
  EXPECT_FALSE(reader.push(0));
}

struct Verdict {
  const char* name;
  Bytes stream;
  ReaderCounters expected;
};

ReaderCounters only(uint32_t ReaderCounters::*counter, uint32_t discarded) {
  ReaderCounters counters{};
  counters.*counter = 1;
  counters.discarded_bytes = discarded;
  return counters;
}

/// A right check over a distance that points beyond the end.
Bytes cut_block() {
  Bytes piece(29, 9);
  piece[27] = 3;
  append(piece, check_bytes(piece));
  return between_zeros(piece);
}

Bytes with_wrong_check() {
  Bytes frame = framed(1, 1, 0);
  frame[32] ^= 1;
  return frame;
}

std::vector<Verdict> verdicts() {
  using C = ReaderCounters;
  const Bytes body(27, 5);
  const Bytes longer(29, 5);
  return {
      {"a frame", framed(1, 1, 9), only(&C::accepted, 0)},
      {"a wrong check", with_wrong_check(), only(&C::crc_failures, 32)},
      {"a byte", {0, 5, 0}, only(&C::bad_lengths, 1)},
      {"three bytes that are the check of nothing", {0, 0xcf, 0xff, 0xff, 0}, only(&C::bad_lengths, 3)},
      {"a whole piece that is short", between_zeros(reference_piece(body)), only(&C::bad_lengths, 31)},
      {"a whole piece that is long", between_zeros(reference_piece(longer)), only(&C::bad_lengths, 33)},
      {"noise without a zero", between_zeros(Bytes(100000, 5)), only(&C::bad_lengths, 100000)},
      {"a block cut short", cut_block(), only(&C::bad_blocks, 32)},
      {"version 0", framed(0, 1, 9), only(&C::bad_versions, 32)},
      {"version 2", framed(2, 1, 9), only(&C::bad_versions, 32)},
      {"version 2 with its own types", framed(2, 9, 9), only(&C::bad_versions, 32)},
      {"type 0", framed(1, 0, 9), only(&C::bad_types, 32)},
      {"type 8", framed(1, 8, 9), only(&C::accepted, 0)},
      {"type 9", framed(1, 9, 9), only(&C::bad_types, 32)},
      {"nothing", {}, {}},
      {"zeros", Bytes(1000, 0), {}},
  };
}

TEST(FrameReader, CountsEachCauseByItself) {
  for (const Verdict& verdict : verdicts()) {
    Bytes stream = verdict.stream;
    EXPECT_EQ(listed(read_stream(stream).counters), listed(verdict.expected)) << verdict.name;
    // Whatever it was, the next frame is read.
    append(stream, framed(1, 2, 10));
    EXPECT_EQ(read_stream(stream).counters.accepted, verdict.expected.accepted + 1) << verdict.name;
  }
}

struct Step {
  uint16_t sequence;
  uint32_t lost, restarts;
};

TEST(FrameReader, TellsLostFramesFromARestart) {
  FrameReader reader;
  const std::vector<Step> steps = {{500, 0, 0},       {501, 0, 0},       {503, 1, 0},   {600, 97, 0},
                                   {600, 97, 1},      {601, 97, 1},      {0, 97, 2},    {1, 97, 2},
                                   {32769, 32864, 2}, {32770, 32864, 2}, {3, 32864, 3}, {65535, 32864, 4},
                                   {0, 32864, 4},     {2, 32865, 4}};
  for (const Step& step : steps) {
    const ReaderCounters counters = read_on(reader, framed(1, 1, step.sequence)).counters;
    EXPECT_EQ(counters.lost_frames, step.lost) << step.sequence;
    EXPECT_EQ(counters.restarts, step.restarts) << step.sequence;
  }
}

}  // namespace
}  // namespace palpate::test
