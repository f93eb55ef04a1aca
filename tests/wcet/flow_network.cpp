#include "flow_network.hpp"

#include <set>

namespace palpate::wcet {
namespace {

bool is_body(const Mark& mark, const LoopFact& fact) {
  return mark.kind == FactKind::kBody && mark.id == fact.body;
}
bool is_enter(const Mark& mark, const LoopFact& fact) {
  return mark.kind == FactKind::kEnter && mark.id == fact.enter;
}

}  // namespace

Cycles fact_weight(const Node& node, const LoopFact& fact) {
  Cycles weight = 0;
  for (const Mark& mark : node.marks) {
    if (is_body(mark, fact)) weight += 1;
    if (is_enter(mark, fact)) weight -= fact.bound;
  }
  return weight;
}

std::optional<uint32_t> find_body_without_entry(const Network& network, const LoopFact& fact) {
  std::vector<std::vector<size_t>> successors(network.nodes.size());
  for (const Arc& arc : network.arcs) {
    if (arc.to != kExit) successors[arc.from].push_back(arc.to);
  }
  std::vector<bool> seen(network.nodes.size(), false);
  std::vector<size_t> open{0};
  seen[0] = true;
  while (!open.empty()) {
    const size_t node = open.back();
    open.pop_back();
    bool entered = false;
    for (const Mark& mark : network.nodes[node].marks) {
      entered = entered || is_enter(mark, fact);
      if (!entered && is_body(mark, fact)) return mark.pc;
    }
    if (entered) continue;
    for (const size_t next : successors[node]) {
      if (!seen[next]) open.push_back(next);
      seen[next] = true;
    }
  }
  return std::nullopt;
}

std::vector<LoopFact> facts_within(const Network& network, const std::vector<LoopFact>& all) {
  std::set<uint32_t> bodies;
  for (const Node& node : network.nodes) {
    for (const Mark& mark : node.marks) {
      if (mark.kind == FactKind::kBody) bodies.insert(mark.id);
    }
  }
  std::vector<LoopFact> within;
  for (const LoopFact& fact : all) {
    if (bodies.count(fact.body) != 0) within.push_back(fact);
  }
  return within;
}

}  // namespace palpate::wcet
