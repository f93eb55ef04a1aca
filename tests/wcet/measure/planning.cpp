#include "planning.hpp"

namespace palpate::wcet {
namespace {

Transfer transfer_of(const Instruction& instruction) {
  switch (instruction.flow) {
    case Flow::kCall:
    case Flow::kIndirectCall:
      return Transfer::kCall;
    case Flow::kJump:
    case Flow::kTable:
    case Flow::kIndirectJump:
      return Transfer::kJump;
    case Flow::kReturn:
      return Transfer::kReturn;
    default:
      return Transfer::kNone;
  }
}

void add_marks(const Program& program, const Mark& mark, Plan& plan) {
  const std::vector<LoopFact>& loops = program.facts().loops();
  for (size_t fact = 0; fact < loops.size(); ++fact) {
    if (mark.kind == FactKind::kBody && loops[fact].body == mark.id)
      plan.marks.push_back({mark.pc, true, fact});
    if (mark.kind == FactKind::kEnter && loops[fact].enter == mark.id)
      plan.marks.push_back({mark.pc, false, fact});
  }
}

}  // namespace

Plan make_plan(const Program& program, const CallGraph& calls, const BoundAnalysis& bounds) {
  Plan plan;
  plan.root = calls.functions().back().entry;
  for (const LoopFact& loop : program.facts().loops()) plan.bounds.push_back(loop.bound);
  std::map<uint32_t, const Mark*> marks;  // once each, also where functions share code
  for (size_t i = 0; i < calls.functions().size(); ++i) {
    const FunctionGraph& graph = calls.functions()[i];
    plan.functions[graph.entry] = bounds.functions()[i].is_open;
    for (const Block& block : graph.blocks) {
      for (const Instruction* instruction : block.code) {
        const Transfer transfer = transfer_of(*instruction);
        if (transfer != Transfer::kNone) plan.transfers[instruction->address] = transfer;
        if (const Mark* mark = program.facts().at(instruction->address)) marks[mark->pc] = mark;
      }
    }
  }
  for (const auto& [pc, mark] : marks) add_marks(program, *mark, plan);
  return plan;
}

}  // namespace palpate::wcet
