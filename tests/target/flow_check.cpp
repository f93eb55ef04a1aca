#include "flow_check.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <regex>
#include <stdexcept>

namespace palpate::target {
namespace {

constexpr uint32_t kEnter = 1;
constexpr uint32_t kBody = 2;

// Library code whose work depends on its operands and which carries no flow facts.
bool is_library_helper(const std::string& name) {
  static const std::regex pattern("(mem|str)[a-z]+|__aeabi_.*|__[a-z]+[sdt][if][0-9]?|__u?(div|mod).*");
  return std::regex_match(name, pattern);
}

std::string hex(uint32_t value) {
  char text[16];
  std::snprintf(text, sizeof(text), "0x%x", value);
  return text;
}

// The strongly connected parts of the graph on `nodes` that hold a cycle, by Tarjan's algorithm.
class Cycles {
 public:
  Cycles(const std::vector<std::vector<size_t>>& successors, const std::set<size_t>& nodes)
      : successors_(successors), nodes_(nodes) {
    for (const size_t node : nodes) {
      if (order_.count(node) == 0) visit(node);
    }
  }
  [[nodiscard]] const std::vector<std::set<size_t>>& found() const { return found_; }

 private:
  size_t visit(size_t node) {
    const size_t own = order_.size();
    order_[node] = own;
    open_.push_back(node);
    size_t lowest = own;
    bool cycle = false;
    for (const size_t next : successors_[node]) {
      if (nodes_.count(next) == 0) continue;
      cycle = cycle || next == node;
      if (order_.count(next) == 0) {
        lowest = std::min(lowest, visit(next));
      } else if (closed_.count(next) == 0) {
        lowest = std::min(lowest, order_[next]);
      }
    }
    if (lowest == own) close(node, cycle);
    return lowest;
  }

  void close(size_t first, bool cycle) {
    const auto start = std::find(open_.begin(), open_.end(), first);
    const std::set<size_t> part(start, open_.end());
    open_.erase(start, open_.end());
    closed_.insert(part.begin(), part.end());
    if (cycle || part.size() > 1) found_.push_back(part);
  }

