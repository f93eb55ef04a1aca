// Follows a run instruction by instruction and counts what a plan watches. It knows nothing of QEMU.
//
// Where an instruction is not followed by its neighbour, the one before must be a planned transfer: a call
// opens a frame, a return closes it and must come back behind its call, a jump to another function's entry
// (a tail call) opens one too, and the return closes both. Anything else is no flow of the program (an
// interrupt, a fault): it is noted as stray, and the invocation does not count.
#pragma once

#include <unordered_map>

#include "counts.hpp"
#include "plan.hpp"

namespace palpate::wcet {

/// An instruction of the program under test.
struct Spot {
  struct Edge {
    uint32_t to;
    uint64_t count;
  };
  uint32_t address = 0;
  uint32_t next = 0;  // behind it
  Transfer transfer = Transfer::kNone;
  size_t function = SIZE_MAX;  // whose entry it is
  std::vector<PlannedMark> marks;
  uint64_t all = 0;
  uint64_t in_invocation = 0;
  uint64_t in_longest = 0;
  std::vector<Edge> edges;
};

class Trace {
 public:
  explicit Trace(const Plan& plan);

  /// The same one for every call with the same address.
  Spot& spot(uint32_t address, uint32_t bytes);
  /// In the order of the run.
  void execute(Spot& at) {
    if (last_ == nullptr) {
      if (at.address == root_) begin(at);
      return;
    }
    if (last_->transfer != Transfer::kNone || at.address != last_->next) {
      follow(at);
      if (last_ == nullptr) return;
    }
    count(at);
  }
  [[nodiscard]] Counts counts() const;

 private:
  struct Loop {
    uint64_t entries = 0;
    uint64_t bodies = 0;
    uint64_t rounds = 0;  // since the last entry
  };
  struct Function {
    uint32_t entry = 0;
    bool is_open = false;
    FunctionCounts counts;
    uint64_t in_invocation = 0;
    std::vector<Loop> loops;      // by fact, of the call that runs
    std::vector<size_t> touched;  // facts that have any in it
    std::vector<LoopCounts> all;  // by fact
  };
  struct Frame {
    size_t function;
    size_t owner;  // the closed function that its loops count for
    uint64_t begin;
    uint32_t return_to;  // 0: of the root, which may go anywhere
    bool has_gone_on;    // by a tail call to the frame above, with which it ends
  };

  void begin(Spot& at);
  void end();
  void follow(Spot& at);
  void open_frame(size_t function, uint32_t return_to);
  void close_frame();
  void close_frames();
  void end_loops(Function& function);
  void stray(const Spot& at);
  void count(Spot& at) {
    ++instructions_;
    ++at.in_invocation;
    for (const PlannedMark& mark : at.marks) add_mark(mark);
    last_ = &at;
  }
  void add_mark(const PlannedMark& mark);

  uint32_t root_;
  const std::vector<uint32_t> bounds_;
  std::unordered_map<uint32_t, Spot> spots_;
  std::vector<Function> functions_;
  std::vector<Frame> frames_;
  Spot* last_ = nullptr;  // nullptr outside of the root
  uint64_t instructions_ = 0;
  uint64_t longest_ = 0;
  std::vector<uint64_t> invocations_;
  std::optional<Way> stray_;
};

}  // namespace palpate::wcet
