#include "palpate/link/telemetry_messages.hpp"

#include <gtest/gtest.h>

#include "support/link_checks.hpp"

namespace palpate::test {
namespace {

using link::CommandMessage;
using link::CountersMessage;
using link::DecodeStatus;
using link::Frame;
using link::MessageType;
using link::MotorsMessage;
using link::Payload;
using link::StageCyclesMessage;
using link::TelemetryMessage;

TEST(CommandMessage, HasItsBytesWhereTheDocumentSays) {
  const Payload expected{0x00, 0x10, 0x84, 0x01, 0x12, 0x11, 0x01, 0x00, 0xfe, 0xff, 0xff, 0xff};
  EXPECT_EQ(link::encode(CommandMessage{0x01841000, 0x1112, -2, true}), expected);
}

TEST(TelemetryMessage, HasItsBytesWhereTheDocumentSays) {
  const TelemetryMessage message{0x04030201,          6,         0x51, 0x6261, {0x7271, -2, 3},
                                 {4, -32768, 0x0605}, 0x84838281};
  const Payload expected{0x01, 0x02, 0x03, 0x04, 0x06, 0x51, 0x61, 0x62, 0x71, 0x72, 0xfe, 0xff,
                         0x03, 0x00, 0x04, 0x00, 0x00, 0x80, 0x05, 0x06, 0x81, 0x82, 0x83, 0x84};
  EXPECT_EQ(link::encode(message), expected);
}

TEST(StageCyclesMessage, HasItsBytesWhereTheDocumentSays) {
  const StageCyclesMessage message{0x04030201, 1, {0x14131211, 2, 3, 0x44434241}};
  const Payload expected{0x01, 0x02, 0x03, 0x04, 0x01, 0x00, 0x00, 0x00, 0x11, 0x12, 0x13, 0x14,
                         0x02, 0x00, 0x00, 0x00, 0x03, 0x00, 0x00, 0x00, 0x41, 0x42, 0x43, 0x44};
  EXPECT_EQ(link::encode(message), expected);
}

TEST(CountersMessage, HasItsBytesWhereTheDocumentSays) {
  const CountersMessage message{0x04030201, 2, 3, 4, 5, 0x64636261};
  const Payload expected{0x01, 0x02, 0x03, 0x04, 0x02, 0x00, 0x00, 0x00, 0x03, 0x00, 0x00, 0x00,
                         0x04, 0x00, 0x00, 0x00, 0x05, 0x00, 0x00, 0x00, 0x61, 0x62, 0x63, 0x64};
  EXPECT_EQ(link::encode(message), expected);
}

TEST(MotorsMessage, HasItsBytesWhereTheDocumentSays) {
  const MotorsMessage message{0x04030201, {0x0801, 0x0fff, 3}, true, {0x1211, -2, 3}, {0x2221, 5, 0xffff}};
  const Payload expected{0x01, 0x02, 0x03, 0x04, 0x01, 0x08, 0xff, 0x0f, 0x03, 0x00, 0x01, 0x00,
                         0x11, 0x12, 0xfe, 0xff, 0x03, 0x00, 0x21, 0x22, 0x05, 0x00, 0xff, 0xff};
  EXPECT_EQ(link::encode(message), expected);
}

TEST(InputsMessage, HasItsBytesWhereTheDocumentSays) {
  const link::InputsMessage message{0x04030201, 0x14131211, 0x01841000, 0x34333231, true, true, 0x5251, -2};
  const Payload expected{0x01, 0x02, 0x03, 0x04, 0x11, 0x12, 0x13, 0x14, 0x00, 0x10, 0x84, 0x01,
                         0x31, 0x32, 0x33, 0x34, 0x01, 0x01, 0x51, 0x52, 0xfe, 0xff, 0xff, 0xff};
  EXPECT_EQ(link::encode(message), expected);
}

TEST(InputsMessage, ReturnsFromItsBytes) { expect_round_trips(random_inputs); }
/// The bits of requests but 0, 2, 6 and 1 of a byte's 8; of a byte that is 0 or 1 all others; a value or a
/// refusal without a setting.
TEST(InputsMessage, RefusesWhatCannotHaveEntered) {
  expect_one_encoding<link::InputsMessage>(255 + 252 + 192 + 254 + 254 + 5 * 255);
}
TEST(CommandMessage, ReturnsFromItsBytes) { expect_round_trips(random_command); }
TEST(TelemetryMessage, ReturnsFromItsBytes) { expect_round_trips(random_telemetry); }
TEST(StageCyclesMessage, ReturnsFromItsBytes) { expect_round_trips(random_stage_cycles); }
TEST(CountersMessage, ReturnsFromItsBytes) { expect_round_trips(random_counters); }
TEST(MotorsMessage, ReturnsFromItsBytes) { expect_round_trips(random_motors); }

/// The bits of requests but 0, 2, 6 and 1 of a byte's 8, a value without a setting, 14 reserved bytes.
TEST(CommandMessage, RefusesWhatCannotBeAskedFor) {
  expect_one_encoding<CommandMessage>(255 + 252 + 192 + 254 + 4 * 255 + 254 + 13 * 255);
}
TEST(TelemetryMessage, RefusesOtherStates) { expect_one_encoding<TelemetryMessage>(248); }
TEST(StageCyclesMessage, RefusesOtherParts) { expect_one_encoding<StageCyclesMessage>(254 + 3 * 255); }
TEST(CountersMessage, TakesAllValues) { expect_one_encoding<CountersMessage>(0); }
TEST(MotorsMessage, RefusesValuesOutsideTheirRanges) {
  expect_one_encoding<MotorsMessage>(3 * 240 + 254 + 255);
}

/// Any value may be set once there is a setting.
TEST(CommandMessage, TakesEveryValueOfASetting) {
  for (const int32_t value : {0, 1, -1, INT32_MIN, INT32_MAX}) {
    CommandMessage message{};
    ASSERT_EQ(decode_payload(link::encode(CommandMessage{0, 1, value, false}), message), DecodeStatus::kDone);
    EXPECT_EQ(message.value, value);
  }
}

/// Only a frame of its own type is a message.
template <class Message>
void expect_own_type_only() {
  for (uint8_t type = 0; type < 10; ++type) {
    Message message{};
    const bool is_own = static_cast<MessageType>(type) == Message::kType;
    const Frame frame{static_cast<MessageType>(type), 0, link::encode(Message{})};
    EXPECT_EQ(link::decode(frame, message), is_own ? DecodeStatus::kDone : DecodeStatus::kOtherType);
  }
}

TEST(TelemetryMessages, AreOfTheirOwnTypeOnly) {
  expect_own_type_only<CommandMessage>();
  expect_own_type_only<TelemetryMessage>();
  expect_own_type_only<StageCyclesMessage>();
  expect_own_type_only<CountersMessage>();
  expect_own_type_only<MotorsMessage>();
  expect_own_type_only<link::InputsMessage>();
}

}  // namespace
}  // namespace palpate::test
