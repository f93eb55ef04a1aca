// The cycles of a block on an in-order core, from its first instruction's turn until what follows may issue.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cost_model.hpp"
#include "register_values.hpp"

namespace palpate::wcet {

class Scoreboard {
 public:
  /// The worst that can be before a block: all registers were written by the slowest instruction just now,
  /// and a store is pending at an unknown address.
  explicit Scoreboard(const CostModel& model);

  void issue(const Instruction& instruction);
  [[nodiscard]] Cycles cycles() const { return now_; }

 private:
  struct Ready {
    Cycles plain, address, shift;
  };
  struct PendingStore {
    std::optional<AddressRange> range;
    Cycles until;
  };
  [[nodiscard]] Cycles operands_ready(const Instruction& instruction) const;
  [[nodiscard]] Cycles memory_ready(const Instruction& instruction) const;
  void write_results(const Instruction& instruction, Cycles end);

  const CostModel& model_;
  Cycles now_ = 0;
  std::array<Ready, 16> ready_;
  std::vector<PendingStore> stores_;
  RegisterValues values_;
};

Cycles block_cycles(const CostModel& model, const std::vector<const Instruction*>& code);

}  // namespace palpate::wcet