  const std::vector<std::vector<size_t>>& successors_;
  const std::set<size_t>& nodes_;
  std::map<size_t, size_t> order_;
  std::vector<size_t> open_;
  std::set<size_t> closed_;
  std::vector<std::set<size_t>> found_;
};

}  // namespace

FlowCheck::FlowCheck(const std::string& elf_path) : functions_(read_functions(elf_path)) {
  for (const FlowFactRecord& fact : ElfFile(elf_path).flow_facts()) {
    facts_[fact.pc] = fact;
    if (fact.kind == kEnter) entered_.insert(fact.id);
  }
}

std::vector<std::string> FlowCheck::problems_below(const std::string& root) {
  visited_.clear();
  problems_.clear();
  loops_with_fact_ = 0;
  const auto is_root = [&](const auto& entry) { return entry.second.name == root; };
  const auto found = std::find_if(functions_.begin(), functions_.end(), is_root);
  if (found == functions_.end()) throw std::runtime_error("there is no function " + root);
  visit(found->first);
  return problems_;
}

void FlowCheck::visit(uint32_t address) {
  visited_[address] = false;
  const Function& function = functions_.at(address);
  const Graph graph = graph_of(function);
  Nodes all;  // those that the function can't reach have no edges
  for (size_t i = 0; i < graph.successors.size(); ++i) all.insert(i);
  examine_loops(graph, all);
  for (const uint32_t callee : graph.callees) visit_callee(function, callee);
  visited_[address] = true;
}

void FlowCheck::visit_callee(const Function& caller, uint32_t address) {
  const auto callee = functions_.find(address);
  if (callee == functions_.end()) return report(caller, "goes to " + hex(address) + ", no function's start");
  if (is_library_helper(callee->second.name)) return report(caller, "calls " + callee->second.name);
  const auto known = visited_.find(address);
  if (known == visited_.end()) return visit(address);
  if (!known->second) report(caller, "calls itself by way of " + callee->second.name);
}

FlowCheck::Graph FlowCheck::graph_of(const Function& function) {
  Graph graph;
  graph.function = &function;
  graph.successors.resize(function.code.size());
  std::vector<bool> seen(function.code.size(), false);
  if (function.code.empty()) {
    report(function, "has no instruction");
    return graph;
  }
  std::vector<size_t> open{0};
  seen[0] = true;
  while (!open.empty()) {
    const size_t node = open.back();
    open.pop_back();
    add_edges(graph, node);
    for (const size_t next : graph.successors[node]) {
      if (!seen[next]) open.push_back(next);
      seen[next] = true;
    }
  }
  return graph;
}

void FlowCheck::add_edges(Graph& graph, size_t node) {
  const std::vector<Instruction>& code = graph.function->code;
  const Instruction& at = code[node];
  if (at.flow == Flow::kData) report(*graph.function, "runs into the data at " + hex(at.address));
  if (at.flow == Flow::kIndirect) report(*graph.function, "jumps or calls indirectly at " + hex(at.address));
  if (at.flow == Flow::kCall) graph.callees.insert(at.target);
  if (at.flow == Flow::kJump) add_jump(graph, node);
  if (at.flow == Flow::kTable) {
    for (size_t next = node + 1; next < code.size(); ++next) {
      if (code[next].flow != Flow::kData) graph.successors[node].push_back(next);
    }
  }
  if (!at.goes_on) return;
  if (node + 1 < code.size()) {
    graph.successors[node].push_back(node + 1);
  } else if (at.flow != Flow::kCall) {  // what is called last does not return
    report(*graph.function, "runs past its end");
  }
}

void FlowCheck::add_jump(Graph& graph, size_t node) {
  const std::vector<Instruction>& code = graph.function->code;
  const uint32_t target = code[node].target;
  const auto is_target = [&](const Instruction& instruction) { return instruction.address == target; };
  const auto found = std::find_if(code.begin(), code.end(), is_target);
  if (found != code.end()) {
    graph.successors[node].push_back(static_cast<size_t>(found - code.begin()));
  } else {
    graph.callees.insert(target);  // a tail call
  }
}

// A cycle is bounded when it passes a body whose loop is entered outside of it: in this function, or, where
// nested loops share a total (palpate/numeric/bounded.hpp), in one that made the total. What is left of the
// cycles without these bodies must be bounded in the same way: so an inner loop's fact never excuses an outer
// loop.
void FlowCheck::examine_loops(const Graph& graph, const Nodes& nodes) {
  const std::vector<Instruction>& code = graph.function->code;
  const Cycles cycles(graph.successors, nodes);
  for (const Nodes& loop : cycles.found()) {
    const Nodes bodies = bounded_bodies(graph, loop);
    if (bodies.empty()) {
      std::string where = hex(code[*loop.begin()].address);
      where.append(" .. ").append(hex(code[*loop.rbegin()].address));
      report(*graph.function, "loops without a flow fact within " + where);
      continue;
    }
    ++loops_with_fact_;
    Nodes rest;
    std::set_difference(loop.begin(), loop.end(), bodies.begin(), bodies.end(),
                        std::inserter(rest, rest.end()));
    examine_loops(graph, rest);
  }
}

FlowCheck::Nodes FlowCheck::bounded_bodies(const Graph& graph, const Nodes& loop) const {
  std::set<uint32_t> entered_inside;
  std::map<size_t, uint32_t> bodies;
  for (size_t node = 0; node < graph.successors.size(); ++node) {
    const auto fact = facts_.find(graph.function->code[node].address);
    if (fact == facts_.end()) continue;
    const auto& [kind, id, pc, bound] = fact->second;
    if (kind == kEnter && loop.count(node) != 0) entered_inside.insert(id);
    if (kind == kBody && loop.count(node) != 0) bodies[node] = id;
  }
  Nodes bounded;
  for (const auto& [node, id] : bodies) {
    if (entered_.count(id) != 0 && entered_inside.count(id) == 0) bounded.insert(node);
  }
  return bounded;
}

void FlowCheck::report(const Function& function, const std::string& what) {
  problems_.push_back(function.name + " at " + hex(function.address) + " " + what);
}

}  // namespace palpate::target
