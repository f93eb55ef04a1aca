// Addresses to source lines, from DWARF where the file has it.
#pragma once

#include <cstdint>
#include <string>

struct Dwarf;

namespace palpate::wcet {

class SourceLines {
 public:
  explicit SourceLines(const std::string& path);
  ~SourceLines();
  SourceLines(const SourceLines&) = delete;
  SourceLines& operator=(const SourceLines&) = delete;

  /// "file.cpp:12", without folders; of inlined code also the line of the function that it is inlined into.
  /// Empty when nothing is known.
  [[nodiscard]] std::string at(uint32_t address) const;

 private:
  int file_;
  Dwarf* dwarf_;
};

}  // namespace palpate::wcet
