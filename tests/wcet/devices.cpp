#include "devices.hpp"

#include <toml++/toml.h>

#include <algorithm>

#include "refusal.hpp"
#include "register_values.hpp"

namespace palpate::wcet {
namespace {

DeviceRange read_range(const toml::node& node, const std::string& path) {
  const toml::table table = node.is_table() ? *node.as_table() : toml::table();
  const auto number = [&](const char* key) { return table[key].value_or(int64_t{-1}); };
  DeviceRange range;
  range.name = table["name"].value_or(std::string());
  range.first = static_cast<uint32_t>(number("first"));
  range.last = static_cast<uint32_t>(number("last"));
  range.cycles = number("cycles");
  const bool is_whole = !range.name.empty() && number("first") >= 0 && number("last") >= number("first") &&
                        range.cycles >= 0 && !table["source"].value_or(std::string()).empty();
  if (!is_whole) throw BadInput(path + " has a range without name, first, last, cycles or source");
  return range;
}

bool is_port(const Devices& devices, const std::string& function) {
  return std::any_of(devices.ports.begin(), devices.ports.end(),
                     [&](const std::string& part) { return function.find(part) != std::string::npos; });
}

// The costliest range that a port can mean where it does not say which.
Cycles worst_named(const std::vector<DeviceRange>& ranges, const FunctionGraph& graph) {
  Cycles worst = 0;
  for (const Block& block : graph.blocks) {
    RegisterValues values;
    for (const Instruction* instruction : block.code) {
      values.execute(*instruction);
      for (const DeviceRange& range : ranges) {
        if (values.hold_constant_within(range.first, range.last)) worst = std::max(worst, range.cycles);
      }
    }
  }
  return worst;
}

Cycles access_cycles(const std::vector<DeviceRange>& ranges, Cycles unknown, const RegisterValues& values,
                     const Instruction& access) {
  if (access.memory->base == kSp || access.memory->base == kPc) return 0;
  const std::optional<AddressRange> where = values.range_of(access);
  if (!where || where->symbol != 0) return unknown;
  const auto found = std::find_if(ranges.begin(), ranges.end(),
                                  [&](const DeviceRange& range) { return range.holds(where->offset); });
  return found == ranges.end() ? 0 : found->cycles;
}

}  // namespace

Devices read_devices(const std::string& path) {
  try {
    const toml::table file = toml::parse_file(path);
    Devices devices;
    if (const toml::array* names = file["ports"].as_array()) {
      for (const toml::node& name : *names) devices.ports.push_back(name.value_or(std::string()));
    }
    const toml::array* list = file["range"].as_array();
    if (list == nullptr || devices.ports.empty()) throw BadInput(path + " has no ranges or no ports");
    for (const toml::node& node : *list) devices.ranges.push_back(read_range(node, path));
    return devices;
  } catch (const toml::parse_error& error) {
    throw BadInput(path + " has no device ranges: " + std::string(error.description()));
  }
}

std::vector<Cycles> device_cycles(const Devices& devices, const FunctionGraph& graph) {
  const Cycles unknown = is_port(devices, graph.name) ? worst_named(devices.ranges, graph) : 0;
  std::vector<Cycles> cycles;
  for (const Block& block : graph.blocks) {
    RegisterValues values;
    Cycles sum = 0;
    for (const Instruction* instruction : block.code) {
      if (instruction->memory) sum += access_cycles(devices.ranges, unknown, values, *instruction);
      values.execute(*instruction);
    }
    cycles.push_back(sum);
  }
  return cycles;
}

}  // namespace palpate::wcet
