#include "call_graph.hpp"

#include <fmt/format.h>

#include <regex>

namespace palpate::wcet {
namespace {

// Library code whose work depends on its operands and which carries no flow facts.
bool is_library_helper(const std::string& name) {
  static const std::regex pattern(
      "mem(cpy|set|move|cmp|chr)|str[a-z]+|__aeabi_.*|__[a-z]+[sdt][if][0-9]?|__u?(div|mod).*");
  return std::regex_match(name, pattern);
}

}  // namespace

CallGraph::CallGraph(const Program& program, uint32_t root, Purpose purpose)
    : program_(program), purpose_(purpose) {
  visit(root);
}

void CallGraph::visit(uint32_t entry) {
  open_.insert(entry);
  FunctionGraph graph = build_graph(program_, entry, purpose_, [this](uint32_t callee) {
    const bool comes_back = returns(callee);
    if (!comes_back) path_ends_.insert(callee);
    return comes_back;
  });
  for (const Block& block : graph.blocks) {
    for (const Edge& edge : block.edges) {
      if (edge.callee) visit_callee(block, *edge.callee);
    }
  }
  open_.erase(entry);
  indices_[entry] = functions_.size();
  functions_.push_back(std::move(graph));
}

void CallGraph::visit_callee(const Block& block, uint32_t callee) {
  const auto refuse = [&](const std::string& why) {
    throw Refusal(program_.place(block.last().address), why);
  };
  const auto symbol = program_.image().functions().find(callee);
  if (symbol == program_.image().functions().end())
    refuse(fmt::format("calls {:#x}, no function's start", callee));
  const std::string& name = symbol->second.name;
  if (purpose_ == Purpose::kTime && is_library_helper(name))
    refuse("calls " + name + ", library code without a bound");
  if (open_.count(callee) != 0) refuse("recursion: calls " + name + ", which leads here");
  if (indices_.count(callee) == 0) visit(callee);
}

bool CallGraph::returns(uint32_t entry) {
  const auto [known, is_new] = returning_.emplace(entry, true);
  if (!is_new) return known->second;
  const bool result = can_return(entry);
  returning_[entry] = result;
  return result;
}

// Whether a return can be reached. What can't be followed counts as one, so that it is refused later, at its
// place.
bool CallGraph::can_return(uint32_t entry) {
  std::set<uint32_t> seen{entry};
  std::vector<uint32_t> open{entry};
  while (!open.empty()) {
    const Instruction* at = program_.at(open.back());
    open.pop_back();
    if (at == nullptr) return true;
    try {
      if (add_next(successors_of(program_, entry, *at, purpose_, {}), *at, seen, open)) return true;
    } catch (const Refusal&) {
      return true;
    }
  }
  return false;
}

bool CallGraph::add_next(const Successors& next, const Instruction& at, std::set<uint32_t>& seen,
                         std::vector<uint32_t>& open) {
  bool comes_back = next.callees.empty();
  for (const uint32_t callee : next.callees) comes_back = comes_back || returns(callee);
  if (next.returns && comes_back) return true;
  for (const uint32_t target : next.taken) {
    if (seen.insert(target).second) open.push_back(target);
  }
  const bool goes_on = next.goes_on && (comes_back || at.is_conditional);
  if (goes_on && seen.insert(at.next()).second) open.push_back(at.next());
  return false;
}

}  // namespace palpate::wcet
