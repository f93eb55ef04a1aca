// What the program says of its loops and calls, in the section .wcet.flowfacts:
//
//   {1, id, pc, bound}       at pc, a nop, a loop or a total is entered
//   {2, id, pc, bound}       at pc, a nop, a body begins: bodies <= bound x entries of the same id
//   {3, body id, id, bound}  also: bodies of the one id <= bound x entries of the other
//   {4, target, pc, 0}       at pc, a nop, an indirect call follows that may go to the target
#pragma once

#include <map>
#include <vector>

#include "elf_image.hpp"
#include "instruction.hpp"
#include "refusal.hpp"

namespace palpate::wcet {

enum class FactKind : uint32_t { kEnter = 1, kBody = 2, kTotal = 3, kCallTarget = 4 };

struct Mark {
  FactKind kind;
  uint32_t id;
  uint32_t pc;
};

/// In every execution, bodies <= bound x entries.
struct LoopFact {
  uint32_t body;
  uint32_t enter;
  uint32_t bound;
};

class FlowFacts {
 public:
  /// Throws Refusal when the facts contradict each other or are not at nops.
  FlowFacts(const ElfImage& image, const std::map<uint32_t, Instruction>& code);

  [[nodiscard]] const std::vector<LoopFact>& loops() const { return loops_; }
  /// Entries, bodies and call targets at an address.
  [[nodiscard]] const Mark* at(uint32_t pc) const;

 private:
  void add(const FlowRecord& record);
  void add_bound(const FlowRecord& record, uint32_t enter);

  const std::map<uint32_t, Instruction>& code_;
  const ElfImage& image_;
  std::map<uint32_t, Mark> marks_;
  std::vector<LoopFact> loops_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> bounds_;  // by body and enter
};

}  // namespace palpate::wcet
