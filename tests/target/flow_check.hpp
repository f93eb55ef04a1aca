// Whether the work that a function can cause has a bound: every loop carries a flow fact, and nothing hides
// work.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "machine_code.hpp"

namespace palpate::target {

class FlowCheck {
 public:
  explicit FlowCheck(const std::string& elf_path);

  /// Examines every function that can be reached from `root`, a demangled name. Empty: all is bounded.
  std::vector<std::string> problems_below(const std::string& root);

  /// Of the last examination.
  [[nodiscard]] size_t functions_reached() const { return visited_.size(); }
  [[nodiscard]] size_t loops_with_fact() const { return loops_with_fact_; }

 private:
  using Nodes = std::set<size_t>;  // indices into a function's code

  struct Graph {
    const Function* function = nullptr;
    std::vector<std::vector<size_t>> successors;
    std::set<uint32_t> callees;
  };

  void visit(uint32_t address);
  void visit_callee(const Function& caller, uint32_t address);
  Graph graph_of(const Function& function);
  void add_edges(Graph& graph, size_t node);
  void add_jump(Graph& graph, size_t node);
  void examine_loops(const Graph& graph, const Nodes& nodes);
  Nodes bounded_bodies(const Graph& graph, const Nodes& loop) const;
  void report(const Function& function, const std::string& what);

  std::map<uint32_t, Function> functions_;
  std::map<uint32_t, FlowFactRecord> facts_;  // by pc
  std::set<uint32_t> entered_;                // ids of all loops and totals that are entered somewhere
  std::map<uint32_t, bool> visited_;          // by address of the function; true: all below it is examined
  std::vector<std::string> problems_;
  size_t loops_with_fact_ = 0;
};

}  // namespace palpate::target
