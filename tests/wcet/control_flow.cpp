#include "control_flow.hpp"

#include <map>
#include <set>

namespace palpate::wcet {
namespace {

class GraphBuilder {
 public:
  GraphBuilder(const Program& program, uint32_t entry, Purpose purpose,
               const std::function<bool(uint32_t)>& returns)
      : program_(program), entry_(entry), purpose_(purpose), returns_(returns) {}

  FunctionGraph run() {
    find_leaders();
    FunctionGraph graph{entry_, program_.function_name(entry_), {}};
    index_of(entry_);
    // A block's edges name blocks that may be still to make.
    for (size_t i = 0; i < order_.size(); ++i) graph.blocks.push_back(make_block(order_[i]));
    return graph;
  }

 private:
  const Instruction& fetch(uint32_t address) const {
    const Instruction* found = program_.at(address);
    if (found == nullptr) throw Refusal(program_.place(address), "jumps to where no instruction begins");
    return *found;
  }

  [[nodiscard]] bool ends_block(const Instruction& at) const { return at.flow != Flow::kNext; }

  // What jumps reach begins a block, and so does what follows the end of one.
  void find_leaders() {
    std::vector<uint32_t> open{entry_};
    leaders_.insert(entry_);
    while (!open.empty()) {
      uint32_t address = open.back();
      open.pop_back();
      std::vector<uint32_t> marked;
      while (true) {
        const Instruction& at = fetch(address);
        add_mark(at, marked);
        const Successors next = successors_of(program_, entry_, at, purpose_, marked);
        for (const uint32_t target : next.taken) {
          if (leaders_.insert(target).second) open.push_back(target);
        }
        if (!continues(at, next)) break;
        address = at.next();
        refuse_overrun(at, address);
        if (!ends_block(at)) continue;
        if (leaders_.insert(address).second) open.push_back(address);
        break;
      }
    }
  }

  void add_mark(const Instruction& at, std::vector<uint32_t>& marked) const {
    const Mark* mark = program_.facts().at(at.address);
    if (mark != nullptr && mark->kind == FactKind::kCallTarget) marked.push_back(mark->id & ~1u);
  }

  // Behind a call that never returns there may be anything.
  [[nodiscard]] bool continues(const Instruction& at, const Successors& next) const {
    if (!next.goes_on || next.callees.empty() || at.is_conditional) return next.goes_on;
    for (const uint32_t callee : next.callees) {
      if (returns_(callee)) return true;
    }
    return false;
  }

  void refuse_overrun(const Instruction& at, uint32_t next) const {
    const ElfImage& image = program_.image();
    if (program_.at(next) == nullptr || image.function_around(next) != image.function_around(at.address)) {
      throw Refusal(program_.place(at.address), "runs past its function's end");
    }
  }

  size_t index_of(uint32_t leader) {
    const auto [found, is_new] = indices_.emplace(leader, order_.size());
    if (is_new) order_.push_back(leader);
    return found->second;
  }

  Block make_block(uint32_t address) {
    Block block;
    std::vector<uint32_t> marked;
    while (true) {
      const Instruction& at = fetch(address);
      block.code.push_back(&at);
      add_mark(at, marked);
      address = at.next();
      if (ends_block(at) || leaders_.count(address) != 0) break;
    }
    add_edges(block, successors_of(program_, entry_, block.last(), purpose_, marked));
    return block;
  }

  void add_edges(Block& block, const Successors& next) {
    const Instruction& at = block.last();
    const bool is_jump = at.flow != Flow::kNext;
    for (const uint32_t target : std::set<uint32_t>(next.taken.begin(), next.taken.end())) {
      block.edges.push_back({index_of(target), true, std::nullopt});
    }
    for (const uint32_t callee : next.callees) {
      if (!returns_(callee)) {
        // What never comes back takes no time of this path, but stack.
        const auto below = purpose_ == Purpose::kStack ? std::optional<uint32_t>(callee) : std::nullopt;
        block.edges.push_back({kEnds, is_jump, below});
      } else {
        block.edges.push_back({next.returns ? kReturns : index_of(at.next()), is_jump, callee});
      }
    }
    if (next.returns && next.callees.empty()) block.edges.push_back({kReturns, is_jump, std::nullopt});
    if (next.goes_on && (next.callees.empty() || at.is_conditional)) {
      block.edges.push_back({index_of(at.next()), false, std::nullopt});
    }
    if (block.edges.empty()) block.edges.push_back({kEnds, false, std::nullopt});
  }

  const Program& program_;
  uint32_t entry_;
  Purpose purpose_;
  const std::function<bool(uint32_t)>& returns_;
  std::set<uint32_t> leaders_;
  std::map<uint32_t, size_t> indices_;
  std::vector<uint32_t> order_;
};

}  // namespace

FunctionGraph build_graph(const Program& program, uint32_t entry, Purpose purpose,
                          const std::function<bool(uint32_t)>& returns) {
  return GraphBuilder(program, entry, purpose, returns).run();
}

}  // namespace palpate::wcet
