#include "elf_image.hpp"

#include <cstring>
#include <iterator>

#include "elf_reader.hpp"
#include "refusal.hpp"

namespace palpate::wcet {

ElfImage::ElfImage(const std::string& path) { ElfReader(path, *this).read(); }

const Section* ElfImage::find_section(const std::string& name) const {
  for (const Section& section : sections_) {
    if (section.name == name) return &section;
  }
  return nullptr;
}

const FunctionSymbol* ElfImage::function_around(uint32_t address) const {
  const auto after = functions_.upper_bound(address);
  if (after == functions_.begin()) return nullptr;
  const FunctionSymbol& function = std::prev(after)->second;
  return address < function.end ? &function : nullptr;
}

const FunctionSymbol& ElfImage::find_function(const std::string& name) const {
  std::vector<const FunctionSymbol*> found;
  for (const auto& [start, function] : functions_) {
    if (function.name == name || function.mangled == name) return function;
    if (function.name.find(name) != std::string::npos) found.push_back(&function);
  }
  if (found.empty()) throw BadInput("there is no function " + name);
  if (found.size() == 1) return *found.front();
  std::string names;
  for (const FunctionSymbol* function : found) names += "\n  " + function->name;
  throw BadInput("several functions have " + name + " in their name:" + names);
}

bool ElfImage::is_code(uint32_t address) const {
  const auto after = stretches_.upper_bound(address);
  return after != stretches_.begin() && std::prev(after)->second;
}

uint32_t ElfImage::stretch_end(uint32_t address) const {
  uint32_t end = UINT32_MAX;
  for (const Section& section : sections_) {
    if (section.loaded && section.holds(address)) end = section.address + section.size;
  }
  const auto after = stretches_.upper_bound(address);
  return after != stretches_.end() && after->first < end ? after->first : end;
}

std::optional<uint32_t> ElfImage::read(uint32_t address, uint32_t bytes) const {
  for (const Section& section : sections_) {
    if (!section.loaded || !section.holds(address)) continue;
    const size_t offset = address - section.address;
    if (offset + bytes > section.bytes.size()) return std::nullopt;
    uint32_t value = 0;
    std::memcpy(&value, section.bytes.data() + offset, bytes);
    return value;
  }
  return std::nullopt;
}

std::vector<FlowRecord> ElfImage::flow_records() const {
  const Section* section = find_section(".wcet.flowfacts");
  if (section == nullptr || section->bytes.empty()) return {};
  std::vector<FlowRecord> records(section->bytes.size() / sizeof(FlowRecord));
  std::memcpy(records.data(), section->bytes.data(), records.size() * sizeof(FlowRecord));
  return records;
}

}  // namespace palpate::wcet
