// What was seen of a root, beside what its analysis says of it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bound.hpp"
#include "plugin/counts.hpp"
#include "worst_path.hpp"

namespace palpate::wcet {

/// A block that never ran.
struct UncoveredBlock {
  Place place;
  size_t instructions;
};

struct LoopSeen {
  uint32_t id;
  uint32_t bound;
  std::string function;  // whose calls the fact holds in
  Place body;
  LoopCounts seen;

  [[nodiscard]] bool is_over() const { return seen.most_excess > 0; }
};

struct FunctionSeen {
  std::string name;
  std::optional<Cycles> bound;  // of a call; none for one whose loops count for its callers
  double on_worst_path;         // with callees, all calls of the root's worst path
  FunctionCounts seen;
};

/// How often a block runs on the root's worst path, and how often it did in the longest invocation.
struct BlockSeen {
  Place place;
  size_t instructions;
  double on_worst_path;
  uint64_t in_longest;

  /// In instructions: what the bound has more.
  [[nodiscard]] double gap() const {
    return static_cast<double>(instructions) * (on_worst_path - static_cast<double>(in_longest));
  }
};

struct Measurement {
  std::string root;
  Cycles bound = 0;
  uint64_t invocations = 0;
  uint64_t longest = 0;   // instructions
  size_t longest_at = 0;  // which invocation, from 0
  size_t blocks = 0;
  std::vector<UncoveredBlock> uncovered;
  std::vector<Way> outside;  // of the graph; a lone instruction leads to itself
  std::vector<LoopSeen> loops;
  std::vector<FunctionSeen> functions;
  std::vector<BlockSeen> gaps;  // blocks of which the bound has more, the largest gap first

  [[nodiscard]] double coverage_percent() const;
  /// Bound over the most that was seen.
  [[nodiscard]] double ratio() const;
};

/// Throws Refusal where the run left the program's flow, RunFailed where the root did not run to its end.
Measurement measure(const Program& program, const CallGraph& calls, const BoundAnalysis& bounds,
                    const Counts& counts);

/// What must hold, as sentences about what does not.
std::vector<std::string> broken_gates(const Program& program, const Measurement& measurement);

void print(const Measurement& measurement);
nlohmann::json to_json(const Program& program, const Measurement& measurement);

}  // namespace palpate::wcet
