#include "block_times.hpp"

#include <algorithm>

#include "scoreboard.hpp"

namespace palpate::wcet {
namespace {

// An address in the frame comes from sp, by an instruction that reads it for something else than sp itself.
Frame frame_of(const FunctionGraph& graph) {
  for (const Block& block : graph.blocks) {
    for (const Instruction* instruction : block.code) {
      const bool reads_sp = has(instruction->reads | instruction->shifted_reads, kSp);
      const bool stores_sp = instruction->memory && instruction->memory->is_store && reads_sp;
      if (stores_sp || (reads_sp && (instruction->writes & ~only(kSp)) != 0)) return Frame::kShared;
    }
  }
  return Frame::kPrivate;
}

Scoreboard run(const CostModel& model, const PipelineState& entry, Frame frame, const Block& block) {
  Scoreboard scoreboard(model, entry, frame);
  for (const Instruction* instruction : block.code) scoreboard.issue(*instruction);
  return scoreboard;
}

const CostRow& row(const CostModel& model, CostClass of) { return model.rows[static_cast<size_t>(of)]; }

// Whatever the caller did before its call or tail call, that has taken some cycles of its own.
PipelineState state_at_entry(const CostModel& model) {
  const CostRow& conditional = row(model, CostClass::kConditionalBranch);
  const Cycles least = std::min({row(model, CostClass::kCall).cycles, row(model, CostClass::kBranch).cycles,
                                 conditional.cycles + conditional.taken});
  return PipelineState::worst(model).after(least);
}

// A return refills the pipeline: all of its cycles but the one in which it issues.
PipelineState state_after_call(const CostModel& model) {
  const Cycles least =
      std::min(row(model, CostClass::kBranchRegister).cycles, row(model, CostClass::kLoadPc).cycles);
  return PipelineState::worst(model).after(least - 1);
}

}  // namespace

std::vector<Cycles> time_blocks(const CostModel& model, const FunctionGraph& graph) {
  const Frame frame = frame_of(graph);
  std::vector<PipelineState> entries(graph.blocks.size());
  entries.front() = state_at_entry(model);
  bool changed = true;
  while (changed) {
    changed = false;
    for (size_t i = 0; i < graph.blocks.size(); ++i) {
      const Block& block = graph.blocks[i];
      const PipelineState left = run(model, entries[i], frame, block).state();
      for (const Edge& edge : block.edges) {
        if (edge.to == kReturns || edge.to == kEnds) continue;
        const Cycles exit = exit_cycles(model, block.last(), edge.taken);
        changed |= entries[edge.to].join(edge.callee ? state_after_call(model) : left.after(exit));
      }
    }
  }
  std::vector<Cycles> cycles = device_cycles(model.devices, graph);
  for (size_t i = 0; i < graph.blocks.size(); ++i)
    cycles[i] += run(model, entries[i], frame, graph.blocks[i]).cycles();
  return cycles;
}

}  // namespace palpate::wcet
