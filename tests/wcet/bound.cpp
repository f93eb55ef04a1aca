#include "bound.hpp"

#include <algorithm>

#include "alignment.hpp"
#include "block_times.hpp"
#include "certificate.hpp"

namespace palpate::wcet {

BoundAnalysis::BoundAnalysis(const Program& program, const CallGraph& calls, const CostModel& model,
                             const std::map<uint32_t, uint32_t>& limits)
    : program_(program), calls_(calls), model_(model), facts_(program.facts().loops()) {
  for (LoopFact& fact : facts_) {
    const auto limit = limits.find(fact.body);
    if (limit != limits.end()) fact.bound = limit->second;
  }
  refuse_unaligned(program, calls);
  refuse_polling(program, calls, model.devices);
  for (size_t i = 0; i < calls.functions().size(); ++i) analyse(i);
}

void BoundAnalysis::analyse(size_t function) {
  FunctionBound result;
  result.network = make_network(function);
  take_facts(result, function + 1 == calls_.functions().size());
  if (!result.is_open) solve(result);
  functions_.push_back(std::move(result));
}

Network BoundAnalysis::make_network(size_t function) const {
  const FunctionGraph& graph = calls_.functions()[function];
  Network network;
  for (size_t i = 0; i < graph.blocks.size(); ++i) {
    network.nodes.push_back({function, i, std::nullopt, marks_of(graph.blocks[i])});
  }
  const std::vector<Cycles> cycles = time_blocks(model_, graph);
  for (size_t i = 0; i < graph.blocks.size(); ++i) add_arcs(i, graph.blocks[i], cycles[i], network);
  return network;
}

std::vector<Mark> BoundAnalysis::marks_of(const Block& block) const {
  std::vector<Mark> marks;
  for (const Instruction* instruction : block.code) {
    if (const Mark* mark = program_.facts().at(instruction->address)) marks.push_back(*mark);
  }
  return marks;
}

void BoundAnalysis::add_arcs(size_t node, const Block& block, Cycles cycles, Network& network) const {
  for (const Edge& edge : block.edges) {
    Arc arc;
    arc.from = node;
    arc.ends_path = edge.to == kEnds;
    arc.to = edge.to == kEnds || edge.to == kReturns ? kExit : edge.to;
    arc.own = cycles + exit_cycles(model_, block.last(), edge.taken);
    if (edge.callee) {
      const size_t callee = calls_.index_of(*edge.callee);
      if (functions_[callee].is_open) {
        splice(functions_[callee].network, arc, network);
        continue;
      }
      arc.callee = callee;
      arc.below = functions_[callee].bound;
    }
    network.arcs.push_back(arc);
  }
}

void BoundAnalysis::splice(const Network& callee, const Arc& call, Network& network) const {
  const size_t first = network.nodes.size();
  for (Node node : callee.nodes) {
    node.via = node.via ? *node.via + first : call.from;
    network.nodes.push_back(std::move(node));
  }
  for (Arc arc : callee.arcs) {
    arc.from += first;
    if (arc.to != kExit) {
      arc.to += first;
    } else if (!arc.ends_path) {
      arc.to = call.to;
    }
    network.arcs.push_back(arc);
  }
  Arc enter = call;
  enter.to = first;
  network.arcs.push_back(enter);
}

void BoundAnalysis::take_facts(FunctionBound& result, bool is_root) const {
  std::vector<LoopFact> open;
  for (const LoopFact& fact : facts_within(result.network, facts_)) {
    (find_body_without_entry(result.network, fact) ? open : result.facts).push_back(fact);
  }
  result.is_open = !open.empty() && !is_root;
  if (is_root) refuse_open_bodies(result, open);
}

// A total that is entered elsewhere adds nothing here; a loop needs its own entry, or a total.
void BoundAnalysis::refuse_open_bodies(const FunctionBound& result, const std::vector<LoopFact>& open) const {
  for (const LoopFact& fact : open) {
    const auto bounds_it = [&](const LoopFact& other) { return other.body == fact.body; };
    if (std::any_of(result.facts.begin(), result.facts.end(), bounds_it)) continue;
    const uint32_t body = *find_body_without_entry(result.network, fact);
    throw Refusal(program_.place(body), "a loop's body that is reached without its entry");
  }
}

void BoundAnalysis::solve(FunctionBound& result) const {
  result.solution = find_longest_path(result.network, result.facts);
  if (!result.solution.is_bounded) refuse_unbounded(result);
  const std::optional<Cycles> proved = prove_bound(result.network, result.facts, result.solution);
  if (!proved) {
    const Node& entry = result.network.nodes.front();
    throw Refusal(program_.place(calls_.functions()[entry.function].entry),
                  "the solver's bound can't be proved");
  }
  result.bound = *proved;
}

// Names a block that such a loop is entered by.
void BoundAnalysis::refuse_unbounded(const FunctionBound& result) const {
  const Network& network = result.network;
  const std::vector<bool> goes_round = find_unbounded_arcs(network, result.facts);
  std::vector<bool> within(network.nodes.size(), false);
  for (size_t i = 0; i < network.arcs.size(); ++i) {
    if (goes_round[i]) within[network.arcs[i].from] = true;
  }
  const auto enters = [&](const Arc& arc) { return arc.to != kExit && within[arc.to] && !within[arc.from]; };
  const auto entry = std::find_if(network.arcs.begin(), network.arcs.end(), enters);
  const Node& node = network.nodes[entry == network.arcs.end() ? 0 : entry->to];
  const Block& block = calls_.functions()[node.function].blocks[node.block];
  throw Refusal(program_.place(block.address()), "a loop without a flow fact");
}

}  // namespace palpate::wcet
