// Rows and names that reports share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "elf_image.hpp"
#include "stack.hpp"

namespace palpate::wcet {

/// Bytes that a section takes in memory that is written, and in memory that keeps.
struct SectionUse {
  std::string name;
  uint32_t ram = 0;
  uint32_t flash = 0;
};
std::vector<SectionUse> section_uses(const ElfImage& image);

/// Functions on the deepest chain of calls, from the root.
std::vector<size_t> deepest_chain(const std::vector<StackUse>& stack);

/// A stage of the tick, by the namespace that all of them are in: "forces" of
/// ...tick_stages::forces<...>(...).
std::optional<std::string> stage_name(const std::string& function);

/// A function without its type, arguments and parameters: "palpate::Forces::evaluate".
std::string short_name(const std::string& name);

}  // namespace palpate::wcet
