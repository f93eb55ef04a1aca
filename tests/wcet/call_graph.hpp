// All functions that a root can reach, callees before their callers.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "control_flow.hpp"

namespace palpate::wcet {

class CallGraph {
 public:
  /// Throws Refusal: recursion, library code without facts, and what can't be followed.
  CallGraph(const Program& program, uint32_t root, Purpose purpose = Purpose::kTime);

  /// The root is the last.
  [[nodiscard]] const std::vector<FunctionGraph>& functions() const { return functions_; }
  [[nodiscard]] size_t index_of(uint32_t entry) const { return indices_.at(entry); }
  /// Functions that never come back, which end the paths that call them.
  [[nodiscard]] const std::set<uint32_t>& path_ends() const { return path_ends_; }

 private:
  void visit(uint32_t entry);
  void visit_callee(const Block& block, uint32_t callee);
  bool returns(uint32_t entry);
  bool can_return(uint32_t entry);
  bool add_next(const Successors& next, const Instruction& at, std::set<uint32_t>& seen,
                std::vector<uint32_t>& open);

  const Program& program_;
  Purpose purpose_;
  std::vector<FunctionGraph> functions_;
  std::map<uint32_t, size_t> indices_;
  std::set<uint32_t> open_;             // being visited: callers of what is visited now
  std::map<uint32_t, bool> returning_;  // what is known; true while it is examined
  std::set<uint32_t> path_ends_;
};

}  // namespace palpate::wcet
