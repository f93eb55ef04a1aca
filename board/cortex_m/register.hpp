// Device registers.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::cortex_m {

/// The register of this width at an address that is known when the program is built.
template <uint32_t Address, class Word>
struct RegisterOf {
  static constexpr uint32_t kAddress = Address;

  PALPATE_ALWAYS_INLINE static uint32_t read() { return *pointer(); }
  PALPATE_ALWAYS_INLINE static void write(uint32_t value) { *pointer() = static_cast<Word>(value); }
  /// The bits of the mask become those of value: two accesses.
  PALPATE_ALWAYS_INLINE static void change(uint32_t mask, uint32_t value) {
    write((read() & ~mask) | (value & mask));
  }
  PALPATE_ALWAYS_INLINE static void set(uint32_t bits) { change(bits, bits); }
  PALPATE_ALWAYS_INLINE static void clear(uint32_t bits) { change(bits, 0); }

 private:
  PALPATE_ALWAYS_INLINE static volatile Word* pointer() {
    return reinterpret_cast<volatile Word*>(Address);  // NOLINT(performance-no-int-to-ptr)
  }
};

template <uint32_t Address>
using Register = RegisterOf<Address, uint32_t>;
template <uint32_t Address>
using HalfRegister = RegisterOf<Address, uint16_t>;

/// Waits until the register's bits under the mask are these, but not for ever. For start-up alone: a part
/// that never answers is then named, and does not hang the board.
template <class Place>
[[nodiscard]] bool wait_until(uint32_t mask, uint32_t value) {
  constexpr uint32_t kMostReads = 1'000'000;
  for (uint32_t reads = 0; reads < kMostReads; ++reads) {
    if ((Place::read() & mask) == value) return true;
  }
  return false;
}

/// All earlier accesses are done before the next instruction.
PALPATE_ALWAYS_INLINE void synchronize() { asm volatile("dsb\n\tisb" ::: "memory"); }

}  // namespace palpate::cortex_m
