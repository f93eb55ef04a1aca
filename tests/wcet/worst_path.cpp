#include "worst_path.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace palpate::wcet {
namespace {

class Walk {
 public:
  Walk(const CallGraph& calls, const BoundAnalysis& analysis) : analysis_(analysis) {
    path_.functions.resize(calls.functions().size());
    path_.functions.back().calls = 1;
  }

  // Callers come after their callees: from the root backwards, a function's count is complete when it is
  // visited.
  WorstPath run() {
    for (size_t function = path_.functions.size(); function-- > 0;) {
      const FunctionBound& bound = analysis_.functions()[function];
      if (bound.is_open || path_.functions[function].calls == 0) continue;
      path_.functions[function].with_callees +=
          path_.functions[function].calls * static_cast<double>(bound.bound);
      for (size_t i = 0; i < bound.network.arcs.size(); ++i) {
        add_arc(bound.network, bound.network.arcs[i],
                path_.functions[function].calls * bound.solution.counts[i]);
      }
    }
    for (const auto& [key, figures] : blocks_) path_.blocks.push_back(figures);
    std::sort(path_.blocks.begin(), path_.blocks.end(),
              [](const BlockFigures& a, const BlockFigures& b) { return a.own > b.own; });
    return std::move(path_);
  }

 private:
  void add_arc(const Network& network, const Arc& arc, double count) {
    if (count == 0) return;
    const Node& node = network.nodes[arc.from];
    const double own = count * static_cast<double>(arc.own);
    path_.functions[node.function].own += own;
    BlockFigures& block =
        blocks_.try_emplace({node.function, node.block}, BlockFigures{node.function, node.block, 0, 0})
            .first->second;
    block.count += count;
    block.own += own;
    if (arc.callee) path_.functions[*arc.callee].calls += count;
    if (arc.to != kExit && network.nodes[arc.to].via == arc.from)
      path_.functions[network.nodes[arc.to].function].calls += count;
    add_to_spliced(network, node, count * static_cast<double>(arc.cost()));
  }

  // A spliced function has no bound that its calls could be multiplied with.
  void add_to_spliced(const Network& network, const Node& node, double cycles) {
    std::set<size_t> around;
    for (const Node* at = &node; at->via; at = &network.nodes[*at->via]) around.insert(at->function);
    for (const size_t function : around) path_.functions[function].with_callees += cycles;
  }

  const BoundAnalysis& analysis_;
  WorstPath path_;
  std::map<std::pair<size_t, size_t>, BlockFigures> blocks_;
};

}  // namespace

WorstPath walk_worst_path(const CallGraph& calls, const BoundAnalysis& analysis) {
  return Walk(calls, analysis).run();
}

}  // namespace palpate::wcet
