// Calls to the debugger or emulator (Arm, "Semihosting for AArch32 and AArch64", release 2.0).
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::mps2 {

enum class Semihosting : uint32_t {
  kOpen = 0x01,
  kWrite = 0x05,
  kRead = 0x06,
  kCommandLine = 0x15,
  kExitExtended = 0x20
};

using SemihostingParameters = std::array<uint32_t, 3>;

inline uint32_t semihosting_call(Semihosting operation, const SemihostingParameters& parameters) {
  const auto number = static_cast<uint32_t>(operation);
  register uint32_t result asm("r0") = number;
  register const uint32_t* block asm("r1") = parameters.data();
  asm volatile("bkpt 0xAB" : "+r"(result) : "r"(block) : "memory");
  return result;
}

/// Addresses have 32 bits here.
inline uint32_t address_of(const void* place) {
  return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(place));
}

}  // namespace palpate::mps2
