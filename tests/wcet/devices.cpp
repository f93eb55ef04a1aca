#include "devices.hpp"

#include <algorithm>

#include "call_graph.hpp"
#include "register_values.hpp"

namespace palpate::wcet {
namespace {

bool is_port(const Devices& devices, const std::string& function) {
  return std::any_of(devices.ports.begin(), devices.ports.end(),
                     [&](const std::string& part) { return function.find(part) != std::string::npos; });
}

// What is known where each block begins, whichever way led to it; nothing where none does.
std::vector<std::optional<RegisterValues>> values_at_blocks(const FunctionGraph& graph) {
  std::vector<std::optional<RegisterValues>> entries(graph.blocks.size());
  entries.front() = RegisterValues();
  std::vector<size_t> open{0};
  while (!open.empty()) {
    const size_t at = open.back();
    open.pop_back();
    RegisterValues values = *entries[at];
    for (const Instruction* instruction : graph.blocks[at].code) values.execute(*instruction);
    for (const Edge& edge : graph.blocks[at].edges) {
      if (edge.to == kReturns || edge.to == kEnds) continue;
      RegisterValues left = values;
      if (edge.callee) left.forget_scratch();
      std::optional<RegisterValues>& entry = entries[edge.to];
      const bool is_new = !entry;
      if (is_new) entry = left.known_part();
      if (is_new || entry->join(left)) open.push_back(edge.to);
    }
  }
  return entries;
}

// The costliest range that a port can mean where it does not say which; nothing where it names none.
std::optional<Cycles> worst_named(const std::vector<DeviceRange>& ranges, const FunctionGraph& graph) {
  std::optional<Cycles> worst;
  for (const Block& block : graph.blocks) {
    RegisterValues values;
    for (const Instruction* instruction : block.code) {
      values.execute(*instruction);
      for (const DeviceRange& range : ranges) {
        if (values.hold_constant_within(range.first, range.last))
          worst = std::max(worst.value_or(0), range.cycles);
      }
    }
  }
  return worst;
}

// Nothing where it accesses no device.
std::optional<Cycles> access_cycles(const std::vector<DeviceRange>& ranges, std::optional<Cycles> unknown,
                                    const RegisterValues& values, const Instruction& at) {
  if (!at.memory || at.memory->base == kSp || at.memory->base == kPc) return std::nullopt;
  const AddressRange where = values.base_of(at);
  if (RegisterValues::is_from_before(where.symbol)) return std::nullopt;
  if (where.symbol != 0) return unknown;
  const auto found = std::find_if(ranges.begin(), ranges.end(),
                                  [&](const DeviceRange& range) { return range.holds(where.offset); });
  return found == ranges.end() ? std::nullopt : std::optional<Cycles>(found->cycles);
}

bool is_in_loop(const FunctionGraph& graph, size_t block) {
  std::vector<bool> seen(graph.blocks.size(), false);
  std::vector<size_t> open{block};
  while (!open.empty()) {
    const size_t at = open.back();
    open.pop_back();
    for (const Edge& edge : graph.blocks[at].edges) {
      if (edge.to == block) return true;
      if (edge.to == kReturns || edge.to == kEnds || seen[edge.to]) continue;
      seen[edge.to] = true;
      open.push_back(edge.to);
    }
  }
  return false;
}

struct DeviceAccess {
  const Instruction* at;
  Cycles cycles;
};

// By block.
std::vector<std::vector<DeviceAccess>> find_accesses(const Devices& devices, const FunctionGraph& graph) {
  std::optional<Cycles> unknown;
  if (is_port(devices, graph.name)) unknown = worst_named(devices.ranges, graph);
  const std::vector<std::optional<RegisterValues>> entries = values_at_blocks(graph);
  std::vector<std::vector<DeviceAccess>> accesses(graph.blocks.size());
  for (size_t i = 0; i < graph.blocks.size(); ++i) {
    RegisterValues values = entries[i].value_or(RegisterValues().known_part());
    for (const Instruction* instruction : graph.blocks[i].code) {
      const std::optional<Cycles> cycles = access_cycles(devices.ranges, unknown, values, *instruction);
      if (cycles) accesses[i].push_back({instruction, *cycles});
      values.execute(*instruction);
    }
  }
  return accesses;
}

}  // namespace

std::vector<Cycles> device_cycles(const Devices& devices, const FunctionGraph& graph) {
  std::vector<Cycles> cycles;
  for (const std::vector<DeviceAccess>& accesses : find_accesses(devices, graph)) {
    cycles.push_back(0);
    for (const DeviceAccess& access : accesses) cycles.back() += access.cycles;
  }
  return cycles;
}

void refuse_polling(const Program& program, const CallGraph& calls, const Devices& devices) {
  for (const FunctionGraph& graph : calls.functions()) {
    const std::vector<std::vector<DeviceAccess>> accesses = find_accesses(devices, graph);
    for (size_t i = 0; i < accesses.size(); ++i) {
      const auto read = std::find_if(accesses[i].begin(), accesses[i].end(),
                                     [](const DeviceAccess& access) { return !access.at->memory->is_store; });
      if (read != accesses[i].end() && is_in_loop(graph, i))
        throw Refusal(program.place(read->at->address), "polls a device register, " + read->at->text);
    }
  }
}

}  // namespace palpate::wcet
