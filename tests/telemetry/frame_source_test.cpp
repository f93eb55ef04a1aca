// From ticks to frames: what is sent, when, in which units.
#include "palpate/telemetry/frame_source.hpp"

#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "compiled_stages.hpp"
#include "palpate/telemetry/command.hpp"
#include "support/sample_model.hpp"

namespace palpate::test {
namespace {

using link::MessageType;
using telemetry::FrameSource;
using telemetry::Ring;
using telemetry::TickRecord;

/// What a receiver makes of everything that the source has to send.
template <uint32_t Capacity>
std::vector<link::Frame> sent(FrameSource& source, Ring<TickRecord, Capacity>& ring,
                              link::FrameWriter& writer, const link::ReaderCounters& counters = {}) {
  std::vector<link::Frame> frames;
  link::FrameReader reader;
  link::WireFrame wire{};
  while (source.next(ring, counters, writer, wire)) {
    for (const uint8_t byte : wire) {
      if (reader.push(byte)) frames.push_back(reader.frame());
    }
  }
  EXPECT_EQ(reader.counters().discarded_bytes, 0u);
  return frames;
}

template <class Message>
Message decoded(const link::Frame& frame) {
  Message message{};
  EXPECT_EQ(link::decode(frame, message), link::DecodeStatus::kDone);
  return message;
}

TickRecord sample_record() {
  using phantom::Metre;
  using phantom::Newton;
  using safety::Ampere;
  using safety::Celsius;
  TickRecord record{};
  record.tick = 1000;
  record.flags = 0x1008;
  record.overruns = 3;
  record.raised = safety::ConditionSet::of(safety::Condition::kWarmMotors);
  record.tool = {Metre::ratio(1, 10), Metre::ratio(-26, 100000), Metre::min()};
  record.force = {Newton::ratio(5, 2), Newton::ratio(-1, 1000), Newton::min()};
  record.winding = {Celsius::ratio(25, 1), Celsius::ratio(-1, 2), Celsius::ratio(1001, 10)};
  record.current_limit = {Ampere::ratio(5, 1), Ampere::ratio(124, 100), Ampere::ratio(-1, 1)};
  record.stage_cycles = {10, 11, 12, 13, 14, 15, 16, 0xffffffffu};
  record.motor_codes = {2048, 0, 4095};
  record.state = safety::State::kActive;
  record.fault = firmware::Fault::kParametersRefused;
  record.amplifiers_enabled = true;
  return record;
}

std::vector<link::Frame> frames_of_sample(const link::ReaderCounters& counters = {}) {
  Ring<TickRecord, 2> ring;
  *ring.claim() = sample_record();
  ring.publish();
  FrameSource source(telemetry::Tells::kBody);
  link::FrameWriter writer;
  return sent(source, ring, writer, counters);
}

TEST(FrameSource, SendsATickInTheUnitsOfTheWire) {
  const auto message = decoded<link::TelemetryMessage>(frames_of_sample().at(0));
  EXPECT_EQ(message.tick, 1000u);
  EXPECT_EQ(message.state, 6);
  EXPECT_EQ(message.fault, 3);
  EXPECT_EQ(message.raised, 0x8000);
  // 0.1 m and -0.26 mm; -1 m is beyond 16 bits.
  EXPECT_EQ(message.tool_20_um, (std::array<int16_t, 3>{5000, -13, -32768}));
  EXPECT_EQ(message.force_mn, (std::array<int16_t, 3>{2500, -1, -16000}));
  EXPECT_EQ(message.flags, 0x1008u);
}

TEST(FrameSource, SendsTheCyclesOfAllStages) {
  const auto frames = frames_of_sample();
  const auto first = decoded<link::StageCyclesMessage>(frames.at(1));
  const auto last = decoded<link::StageCyclesMessage>(frames.at(2));
  EXPECT_EQ(first.tick, 1000u);
  EXPECT_EQ(first.part, 0);
  EXPECT_EQ(last.part, 1);
  EXPECT_EQ(first.cycles, (std::array<uint32_t, 4>{10, 11, 12, 13}));
  EXPECT_EQ(last.cycles, (std::array<uint32_t, 4>{14, 15, 16, 0xffffffffu}));
}

TEST(FrameSource, SendsTheMotors) {
  const auto message = decoded<link::MotorsMessage>(frames_of_sample().at(3));
  EXPECT_EQ(message.tick, 1000u);
  EXPECT_EQ(message.codes, (std::array<uint16_t, 3>{2048, 0, 4095}));
  EXPECT_TRUE(message.amplifiers_enabled);
  EXPECT_EQ(message.winding_centi_celsius, (std::array<int16_t, 3>{2500, -50, 10010}));
  // No current is negative on the wire.
  EXPECT_EQ(message.limit_ma, (std::array<uint16_t, 3>{5000, 1240, 0}));
}

TEST(FrameSource, SendsTheCounters) {
  const link::ReaderCounters reader{100, 1, 2, 4, 8, 16, 32, 64, 128};
  const auto frames = frames_of_sample(reader);
  ASSERT_EQ(frames.size(), 5u);
  const auto message = decoded<link::CountersMessage>(frames[4]);
  EXPECT_EQ(message.tick, 1000u);
  EXPECT_EQ(message.dropped_records, 0u);
  EXPECT_EQ(message.overruns, 3u);
  EXPECT_EQ(message.rejected_frames, 31u);
  EXPECT_EQ(message.lost_frames, 32u);
  EXPECT_EQ(message.discarded_bytes, 128u);
}

/// However records and frames are interleaved: each record once, in order, and the others at their pace.
TEST(FrameSource, SendsEveryRecordOnceAndTheRestAtItsPace) {
  Ring<TickRecord, 8> ring;
  FrameSource source(telemetry::Tells::kBody);
  link::FrameWriter writer;
  link::FrameReader reader;
  std::map<MessageType, std::vector<uint32_t>> ticks;
  link::WireFrame wire{};
  for (uint32_t tick = 1; tick <= 1000; ++tick) {
    TickRecord* record = ring.claim();
    ASSERT_NE(record, nullptr);
    record->tick = tick;
    ring.publish();
    // Three frames a tick are enough for all; one call finds nothing in the end.
    for (uint32_t i = 0; i < 3 && source.next(ring, {}, writer, wire); ++i) {
      for (const uint8_t byte : wire) {
        if (reader.push(byte)) {
          ticks[reader.frame().type].push_back(link::load_u32<0>(reader.frame().payload));
        }
      }
    }
  }
  while (source.next(ring, {}, writer, wire)) {
  }
  EXPECT_EQ(reader.counters().lost_frames, 0u);
  EXPECT_EQ(ring.dropped(), 0u);
  ASSERT_EQ(ticks[MessageType::kTelemetry].size(), 1000u);
  for (uint32_t i = 0; i < 1000; ++i) EXPECT_EQ(ticks[MessageType::kTelemetry][i], i + 1);
  EXPECT_EQ(ticks[MessageType::kStageCycles].size(), 200u);
  ASSERT_EQ(ticks[MessageType::kMotors].size(), 100u);
  for (uint32_t i = 0; i < 100; ++i) EXPECT_EQ(ticks[MessageType::kMotors][i], 10 * i + 1);
  ASSERT_EQ(ticks[MessageType::kCounters].size(), 10u);
  for (uint32_t i = 0; i < 10; ++i) EXPECT_EQ(ticks[MessageType::kCounters][i], 100 * i + 1);
}

/// A recorder gets everything: sensors and actuators of each record, inputs where something happened, and
/// room for it by less telemetry.
TEST(FrameSource, TellsADeviceWhole) {
  Ring<TickRecord, 64> ring;
  for (uint32_t tick = 1; tick <= 40; ++tick) {
    TickRecord* record = ring.claim();
    *record = TickRecord{};
    record->tick = tick;
    record->sensors.report.timing = {100 + tick, 100 + tick, tick == 20};
    if (tick == 10) record->sensors.report.requests = safety::EventSet::of(safety::Event::kEnable);
    if (tick == 30)
      record->sensors.report.reported = safety::ConditionSet::of(safety::Condition::kInvariantBroken);
    if (tick == 33) record->sensors.report.change = {4, -7};
    record->is_setting_refused = tick == 33;
    if (tick >= 35) record->sensors.report.timing.tick_number += 5;
    ring.publish();
  }
  FrameSource source(telemetry::Tells::kDevice);
  link::FrameWriter writer;
  std::map<MessageType, std::vector<uint32_t>> ticks;
  for (const link::Frame& frame : sent(source, ring, writer)) {
    ticks[frame.type].push_back(link::load_u32<0>(frame.payload));
    if (frame.type != MessageType::kInputs || ticks[frame.type].back() != 133) continue;
    const auto inputs = decoded<link::InputsMessage>(frame);
    EXPECT_EQ(inputs.setting, 4u);
    EXPECT_EQ(inputs.value, -7);
    EXPECT_TRUE(inputs.is_refused);
  }
  EXPECT_EQ(ticks[MessageType::kSensors].size(), 40u);
  EXPECT_EQ(ticks[MessageType::kActuators].size(), 40u);
  // The first one has no tick before it; then a request, a late cycle, a finding, a change and a gap.
  EXPECT_EQ(ticks[MessageType::kInputs], (std::vector<uint32_t>{101, 110, 120, 130, 133, 140}));
  EXPECT_EQ(ticks[MessageType::kTelemetry], (std::vector<uint32_t>{1, 11, 21, 31}));
}

/// A line that takes nothing for a while costs ticks, which are counted; what waits is the oldest.
TEST(FrameSource, SaysHowManyTicksWereDropped) {
  Ring<TickRecord, 8> ring;
  for (uint32_t tick = 1; tick <= 20; ++tick) {
    if (TickRecord* record = ring.claim()) {
      record->tick = tick;
      ring.publish();
    }
  }
  FrameSource source(telemetry::Tells::kBody);
  link::FrameWriter writer;
  std::vector<uint32_t> ticks;
  for (const link::Frame& frame : sent(source, ring, writer)) {
    if (frame.type == MessageType::kTelemetry) ticks.push_back(decoded<link::TelemetryMessage>(frame).tick);
    if (frame.type == MessageType::kCounters) {
      EXPECT_EQ(decoded<link::CountersMessage>(frame).dropped_records, 12u);
    }
  }
  EXPECT_EQ(ticks, (std::vector<uint32_t>{1, 2, 3, 4, 5, 6, 7, 8}));
}

/// The record of a cycle is what the cycle has.
TEST(TickRecord, IsWhatTheCycleHas) {
  const auto state = std::make_unique<firmware::CycleState<Small>>();
  ASSERT_EQ(firmware::start(*state, sample_model()), Status::kDone);
  firmware::NoProbe probe;
  firmware::Actuators actuators{};
  firmware::Sensors sensors{};
  for (int32_t tick = 0; tick < 20; ++tick) {
    sensors.encoder_counts = {10 * tick, -5 * tick, 3};
    sensors.grasp_button = true;
    firmware::cycle(*state, sensors, actuators, probe);
  }
  TickRecord record{};
  telemetry::fill_record(record, sensors, *state, {1, 2, 3, 4, 5, 6, 7, 8}, 9);
  EXPECT_EQ(record.tick, 20u);
  EXPECT_EQ(record.flags, state->output.flags);
  EXPECT_EQ(record.overruns, 9u);
  EXPECT_EQ(record.motor_codes, actuators.motor_codes);
  EXPECT_EQ(record.amplifiers_enabled, actuators.amplifiers_enabled);
  EXPECT_EQ(record.state, state->safety.state);
  EXPECT_EQ(record.raised, state->safety.raised);
  EXPECT_EQ(record.stage_cycles[7], 8u);
  const Vector3<phantom::Metre> tool = phantom::premium::tool_position(state->posture);
  for (uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(record.tool[i], tool[static_cast<Eigen::Index>(i)]);
    EXPECT_EQ(record.force[i], state->force[static_cast<Eigen::Index>(i)]);
  }
  EXPECT_EQ(record.winding[0], safety::Celsius::ratio(25, 1));
}

TEST(Command, ChangesASetting) {
  const firmware::SettingChange change = telemetry::change_of({0, 4, -7, false});
  EXPECT_EQ(change.setting, 4u);
  EXPECT_EQ(change.value, -7);
}

TEST(Command, AsksTheSafetyLayer) {
  using safety::Event;
  const auto enable = safety::EventSet::of(Event::kEnable) | safety::EventSet::of(Event::kAcknowledge);
  EXPECT_EQ(telemetry::requests_of({enable.bits(), 0, 0, false}).bits(), enable.bits());
  EXPECT_EQ(telemetry::requests_of({~0u, 0, 0, false}).bits(), safety::kRequests.bits());
}

}  // namespace
}  // namespace palpate::test
