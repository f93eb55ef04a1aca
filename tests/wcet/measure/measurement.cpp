#include "measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "counted_run.hpp"

namespace palpate::wcet {
namespace {

void refuse_broken_runs(const Program& program, const Counts& counts) {
  if (counts.stray) {
    const auto [from, to] = *counts.stray;
    throw Refusal(
        program.place(from),
        fmt::format("it went on at {:#x}, where the graph does not lead (or an interrupt came)", to));
  }
  if (counts.is_unfinished) throw RunFailed("the run ended within the root");
  if (counts.invocations.empty()) throw RunFailed("the run never came to the root");
}

/// Of a block's last instruction.
bool leads_to(const FunctionGraph& graph, const Block& block, uint32_t to) {
  return std::any_of(block.edges.begin(), block.edges.end(), [&](const Edge& edge) {
    if (edge.callee) return *edge.callee == to;
    // That a return comes back behind its call is known from the run.
    if (edge.to == kReturns) return to != block.last().next();
    return edge.to != kEnds && graph.blocks[edge.to].address() == to;
  });
}

class Joining {
 public:
  Joining(const Program& program, const CallGraph& calls, const BoundAnalysis& bounds, const Counts& counts)
      : program_(program), calls_(calls), bounds_(bounds), counts_(counts) {}

  Measurement run() {
    result_.root = calls_.functions().back().name;
    result_.bound = bounds_.bound();
    result_.invocations = counts_.invocations.size();
    const auto longest = std::max_element(counts_.invocations.begin(), counts_.invocations.end());
    result_.longest = *longest;
    result_.longest_at = static_cast<size_t>(longest - counts_.invocations.begin());
    for (const FunctionGraph& graph : calls_.functions()) add_blocks(graph);
    find_outside();
    add_loops();
    const WorstPath path = walk_worst_path(calls_, bounds_);
    add_functions(path);
    add_gaps(path);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool ran(uint32_t address) const { return counts_.spots.count(address) != 0; }

  void add_blocks(const FunctionGraph& graph) {
    for (const Block& block : graph.blocks) {
      ++result_.blocks;
      if (!ran(block.address()))
        result_.uncovered.push_back({program_.place(block.address()), block.code.size()});
      for (const Instruction* instruction : block.code) known_.insert(instruction->address);
      ends_.emplace(block.last().address, std::make_pair(&graph, &block));
    }
  }

  void find_outside() {
    for (const auto& [address, spot] : counts_.spots) {
      if (known_.count(address) == 0) result_.outside.push_back({address, address});
    }
    for (const auto& [way, count] : counts_.edges) {
      const auto [first, last] = ends_.equal_range(way.first);
      const bool is_known = std::any_of(first, last, [to = way.second](const auto& end) {
        return leads_to(*end.second.first, *end.second.second, to);
      });
      if (!is_known) result_.outside.push_back(way);
    }
  }

  [[nodiscard]] Place body_of(const FunctionBound& bound, const LoopFact& fact) const {
    for (const Node& node : bound.network.nodes) {
      for (const Mark& mark : node.marks) {
        if (mark.kind == FactKind::kBody && mark.id == fact.body) return program_.place(mark.pc);
      }
    }
    return {};
  }

  void add_loops() {
    const std::vector<LoopFact>& all = program_.facts().loops();
    for (size_t i = 0; i < calls_.functions().size(); ++i) {
      const FunctionBound& bound = bounds_.functions()[i];
      if (bound.is_open) continue;
      const FunctionGraph& graph = calls_.functions()[i];
      for (const LoopFact& fact : bound.facts) {
        const auto is_it = [&](const LoopFact& other) {
          return other.body == fact.body && other.enter == fact.enter;
        };
        const auto number = static_cast<size_t>(std::find_if(all.begin(), all.end(), is_it) - all.begin());
        const auto seen = counts_.loops.find({graph.entry, number});
        result_.loops.push_back({fact.body, fact.bound, graph.name, body_of(bound, fact),
                                 seen == counts_.loops.end() ? LoopCounts{} : seen->second});
      }
    }
  }

  void add_functions(const WorstPath& path) {
    for (size_t i = 0; i < calls_.functions().size(); ++i) {
      const FunctionGraph& graph = calls_.functions()[i];
      FunctionSeen function{graph.name, std::nullopt, path.functions[i].with_callees, {}};
      if (!bounds_.functions()[i].is_open) function.bound = bounds_.functions()[i].bound;
      const auto seen = counts_.functions.find(graph.entry);
      if (seen != counts_.functions.end()) function.seen = seen->second;
      result_.functions.push_back(function);
    }
  }

  void add_gaps(const WorstPath& path) {
    for (const BlockFigures& figures : path.blocks) {
      const Block& block = calls_.functions()[figures.function].blocks[figures.block];
      const auto spot = counts_.spots.find(block.address());
      const uint64_t in_longest = spot == counts_.spots.end() ? 0 : spot->second.in_longest;
      const BlockSeen seen{program_.place(block.address()), block.code.size(), figures.count, in_longest};
      if (seen.gap() > 0) result_.gaps.push_back(seen);
    }
    std::stable_sort(result_.gaps.begin(), result_.gaps.end(),
                     [](const BlockSeen& a, const BlockSeen& b) { return a.gap() > b.gap(); });
  }

  const Program& program_;
  const CallGraph& calls_;
  const BoundAnalysis& bounds_;
  const Counts& counts_;
  Measurement result_;
  std::set<uint32_t> known_;
  std::multimap<uint32_t, std::pair<const FunctionGraph*, const Block*>> ends_;  // by the last instruction
};

}  // namespace

double Measurement::coverage_percent() const {
  return 100.0 * static_cast<double>(blocks - uncovered.size()) / static_cast<double>(blocks);
}

double Measurement::ratio() const { return static_cast<double>(bound) / static_cast<double>(longest); }

Measurement measure(const Program& program, const CallGraph& calls, const BoundAnalysis& bounds,
                    const Counts& counts) {
  refuse_broken_runs(program, counts);
  return Joining(program, calls, bounds, counts).run();
}

std::vector<std::string> broken_gates(const Program& program, const Measurement& measurement) {
  std::vector<std::string> broken;
  if (measurement.longest > static_cast<uint64_t>(measurement.bound)) {
    broken.push_back(fmt::format("{}: {} instructions in invocation {}, but the bound is {}",
                                 measurement.root, measurement.longest, measurement.longest_at,
                                 measurement.bound));
  }
  for (const FunctionSeen& function : measurement.functions) {
    if (!function.bound || function.seen.most <= static_cast<uint64_t>(*function.bound)) continue;
    broken.push_back(fmt::format("{}: {} instructions in a call, but its bound is {}", function.name,
                                 function.seen.most, *function.bound));
  }
  for (const auto& [from, to] : measurement.outside) {
    broken.push_back(fmt::format("{}: the graph has no edge to {:#x}", to_string(program.place(from)), to));
  }
  for (const LoopSeen& loop : measurement.loops) {
    if (!loop.is_over()) continue;
    broken.push_back(fmt::format("{}: {} bodies more than its fact of {} allows in a call of {}",
                                 to_string(loop.body), loop.seen.most_excess, loop.bound, loop.function));
  }
  return broken;
}

}  // namespace palpate::wcet
