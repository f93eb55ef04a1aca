#include "palpate/link/messages.hpp"

#include <gtest/gtest.h>

#include "support/link_messages.hpp"

namespace palpate::test {
namespace {

using link::ActuatorsMessage;
using link::DecodeStatus;
using link::Frame;
using link::Payload;
using link::SensorsMessage;

template <class Message>
DecodeStatus decode_payload(const Payload& payload, Message& message) {
  return link::decode(Frame{Message::kType, 0, payload}, message);
}

TEST(SensorsMessage, HasItsBytesWhereTheDocumentSays) {
  const SensorsMessage message{0x04030201, {0x14131211, -2, INT32_MIN}, {0x2221, 0x3231, 0xffff}, 0x41, true,
                               false};
  const Payload expected{0x01, 0x02, 0x03, 0x04, 0x11, 0x12, 0x13, 0x14, 0xfe, 0xff, 0xff, 0xff,
                         0x00, 0x00, 0x00, 0x80, 0x21, 0x22, 0x31, 0x32, 0xff, 0xff, 0x41, 0x01};
  EXPECT_EQ(link::encode(message), expected);
}

TEST(ActuatorsMessage, HasItsBytesWhereTheDocumentSays) {
  const ActuatorsMessage message{0xfffefdfc, {0x0801, 0x0fff, 0x0203}, {true, false, true}, true, 0x51,
                                 0x64636261};
  const Payload expected{0xfc, 0xfd, 0xfe, 0xff, 0x01, 0x08, 0xff, 0x0f, 0x03, 0x02, 0x05, 0x01,
                         0x61, 0x62, 0x63, 0x64, 0x51, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00};
  EXPECT_EQ(link::encode(message), expected);
}

TEST(SensorsMessage, KeepsStatusBitsApart) {
  for (uint8_t status = 0; status < 4; ++status) {
    Payload payload{};
    payload[23] = status;
    SensorsMessage message{};
    ASSERT_EQ(decode_payload(payload, message), DecodeStatus::kDone);
    EXPECT_EQ(message.emergency_stop_pressed, status % 2 == 1);
    EXPECT_EQ(message.amplifier_fault, status / 2 == 1);
  }
}

template <class Message>
void expect_round_trips(Message (*draw)(Random&)) {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const Message sent = draw(random);
    Message received{};
    ASSERT_EQ(decode_payload(link::encode(sent), received), DecodeStatus::kDone);
    ASSERT_TRUE(is_same(received, sent)) << i;
  }
}

TEST(SensorsMessage, ReturnsFromItsBytes) { expect_round_trips(random_sensors); }
TEST(ActuatorsMessage, ReturnsFromItsBytes) { expect_round_trips(random_actuators); }

/// Every payload is refused or is the one encoding of what it decodes to: no byte is overlooked.
template <class Message>
void expect_one_encoding() {
  uint32_t refused = 0;
  const Payload base = link::encode(Message{});
  for (uint32_t place = 0; place < link::kPayloadSize; ++place) {
    for (uint32_t value = 0; value < 256; ++value) {
      Payload payload = base;
      payload[place] = static_cast<uint8_t>(value);
      Message message{};
      if (decode_payload(payload, message) == DecodeStatus::kBadValue) {
        ++refused;
        ASSERT_TRUE(is_same(message, Message{}));
      } else {
        ASSERT_EQ(link::encode(message), payload) << place;
      }
    }
  }
  // Sensors: 252 values of the status. Actuators: the upper halves of three codes but 16 values each, the
  // enables but 8, the level but 2, and all of seven reserved bytes but 0.
  const bool is_sensors = Message::kType == link::MessageType::kSensors;
  EXPECT_EQ(refused, is_sensors ? 252u : 3 * 240u + 248u + 254u + 7 * 255u);
}

TEST(SensorsMessage, RefusesReservedBits) { expect_one_encoding<SensorsMessage>(); }
TEST(ActuatorsMessage, RefusesValuesOutsideTheirRanges) { expect_one_encoding<ActuatorsMessage>(); }

TEST(Messages, AreOfTheirOwnTypeOnly) {
  SensorsMessage sensors{};
  ActuatorsMessage actuators{};
  EXPECT_EQ(link::decode(Frame{link::MessageType::kActuators, 0, {}}, sensors), DecodeStatus::kOtherType);
  EXPECT_EQ(link::decode(Frame{link::MessageType::kSensors, 0, {}}, actuators), DecodeStatus::kOtherType);
}

}  // namespace
}  // namespace palpate::test
