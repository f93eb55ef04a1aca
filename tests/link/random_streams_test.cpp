// The fuzzer's harness on seeded scripts.
#include <gtest/gtest.h>

#include "fuzz/link_harness.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

Bytes random_script(Random& random) {
  Bytes script(random.below(256));
  for (uint8_t& byte : script) byte = static_cast<uint8_t>(random.bits());
  return script;
}

TEST(RandomStreams, AreReadAsTheReferenceReadsThem) {
  Random random(21);
  link::ReaderCounters reached{};
  for (uint32_t i = 0; i < in_soak(1000000u, 5000u); ++i) {
    const Bytes script = random_script(random);
    ASSERT_TRUE(reads_rightly(script.data(), script.size())) << i;
    const link::ReaderCounters counters = read_stream(wire_stream(script.data(), script.size())).counters;
    reached.accepted += counters.accepted;
    reached.bad_lengths += counters.bad_lengths;
    reached.crc_failures += counters.crc_failures;
    reached.bad_blocks += counters.bad_blocks;
    reached.bad_versions += counters.bad_versions;
    reached.bad_types += counters.bad_types;
    reached.lost_frames += counters.lost_frames;
    reached.restarts += counters.restarts;
  }
  // The scripts reach every verdict.
  reached.discarded_bytes = 1;
  for (const uint32_t count : listed(reached)) EXPECT_GT(count, 0u);
}

/// The harness objects to a reader that is wrong: here, to a reference that is told another stream.
TEST(RandomStreams, TellTwoReadingsApart) {
  link::FrameWriter writer;
  const Bytes frame = written(writer, link::MessageType::kSensors, link::Payload{1});
  const Reading reading = read_stream(frame);
  for (std::size_t place = 0; place < frame.size(); ++place) {
    Bytes other = frame;
    other[place] ^= 0x10;
    EXPECT_FALSE(is_same(reading, reference_read(other))) << place;
  }
  Reading altered = reading;
  altered.frames[0].payload[23] ^= 1;
  EXPECT_FALSE(is_same(reading, altered));
  EXPECT_FALSE(are_all_bytes_counted(Bytes(40, 1), reading.counters) &&
               are_all_bytes_counted(Bytes(31, 1), reading.counters));
}

}  // namespace
}  // namespace palpate::test
