// What must hold of every message: it comes back from its bytes, and no byte of a payload is overlooked.
#pragma once

#include <gtest/gtest.h>

#include "support/link_messages.hpp"

namespace palpate::test {

template <class Message>
link::DecodeStatus decode_payload(const link::Payload& payload, Message& message) {
  return link::decode(link::Frame{Message::kType, 0, payload}, message);
}

template <class Message>
void expect_round_trips(Message (*draw)(Random&)) {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const Message sent = draw(random);
    Message received{};
    ASSERT_EQ(decode_payload(link::encode(sent), received), link::DecodeStatus::kDone);
    ASSERT_TRUE(is_same(received, sent)) << i;
  }
}

/// Every payload is refused or is the one encoding of what it decodes to: no byte is overlooked. So many of
/// those that differ from an empty message's in one byte are refused.
template <class Message>
void expect_one_encoding(uint32_t expected_refusals) {
  uint32_t refused = 0;
  const link::Payload base = link::encode(Message{});
  for (uint32_t place = 0; place < link::kPayloadSize; ++place) {
    for (uint32_t value = 0; value < 256; ++value) {
      link::Payload payload = base;
      payload[place] = static_cast<uint8_t>(value);
      Message message{};
      if (decode_payload(payload, message) == link::DecodeStatus::kBadValue) {
        ++refused;
        ASSERT_TRUE(is_same(message, Message{}));
      } else {
        ASSERT_EQ(link::encode(message), payload) << place;
      }
    }
  }
  EXPECT_EQ(refused, expected_refusals);
}

}  // namespace palpate::test
