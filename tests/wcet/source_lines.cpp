#include "source_lines.hpp"

#include <dwarf.h>
#include <elfutils/libdw.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace palpate::wcet {
namespace {

std::string line_text(const char* file, int number) {
  return fmt::format("{}:{}", std::filesystem::path(file).filename().string(), number);
}

std::string line_at(Dwarf_Die* unit, uint32_t address) {
  Dwarf_Line* line = dwarf_getsrc_die(unit, address);
  int number = 0;
  const char* file = line == nullptr ? nullptr : dwarf_linesrc(line, nullptr, nullptr);
  if (file == nullptr || dwarf_lineno(line, &number) != 0 || number == 0) return "";
  return line_text(file, number);
}

std::string call_line(Dwarf_Die* unit, Dwarf_Die* inlined) {
  Dwarf_Attribute attribute;
  Dwarf_Word file = 0, line = 0;
  if (dwarf_formudata(dwarf_attr(inlined, DW_AT_call_file, &attribute), &file) != 0) return "";
  if (dwarf_formudata(dwarf_attr(inlined, DW_AT_call_line, &attribute), &line) != 0) return "";
  Dwarf_Files* files = nullptr;
  size_t count = 0;
  if (dwarf_getsrcfiles(unit, &files, &count) != 0 || file >= count) return "";
  return line_text(dwarf_filesrc(files, file, nullptr, nullptr), static_cast<int>(line));
}

// The innermost scope of an address, and from it outwards: the last inlined one is what the function itself
// calls.
std::string outermost_call(Dwarf_Die* unit, uint32_t address) {
  Dwarf_Die* innermost = nullptr;
  Dwarf_Die* scopes = nullptr;
  const bool is_known = dwarf_getscopes(unit, address, &innermost) > 0;
  const int count = is_known ? dwarf_getscopes_die(innermost, &scopes) : 0;
  std::string text;
  for (int i = 0; i < count; ++i) {
    if (dwarf_tag(&scopes[i]) == DW_TAG_inlined_subroutine) text = call_line(unit, &scopes[i]);
  }
  std::free(scopes);
  std::free(innermost);
  return text;
}

}  // namespace

SourceLines::SourceLines(const std::string& path)
    : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)),
      dwarf_(file_ < 0 ? nullptr : dwarf_begin(file_, DWARF_C_READ)) {}

SourceLines::~SourceLines() {
  dwarf_end(dwarf_);
  if (file_ >= 0) close(file_);
}

std::string SourceLines::at(uint32_t address) const {
  Dwarf_Die unit;
  if (dwarf_ == nullptr || dwarf_addrdie(dwarf_, address, &unit) == nullptr) return "";
  const std::string line = line_at(&unit, address);
  const std::string call = outermost_call(&unit, address);
  return call.empty() ? line : line + " within " + call;
}

}  // namespace palpate::wcet
