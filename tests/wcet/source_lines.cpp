#include "source_lines.hpp"

#include <dwarf.h>
#include <elfutils/libdw.h>
#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <iterator>

namespace palpate::wcet {

class DwarfReader {
 public:
  explicit DwarfReader(SourceLines& into) : into_(into) {}

  void read_unit(Dwarf_Die unit) {
    Dwarf_Lines* lines = nullptr;
    size_t count = 0;
    if (dwarf_getsrclines(&unit, &lines, &count) != 0) return;
    for (size_t i = 0; i < count; ++i) add_line(dwarf_onesrcline(lines, i));
    if (dwarf_getsrcfiles(&unit, &files_, &file_count_) == 0) visit_children(&unit);
  }

 private:
  static std::string name_of(const char* path) { return std::filesystem::path(path).filename().string(); }

  void add_line(Dwarf_Line* line) {
    Dwarf_Addr address = 0;
    int number = 0;
    bool is_end = false;
    if (dwarf_lineaddr(line, &address) != 0 || dwarf_lineno(line, &number) != 0) return;
    if (dwarf_lineendsequence(line, &is_end) != 0) return;
    const char* file = dwarf_linesrc(line, nullptr, nullptr);
    const auto at = static_cast<uint32_t>(address);
    if (is_end) {
      into_.lines_.emplace(at, SourceLines::Line{});
    } else if (file != nullptr && number > 0) {
      into_.lines_[at] = {name_of(file), number};
    }
  }

  void visit_children(Dwarf_Die* parent) {
    Dwarf_Die child;
    if (dwarf_child(parent, &child) != 0) return;
    do {
      if (dwarf_tag(&child) == DW_TAG_inlined_subroutine) {
        add_call(&child);
      } else {
        visit_children(&child);
      }
    } while (dwarf_siblingof(&child, &child) == 0);
  }

  void add_call(Dwarf_Die* inlined) {
    Dwarf_Attribute attribute;
    Dwarf_Word file = 0;
    Dwarf_Word line = 0;
    if (dwarf_formudata(dwarf_attr(inlined, DW_AT_call_file, &attribute), &file) != 0) return;
    if (dwarf_formudata(dwarf_attr(inlined, DW_AT_call_line, &attribute), &line) != 0) return;
    if (file >= file_count_) return;
    const SourceLines::Line call{name_of(dwarf_filesrc(files_, file, nullptr, nullptr)),
                                 static_cast<int>(line)};
    Dwarf_Addr base = 0;
    Dwarf_Addr first = 0;
    Dwarf_Addr end = 0;
    for (ptrdiff_t at = 0; (at = dwarf_ranges(inlined, at, &base, &first, &end)) > 0;) {
      into_.calls_[static_cast<uint32_t>(first)] = {static_cast<uint32_t>(end), call};
    }
  }

  SourceLines& into_;
  Dwarf_Files* files_ = nullptr;
  size_t file_count_ = 0;
};

SourceLines::SourceLines(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  if (Dwarf* dwarf = dwarf_begin(file, DWARF_C_READ)) {
    DwarfReader reader(*this);
    Dwarf_CU* unit = nullptr;
    Dwarf_Die die;
    while (dwarf_get_units(dwarf, unit, &unit, nullptr, nullptr, &die, nullptr) == 0) reader.read_unit(die);
    dwarf_end(dwarf);
  }
  close(file);
}

std::string SourceLines::at(uint32_t address) const {
  const auto after = lines_.upper_bound(address);
  if (after == lines_.begin() || std::prev(after)->second.number == 0) return "";
  std::string line = std::prev(after)->second.text();
  const auto call = calls_.upper_bound(address);
  if (call == calls_.begin() || address >= std::prev(call)->second.end) return line;
  return line + " within " + std::prev(call)->second.line.text();
}

}  // namespace palpate::wcet
