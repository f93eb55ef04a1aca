// What was counted, and the file that the plugin leaves. Lines of words, addresses in hexadecimal:
//
//   invocation INSTRUCTIONS              of the root, one line each, in order
//   spot ADDRESS COUNT LONGEST           an instruction: how often in all invocations, and in the longest one
//   edge FROM TO COUNT                   from an instruction that may lead elsewhere to what came next
//   function ENTRY CALLS MOST TICK LONGEST
//                                        instructions with callees: at most in a call, at most in an
//                                        invocation, and in the longest invocation
//   loop FUNCTION FACT ENTRIES BODIES ROUNDS EXCESS
//                                        of all calls of a closed function; ROUNDS: most bodies after an
//                                        entry; EXCESS: most bodies - bound x entries of a call
//   stray FROM TO                        the run left the flow of the program here, as for an interrupt
//   unfinished                           the run ended within the root
#pragma once

#include <cstdint>
#include <istream>
#include <map>
#include <optional>
#include <ostream>
#include <utility>
#include <vector>

namespace palpate::wcet {

struct SpotCounts {
  uint64_t all = 0;
  uint64_t in_longest = 0;
};

struct FunctionCounts {
  uint64_t calls = 0;
  uint64_t most = 0;
  uint64_t most_in_invocation = 0;
  uint64_t in_longest = 0;
};

struct LoopCounts {
  uint64_t entries = 0;
  uint64_t bodies = 0;
  uint64_t most_rounds = 0;
  int64_t most_excess = INT64_MIN;
};

using Way = std::pair<uint32_t, uint32_t>;  // from and to

struct Counts {
  std::vector<uint64_t> invocations;
  std::map<uint32_t, SpotCounts> spots;
  std::map<Way, uint64_t> edges;
  std::map<uint32_t, FunctionCounts> functions;             // by entry
  std::map<std::pair<uint32_t, size_t>, LoopCounts> loops;  // by function and fact
  std::optional<Way> stray;
  bool is_unfinished = false;
};

void write_counts(const Counts& counts, std::ostream& to);
/// Throws std::runtime_error with the line that is none.
Counts read_counts(std::istream& from);

}  // namespace palpate::wcet
