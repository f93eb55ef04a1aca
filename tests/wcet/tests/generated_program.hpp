// Random structured programs: nested bounded loops, totals, branches, switches and calls.
#pragma once

#include <cstdint>
#include <string>

namespace palpate::wcet::test {

inline constexpr uint32_t kRoots = 4;

/// C++ for the target with the functions root_0 .. root_<kRoots - 1>, each (uint32_t x, uint32_t full). What
/// x leaves open, bits of `full` decide towards more rounds. It prints, a line each, the most instructions
/// that a root took.
std::string generate_program(uint32_t seed);

}  // namespace palpate::wcet::test
