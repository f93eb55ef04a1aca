// An in-order core, one instruction at a time: each waits for its operands, and a load for stores that it may
// meet.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cost_model.hpp"
#include "register_values.hpp"

namespace palpate::wcet {

/// What is still on its way between two blocks, in cycles from now on.
struct PipelineState {
  struct Ready {
    Cycles plain = 0, address = 0, shift = 0;
  };
  std::array<Ready, 16> ready{};  // by register
  // Until a store, nobody knows where in the function's frame, or elsewhere, can be loaded.
  Cycles frame_store = 0;
  Cycles store = 0;

  /// All registers were written by the slowest instruction just now, and a store was just made.
  static PipelineState worst(const CostModel& model);
  /// The same some cycles later.
  [[nodiscard]] PipelineState after(Cycles cycles) const;
  /// What covers both. False when that is what it was.
  bool join(const PipelineState& other);
};

/// Whether nothing but accesses relative to sp can meet the function's frame: it never takes an address
/// there.
enum class Frame : uint8_t { kShared, kPrivate };

class Scoreboard {
 public:
  Scoreboard(const CostModel& model, const PipelineState& entry, Frame frame = Frame::kShared);

  /// It must live until the next one is issued.
  void issue(const Instruction& instruction);
  /// From the first instruction's turn until what follows may issue.
  [[nodiscard]] Cycles cycles() const { return now_; }
  [[nodiscard]] PipelineState state() const;

 private:
  struct PendingStore {
    std::optional<AddressRange> range;
    Cycles until;
    bool is_in_frame;
  };
  [[nodiscard]] bool is_in_frame(const Instruction& access) const;
  [[nodiscard]] Cycles operands_ready(const Instruction& instruction) const;
  [[nodiscard]] Cycles memory_ready(const Instruction& instruction) const;
  void write_results(const Instruction& instruction);

  const CostModel& model_;
  Frame frame_;
  Cycles now_ = 0;
  std::array<PipelineState::Ready, 16> ready_;
  std::vector<PendingStore> stores_;
  RegisterValues values_;
  const Instruction* before_ = nullptr;
};

}  // namespace palpate::wcet
