// What was found, for a person and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bound.hpp"
#include "cost_model.hpp"
#include "names.hpp"
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

  [[nodiscard]] Cycles interrupt() const {
    return with_interrupt ? model.interrupt_entry + model.interrupt_exit : 0;
  }
  [[nodiscard]] Cycles total() const { return bounds.bound() + interrupt(); }
};

/// Bytes that a section takes in memory that is written, and in memory that keeps.
struct SectionUse {
  std::string name;
  uint32_t ram = 0;
  uint32_t flash = 0;
};
std::vector<SectionUse> section_uses(const ElfImage& image);

/// Functions on the deepest chain of calls, from the root.
std::vector<size_t> deepest_chain(const std::vector<StackUse>& stack);

void print(const Findings& findings);
nlohmann::json to_json(const Findings& findings);

}  // namespace palpate::wcet
