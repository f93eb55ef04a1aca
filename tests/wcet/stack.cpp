#include "stack.hpp"

#include <algorithm>

namespace palpate::wcet {
namespace {

class FrameMeter {
 public:
  FrameMeter(const Program& program, const FunctionGraph& graph) : program_(program), graph_(graph) {
    depths_.resize(graph.blocks.size());
    visit(0, 0);
    while (!open_.empty()) {
      const size_t block = open_.back();
      open_.pop_back();
      walk(block);
    }
  }

  [[nodiscard]] uint32_t deepest() const { return static_cast<uint32_t>(deepest_); }
  /// Where the block ends, its last instruction not counted: a return gives back what it took.
  [[nodiscard]] uint32_t depth_at_end(size_t block) const { return static_cast<uint32_t>(ends_.at(block)); }

 private:
  void visit(size_t block, int64_t depth) {
    if (!depths_[block]) {
      depths_[block] = depth;
      open_.push_back(block);
    } else if (*depths_[block] != depth) {
      throw Refusal(program_.place(graph_.blocks[block].address()),
                    "the stack's depth differs between ways to here");
    }
  }

  void walk(size_t index) {
    const Block& block = graph_.blocks[index];
    int64_t depth = *depths_[index];
    for (const Instruction* instruction : block.code) {
      if (instruction->flow == Flow::kReturn && instruction->is_conditional) continue;
      depth -= change(*instruction);
      deepest_ = std::max(deepest_, depth);
    }
    ends_[index] = depth;
    for (const Edge& edge : block.edges) {
      if (edge.to != kReturns && edge.to != kEnds) visit(edge.to, depth);
    }
  }

  int64_t change(const Instruction& instruction) const {
    if (!has(instruction.writes, kSp) || instruction.flow == Flow::kReturn) return 0;
    for (const std::optional<Assignment>& by : {instruction.assignment, instruction.writeback}) {
      const bool is_constant = by && by->destination == kSp && by->source == kSp &&
                               by->kind == Assignment::Kind::kSum && !instruction.is_conditional;
      if (is_constant) return by->value;
    }
    throw Refusal(program_.place(instruction.address),
                  "sp changes by what is no constant, " + instruction.text + " (alloca?)");
  }

  const Program& program_;
  const FunctionGraph& graph_;
  std::vector<std::optional<int64_t>> depths_;
  std::map<size_t, int64_t> ends_;
  std::vector<size_t> open_;
  int64_t deepest_ = 0;
};

}  // namespace

std::vector<StackUse> measure_stack(const Program& program, const CallGraph& calls) {
  std::vector<StackUse> uses;
  for (const FunctionGraph& graph : calls.functions()) {
    const FrameMeter frame(program, graph);
    StackUse use{frame.deepest(), frame.deepest(), std::nullopt};
    for (size_t i = 0; i < graph.blocks.size(); ++i) {
      for (const Edge& edge : graph.blocks[i].edges) {
        if (!edge.callee) continue;
        const size_t callee = calls.index_of(*edge.callee);
        const uint32_t bytes = frame.depth_at_end(i) + uses[callee].deepest_bytes;
        if (bytes <= use.deepest_bytes) continue;
        use.deepest_bytes = bytes;
        use.next_deepest = callee;
      }
    }
    uses.push_back(use);
  }
  return uses;
}

InterruptedStack measure_interrupted_stack(const Program& program, const std::string& background,
                                           const std::string& interrupt) {
  // Eight words, and one to bring the stack to a multiple of eight bytes. Without floating point there is no
  // more.
  constexpr uint32_t kFrameBytes = 9 * 4;
  const auto deepest = [&](const std::string& root) {
    const uint32_t entry = program.image().find_function(root).start;
    return measure_stack(program, CallGraph(program, entry, Purpose::kStack)).back().deepest_bytes;
  };
  return {deepest(background), kFrameBytes, deepest(interrupt)};
}

}  // namespace palpate::wcet
