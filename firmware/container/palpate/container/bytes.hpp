// A span of bytes, and integers in it. All integers of a container are little-endian; they are put together
// byte by byte, so neither the machine's byte order nor its alignment matters.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::container {

/// Bytes that somebody else owns: in flash, or a file in memory.
struct Bytes {
  const uint8_t* data;
  uint32_t size;

  /// `offset` + `count` must not pass the end.
  [[nodiscard]] constexpr Bytes part(uint32_t offset, uint32_t count) const {
    return Bytes{data + offset, count};
  }
};

constexpr uint16_t get_u16(const uint8_t* from) {
  return static_cast<uint16_t>(from[0] | static_cast<uint32_t>(from[1]) << 8);
}
constexpr uint32_t get_u32(const uint8_t* from) {
  return get_u16(from) | static_cast<uint32_t>(get_u16(from + 2)) << 16;
}
constexpr uint64_t get_u64(const uint8_t* from) {
  return get_u32(from) | static_cast<uint64_t>(get_u32(from + 4)) << 32;
}

constexpr void put_u16(uint8_t* to, uint16_t value) {
  to[0] = static_cast<uint8_t>(value);
  to[1] = static_cast<uint8_t>(value >> 8);
}
constexpr void put_u32(uint8_t* to, uint32_t value) {
  put_u16(to, static_cast<uint16_t>(value));
  put_u16(to + 2, static_cast<uint16_t>(value >> 16));
}
constexpr void put_u64(uint8_t* to, uint64_t value) {
  put_u32(to, static_cast<uint32_t>(value));
  put_u32(to + 4, static_cast<uint32_t>(value >> 32));
}

/// Any integer type, signed ones in two's complement.
template <class Integer>
constexpr Integer get(const uint8_t* from) {
  static_assert(std::is_integral_v<Integer>, "palpate: a field is an integer");
  if constexpr (sizeof(Integer) == 1) return static_cast<Integer>(from[0]);
  if constexpr (sizeof(Integer) == 2) return static_cast<Integer>(get_u16(from));
  if constexpr (sizeof(Integer) == 4) return static_cast<Integer>(get_u32(from));
  if constexpr (sizeof(Integer) == 8) return static_cast<Integer>(get_u64(from));
}
template <class Integer>
constexpr void put(uint8_t* to, Integer value) {
  static_assert(std::is_integral_v<Integer>, "palpate: a field is an integer");
  if constexpr (sizeof(Integer) == 1) to[0] = static_cast<uint8_t>(value);
  if constexpr (sizeof(Integer) == 2) put_u16(to, static_cast<uint16_t>(value));
  if constexpr (sizeof(Integer) == 4) put_u32(to, static_cast<uint32_t>(value));
  if constexpr (sizeof(Integer) == 8) put_u64(to, static_cast<uint64_t>(value));
}

}  // namespace palpate::container
