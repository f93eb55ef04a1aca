// Addresses to source lines, from DWARF where the file has it.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace palpate::wcet {

class SourceLines {
 public:
  explicit SourceLines(const std::string& path);
  /// "file.cpp:12", the file's name without its folders; empty when nothing is known.
  [[nodiscard]] std::string at(uint32_t address) const;

 private:
  std::map<uint32_t, std::string> lines_;  // by the first address; empty where a sequence ends
};

}  // namespace palpate::wcet
