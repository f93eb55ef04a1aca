// What was found, for a person and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bound.hpp"
#include "cost_model.hpp"
#include "object_layout.hpp"
#include "report_rows.hpp"
#include "stack.hpp"
#include "worst_path.hpp"

namespace palpate::wcet {

struct Findings {
  const Program& program;
  const CallGraph& calls;
  const CostModel& model;
  const BoundAnalysis& bounds;
  WorstPath path;
  bool with_interrupt;  // entry and exit are part of the bound
  std::optional<std::vector<StackUse>> stack;
  std::vector<PoolUse> pools;  // of a static object

  [[nodiscard]] Cycles interrupt() const {
    return with_interrupt ? model.interrupt_entry + model.interrupt_exit : 0;
  }
  [[nodiscard]] Cycles total() const { return bounds.bound() + interrupt(); }
};

void print(const Findings& findings);
nlohmann::json to_json(const Findings& findings);

}  // namespace palpate::wcet
