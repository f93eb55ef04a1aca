#include "palpate/link/messages.hpp"

#include <gtest/gtest.h>

#include "support/link_checks.hpp"

namespace palpate::test {
namespace {

using link::ActuatorsMessage;
using link::DecodeStatus;
using link::Frame;
using link::Payload;
using link::SensorsMessage;

TEST(SensorsMessage, HasItsBytesWhereTheDocumentSays) {
  const SensorsMessage message{
      0x04030201, {0x14131211, -2, INT32_MIN}, {0x2221, 0x3231, 0xffff}, 0x41, true, false, true};
  const Payload expected{0x01, 0x02, 0x03, 0x04, 0x11, 0x12, 0x13, 0x14, 0xfe, 0xff, 0xff, 0xff,
                         0x00, 0x00, 0x00, 0x80, 0x21, 0x22, 0x31, 0x32, 0xff, 0xff, 0x41, 0x05};
  EXPECT_EQ(link::encode(message), expected);
}

TEST(ActuatorsMessage, HasItsBytesWhereTheDocumentSays) {
  const ActuatorsMessage message{
      0xfffefdfc, {0x0801, 0x0fff, 0x0203}, {true, false, true}, true, 0x51, 0x31, 0x4241, 0x64636261};
  const Payload expected{0xfc, 0xfd, 0xfe, 0xff, 0x01, 0x08, 0xff, 0x0f, 0x03, 0x02, 0x05, 0x01,
                         0x61, 0x62, 0x63, 0x64, 0x51, 0x31, 0x41, 0x42, 0x00, 0x00, 0x00, 0x00};
  EXPECT_EQ(link::encode(message), expected);
}

TEST(SensorsMessage, KeepsStatusBitsApart) {
  for (uint8_t status = 0; status < 8; ++status) {
    Payload payload{};
    payload[23] = status;
    SensorsMessage message{};
    ASSERT_EQ(decode_payload(payload, message), DecodeStatus::kDone);
    EXPECT_EQ(message.emergency_stop_pressed, status % 2 == 1);
    EXPECT_EQ(message.amplifier_fault, status / 2 % 2 == 1);
    EXPECT_EQ(message.amplifiers_cut, status / 4 == 1);
  }
}

TEST(SensorsMessage, ReturnsFromItsBytes) { expect_round_trips(random_sensors); }
TEST(ActuatorsMessage, ReturnsFromItsBytes) { expect_round_trips(random_actuators); }

/// All values of the status but 8.
TEST(SensorsMessage, RefusesReservedBits) { expect_one_encoding<SensorsMessage>(248); }
/// The upper halves of three codes but 16 values each, the enables but 8, the level but 2, and all of four
/// reserved bytes but 0.
TEST(ActuatorsMessage, RefusesValuesOutsideTheirRanges) {
  expect_one_encoding<ActuatorsMessage>(3 * 240 + 248 + 254 + 4 * 255);
}

TEST(Messages, AreOfTheirOwnTypeOnly) {
  SensorsMessage sensors{};
  ActuatorsMessage actuators{};
  EXPECT_EQ(link::decode(Frame{link::MessageType::kActuators, 0, {}}, sensors), DecodeStatus::kOtherType);
  EXPECT_EQ(link::decode(Frame{link::MessageType::kSensors, 0, {}}, actuators), DecodeStatus::kOtherType);
}

}  // namespace
}  // namespace palpate::test
