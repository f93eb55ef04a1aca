// The worst case of every function below a root, callees first. A function whose loops are all entered within
// it is summed up as one number. One that has bodies whose loop or total is entered by a caller has no bound
// of its own: its network becomes a part of its callers'.
#pragma once

#include <map>
#include <vector>

#include "call_graph.hpp"
#include "cost_model.hpp"
#include "linear_program.hpp"

namespace palpate::wcet {

struct FunctionBound {
  Network network;
  bool is_open = false;  // then there is no more than the network
  std::vector<LoopFact> facts;
  Solution solution;
  Cycles bound = 0;
};

class BoundAnalysis {
 public:
  /// Throws Refusal where there is no bound. `limits`, by body: what the program's facts are taken to be
  /// instead, for the question what other capacities would cost.
  BoundAnalysis(const Program& program, const CallGraph& calls, const CostModel& model,
                const std::map<uint32_t, uint32_t>& limits = {});

  /// In the call graph's order; the root is the last.
  [[nodiscard]] const std::vector<FunctionBound>& functions() const { return functions_; }
  [[nodiscard]] Cycles bound() const { return functions_.back().bound; }

 private:
  void analyse(size_t function);
  Network make_network(size_t function) const;
  std::vector<Mark> marks_of(const Block& block) const;
  void add_arcs(size_t node, const Block& block, Cycles cycles, Network& network) const;
  void splice(const Network& callee, const Arc& call, Network& network) const;
  void take_facts(FunctionBound& result, bool is_root) const;
  void refuse_open_bodies(const FunctionBound& result, const std::vector<LoopFact>& open) const;
  void solve(FunctionBound& result) const;
  [[noreturn]] void refuse_unbounded(const FunctionBound& result) const;

  const Program& program_;
  const CallGraph& calls_;
  const CostModel& model_;
  std::vector<LoopFact> facts_;
  std::vector<FunctionBound> functions_;
};

}  // namespace palpate::wcet
