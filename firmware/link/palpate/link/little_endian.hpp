// Numbers in a payload, the low byte first, at a place that is checked when it is compiled. The processor's
// own order and alignment do not matter.
#pragma once

#include "palpate/link/frame.hpp"

namespace palpate::link {

template <std::size_t At>
constexpr void store_u8(Payload& payload, uint8_t value) {
  static_assert(At < kPayloadSize);
  payload[At] = value;
}

template <std::size_t At>
constexpr void store_u16(Payload& payload, uint16_t value) {
  store_u8<At>(payload, static_cast<uint8_t>(value & 0xffu));
  store_u8<At + 1>(payload, static_cast<uint8_t>(value >> 8));
}

template <std::size_t At>
constexpr void store_u32(Payload& payload, uint32_t value) {
  store_u16<At>(payload, static_cast<uint16_t>(value & 0xffffu));
  store_u16<At + 2>(payload, static_cast<uint16_t>(value >> 16));
}

template <std::size_t At>
constexpr void store_i16(Payload& payload, int16_t value) {
  store_u16<At>(payload, static_cast<uint16_t>(value));
}

template <std::size_t At>
constexpr void store_i32(Payload& payload, int32_t value) {
  store_u32<At>(payload, static_cast<uint32_t>(value));
}

template <std::size_t At>
constexpr uint8_t load_u8(const Payload& payload) {
  static_assert(At < kPayloadSize);
  return payload[At];
}

template <std::size_t At>
constexpr uint16_t load_u16(const Payload& payload) {
  return static_cast<uint16_t>(load_u8<At>(payload) | uint32_t{load_u8<At + 1>(payload)} << 8);
}

template <std::size_t At>
constexpr uint32_t load_u32(const Payload& payload) {
  return load_u16<At>(payload) | uint32_t{load_u16<At + 2>(payload)} << 16;
}

/// Two's complement.
template <std::size_t At>
constexpr int16_t load_i16(const Payload& payload) {
  return static_cast<int16_t>(load_u16<At>(payload));
}

template <std::size_t At>
constexpr int32_t load_i32(const Payload& payload) {
  return static_cast<int32_t>(load_u32<At>(payload));
}

}  // namespace palpate::link
