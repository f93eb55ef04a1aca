#include "source_lines.hpp"

#include <elfutils/libdw.h>
#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <iterator>

namespace palpate::wcet {
namespace {

void add_line(Dwarf_Line* line, std::map<uint32_t, std::string>& lines) {
  Dwarf_Addr address = 0;
  int number = 0;
  bool is_end = false;
  if (dwarf_lineaddr(line, &address) != 0 || dwarf_lineno(line, &number) != 0) return;
  if (dwarf_lineendsequence(line, &is_end) != 0) return;
  const char* file = dwarf_linesrc(line, nullptr, nullptr);
  const auto at = static_cast<uint32_t>(address);
  if (is_end) {
    lines.emplace(at, "");
  } else if (file != nullptr && number > 0) {
    lines[at] = std::filesystem::path(file).filename().string() + ":" + std::to_string(number);
  }
}

}  // namespace

SourceLines::SourceLines(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  if (Dwarf* dwarf = dwarf_begin(file, DWARF_C_READ)) {
    Dwarf_CU* unit = nullptr;
    Dwarf_Die die;
    while (dwarf_get_units(dwarf, unit, &unit, nullptr, nullptr, &die, nullptr) == 0) {
      Dwarf_Lines* lines = nullptr;
      size_t count = 0;
      if (dwarf_getsrclines(&die, &lines, &count) != 0) continue;
      for (size_t i = 0; i < count; ++i) add_line(dwarf_onesrcline(lines, i), lines_);
    }
    dwarf_end(dwarf);
  }
  close(file);
}

std::string SourceLines::at(uint32_t address) const {
  const auto after = lines_.upper_bound(address);
  return after == lines_.begin() ? "" : std::prev(after)->second;
}

}  // namespace palpate::wcet
