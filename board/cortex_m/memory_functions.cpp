// The four memory functions that the compiler may call on its own. They serve the background and start-up:
// the cycle copies nothing big enough to need them. Word-wise where both sides allow it.
#include "palpate/numeric/platform.hpp"

namespace {

constexpr uintptr_t kWordMask = sizeof(uint32_t) - 1;

bool is_word_aligned(const void* a, const void* b) {
  return ((reinterpret_cast<uintptr_t>(a) | reinterpret_cast<uintptr_t>(b)) & kWordMask) == 0;
}

using AliasingWord [[gnu::may_alias]] = uint32_t;

}  // namespace

extern "C" {

void* memcpy(void* to, const void* from, size_t size);
void* memmove(void* to, const void* from, size_t size);
void* memset(void* to, int value, size_t size);
int memcmp(const void* a, const void* b, size_t size);

[[gnu::used]] void* memcpy(void* to, const void* from, size_t size) {
  auto* out = static_cast<uint8_t*>(to);
  const auto* in = static_cast<const uint8_t*>(from);
  if (is_word_aligned(to, from)) {
    for (; size >= sizeof(AliasingWord); size -= sizeof(AliasingWord)) {
      *reinterpret_cast<AliasingWord*>(out) = *reinterpret_cast<const AliasingWord*>(in);
      out += sizeof(AliasingWord);
      in += sizeof(AliasingWord);
    }
  }
  for (; size > 0; --size) *out++ = *in++;
  return to;
}

[[gnu::used]] void* memmove(void* to, const void* from, size_t size) {
  auto* out = static_cast<uint8_t*>(to);
  const auto* in = static_cast<const uint8_t*>(from);
  if (out <= in) return memcpy(to, from, size);  // ours goes forward
  while (size > 0) {
    --size;
    out[size] = in[size];
  }
  return to;
}

[[gnu::used]] void* memset(void* to, int value, size_t size) {
  auto* out = static_cast<uint8_t*>(to);
  const auto byte = static_cast<uint8_t>(value);
  if (is_word_aligned(to, to)) {
    const AliasingWord word = byte * 0x0101'0101u;
    for (; size >= sizeof(AliasingWord); size -= sizeof(AliasingWord)) {
      *reinterpret_cast<AliasingWord*>(out) = word;
      out += sizeof(AliasingWord);
    }
  }
  for (; size > 0; --size) *out++ = byte;
  return to;
}

[[gnu::used]] int memcmp(const void* a, const void* b, size_t size) {
  const auto* left = static_cast<const uint8_t*>(a);
  const auto* right = static_cast<const uint8_t*>(b);
  for (; size > 0; --size, ++left, ++right) {
    if (*left != *right) return *left < *right ? -1 : 1;
  }
  return 0;
}

}  // extern "C"
