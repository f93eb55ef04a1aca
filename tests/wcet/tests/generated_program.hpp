// Random structured programs: nested bounded loops, totals, branches, switches and calls.
#pragma once

#include <cstdint>
#include <string>

namespace palpate::wcet::test {

inline constexpr uint32_t kRoots = 4;

enum class Paths : uint8_t {
  kAny,           // some are never taken
  kKnownMaximum,  // with full = ~0, whatever x is, every loop makes all of its rounds and every branch is
                  // taken
};

/// C++ for the target with the functions root_0 .. root_<kRoots - 1>, each (uint32_t x, uint32_t full). What
/// x leaves open, bits of `full` decide towards more rounds. It prints, a line each, the most instructions
/// that a root took.
std::string generate_program(uint32_t seed, Paths paths = Paths::kAny);

}  // namespace palpate::wcet::test
