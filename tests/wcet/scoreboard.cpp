#include "scoreboard.hpp"

#include <algorithm>

namespace palpate::wcet {

Scoreboard::Scoreboard(const CostModel& model) : model_(model), ready_{} {
  Ready worst{0, 0, 0};
  for (const CostRow& row : model.rows) {
    worst = {std::max(worst.plain, row.result), std::max(worst.address, row.address),
             std::max(worst.shift, row.shift)};
  }
  ready_.fill(worst);
  stores_.push_back({std::nullopt, model.store_to_load});
}

Cycles Scoreboard::operands_ready(const Instruction& instruction) const {
  Cycles at = 0;
  for (uint8_t i = 0; i < 16; ++i) {
    if (i == kPc) continue;
    if (has(instruction.reads, i)) at = std::max(at, ready_[i].plain);
    if (has(instruction.address_reads, i)) at = std::max(at, ready_[i].address);
    if (has(instruction.shifted_reads, i)) at = std::max(at, ready_[i].shift);
  }
  return at;
}

// Literals lie in code, where nothing is stored.
Cycles Scoreboard::memory_ready(const Instruction& instruction) const {
  if (!instruction.memory || instruction.memory->is_store || instruction.memory->base == kPc) return 0;
  const std::optional<AddressRange> range = values_.range_of(instruction);
  Cycles at = 0;
  for (const PendingStore& store : stores_) {
    if (!range || !store.range || may_overlap(*range, *store.range)) at = std::max(at, store.until);
  }
  return at;
}

void Scoreboard::write_results(const Instruction& instruction, Cycles end) {
  const CostRow& row = model_.row(instruction);
  for (uint8_t i = 0; i < 16; ++i) {
    if (!has(instruction.writes, i)) continue;
    // A base that moves along is the work of an adder, whatever the access itself takes.
    const bool is_base = instruction.writeback && instruction.writeback->destination == i;
    const CostRow& from = is_base ? model_.rows[static_cast<size_t>(CostClass::kAlu)] : row;
    ready_[i] = {end + from.result, end + from.address, end + from.shift};
  }
}

void Scoreboard::issue(const Instruction& instruction) {
  const Cycles start = std::max({now_, operands_ready(instruction), memory_ready(instruction)});
  now_ = start + issue_cycles(model_, instruction);
  write_results(instruction, now_);
  if (instruction.memory && instruction.memory->is_store) {
    stores_.push_back({values_.range_of(instruction), now_ + model_.store_to_load});
  }
  values_.execute(instruction);
}

Cycles block_cycles(const CostModel& model, const std::vector<const Instruction*>& code) {
  Scoreboard scoreboard(model);
  for (const Instruction* instruction : code) scoreboard.issue(*instruction);
  return scoreboard.cycles();
}

}  // namespace palpate::wcet
