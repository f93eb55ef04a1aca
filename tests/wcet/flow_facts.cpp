#include "flow_facts.hpp"

#include <fmt/format.h>

namespace palpate::wcet {
namespace {

Place place_of(const ElfImage& image, uint32_t pc) {
  const FunctionSymbol* function = image.function_around(pc);
  return {function == nullptr ? "a flow fact" : function->name, pc, ""};
}

}  // namespace

FlowFacts::FlowFacts(const ElfImage& image, const std::map<uint32_t, Instruction>& code)
    : code_(code), image_(image) {
  for (const FlowRecord& record : image.flow_records()) add(record);
  for (const auto& [ids, bound] : bounds_) loops_.push_back({ids.first, ids.second, bound});
}

const Mark* FlowFacts::at(uint32_t pc) const {
  const auto found = marks_.find(pc);
  return found == marks_.end() ? nullptr : &found->second;
}

void FlowFacts::add(const FlowRecord& record) {
  const auto kind = static_cast<FactKind>(record.kind);
  if (kind == FactKind::kTotal) return add_bound(record, record.pc);
  if (record.kind < 1 || record.kind > 4) {
    throw Refusal(place_of(image_, record.pc), fmt::format("there is no flow fact of kind {}", record.kind));
  }
  if (record.pc == 0) return;  // its code was not linked
  const auto instruction = code_.find(record.pc);
  if (instruction == code_.end() || !instruction->second.is_nop || marks_.count(record.pc) != 0) {
    throw Refusal(place_of(image_, record.pc), "a flow fact is not at a nop of its own");
  }
  marks_[record.pc] = {kind, record.id, record.pc};
  // An entry's bound counts too: whatever writes it says the same in both.
  if (kind != FactKind::kCallTarget) add_bound(record, record.id);
}

void FlowFacts::add_bound(const FlowRecord& record, uint32_t enter) {
  const auto [found, is_new] = bounds_.emplace(std::make_pair(record.id, enter), record.bound);
  if (is_new || found->second == record.bound) return;
  throw Refusal(
      place_of(image_, record.kind == 3 ? 0 : record.pc),
      fmt::format("the flow fact {:#x} has two bounds, {} and {}", record.id, found->second, record.bound));
}

}  // namespace palpate::wcet
