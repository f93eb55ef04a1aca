#include "scoreboard.hpp"

#include <algorithm>

namespace palpate::wcet {
namespace {

bool raise(Cycles& value, Cycles to) {
  if (value >= to) return false;
  value = to;
  return true;
}

Cycles later(Cycles ready, Cycles cycles) { return std::max(ready - cycles, Cycles{0}); }

}  // namespace

PipelineState PipelineState::worst(const CostModel& model) {
  Ready slowest;
  for (const CostRow& row : model.rows) {
    raise(slowest.plain, row.result);
    raise(slowest.address, row.address);
    raise(slowest.shift, row.shift);
  }
  PipelineState state;
  state.ready.fill(slowest);
  state.frame_store = state.store = model.store_to_load;
  return state;
}

PipelineState PipelineState::after(Cycles cycles) const {
  PipelineState state = *this;
  for (Ready& of : state.ready) {
    of = {later(of.plain, cycles), later(of.address, cycles), later(of.shift, cycles)};
  }
  state.frame_store = later(frame_store, cycles);
  state.store = later(store, cycles);
  return state;
}

bool PipelineState::join(const PipelineState& other) {
  bool changed = raise(store, other.store);
  changed |= raise(frame_store, other.frame_store);
  for (size_t i = 0; i < ready.size(); ++i) {
    changed |= raise(ready[i].plain, other.ready[i].plain);
    changed |= raise(ready[i].address, other.ready[i].address);
    changed |= raise(ready[i].shift, other.ready[i].shift);
  }
  return changed;
}

Scoreboard::Scoreboard(const CostModel& model, const PipelineState& entry, Frame frame)
    : model_(model), frame_(frame), ready_(entry.ready) {
  stores_.push_back({std::nullopt, entry.store, false});
  stores_.push_back({std::nullopt, entry.frame_store, true});
}

PipelineState Scoreboard::state() const {
  PipelineState state;
  state.ready = ready_;
  for (const PendingStore& store : stores_) {
    raise(store.is_in_frame ? state.frame_store : state.store, store.until);
  }
  return state.after(now_);
}

Cycles Scoreboard::operands_ready(const Instruction& instruction) const {
  Cycles at = 0;
  for (uint8_t i = 0; i < kPc; ++i) {
    if (has(instruction.reads, i)) raise(at, ready_[i].plain);
    if (has(instruction.address_reads, i)) raise(at, ready_[i].address);
    if (has(instruction.shifted_reads, i)) raise(at, ready_[i].shift);
  }
  return at;
}

bool Scoreboard::is_in_frame(const Instruction& access) const {
  return frame_ == Frame::kPrivate && access.memory->base == kSp;
}

// Literals lie in code, where nothing is stored.
Cycles Scoreboard::memory_ready(const Instruction& instruction) const {
  if (!instruction.memory || instruction.memory->is_store || instruction.memory->base == kPc) return 0;
  const std::optional<AddressRange> range = values_.range_of(instruction);
  Cycles at = 0;
  for (const PendingStore& store : stores_) {
    if (frame_ == Frame::kPrivate && store.is_in_frame != is_in_frame(instruction)) continue;
    if (!range || !store.range || may_overlap(*range, *store.range)) raise(at, store.until);
  }
  return at;
}

void Scoreboard::write_results(const Instruction& instruction) {
  for (uint8_t i = 0; i < kPc; ++i) {
    if (!has(instruction.writes, i)) continue;
    // A base that moves along is the work of an adder, whatever the access itself takes.
    const bool is_base = instruction.writeback && instruction.writeback->destination == i;
    const CostRow& row =
        is_base ? model_.rows[static_cast<size_t>(CostClass::kAlu)] : model_.row(instruction);
    ready_[i] = {now_ + row.result, now_ + row.address, now_ + row.shift};
  }
}

void Scoreboard::issue(const Instruction& instruction) {
  now_ = std::max({now_, operands_ready(instruction), memory_ready(instruction)});
  now_ += issue_cycles(model_, before_, instruction);
  before_ = &instruction;
  write_results(instruction);
  if (instruction.memory && instruction.memory->is_store) {
    stores_.push_back({values_.range_of(instruction), now_ + model_.store_to_load, is_in_frame(instruction)});
  }
  values_.execute(instruction);
}

}  // namespace palpate::wcet
