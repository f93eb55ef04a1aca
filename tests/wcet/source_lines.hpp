// Addresses to source lines, from DWARF where the file has it.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace palpate::wcet {

class SourceLines {
 public:
  explicit SourceLines(const std::string& path);

  /// "file.cpp:12", without folders; of inlined code also the line of the function that it is inlined into.
  /// Empty when nothing is known.
  [[nodiscard]] std::string at(uint32_t address) const;

 private:
  friend class DwarfReader;
  struct Line {
    std::string file;
    int number = 0;  // 0: none, a sequence of lines ended before

    [[nodiscard]] std::string text() const { return file + ":" + std::to_string(number); }
  };
  struct InlinedCall {
    uint32_t end;
    Line line;
  };

  std::map<uint32_t, Line> lines_;  // by first address
  std::map<uint32_t, InlinedCall>
      calls_;  // by first address; of calls within inlined code only the outermost
};

}  // namespace palpate::wcet
