#include "report_rows.hpp"

namespace palpate::wcet {

std::vector<SectionUse> section_uses(const ElfImage& image) {
  std::vector<SectionUse> uses;
  for (const Section& section : image.sections()) {
    if (!section.loaded || section.size == 0) continue;
    uses.push_back(
        {section.name, section.writable ? section.size : 0, section.bytes.empty() ? 0 : section.size});
  }
  return uses;
}

std::vector<size_t> deepest_chain(const std::vector<StackUse>& stack) {
  std::vector<size_t> chain{stack.size() - 1};
  while (stack[chain.back()].next_deepest) chain.push_back(*stack[chain.back()].next_deepest);
  return chain;
}

std::optional<std::string> stage_name(const std::string& function) {
  constexpr std::string_view kMark = "_stages::";
  // Behind the name come its template arguments or its parameters, which may name stages too.
  const size_t at = function.find(kMark);
  if (at == std::string::npos || function.find('(') < at) return std::nullopt;
  const std::string rest = function.substr(at + kMark.size());
  return rest.substr(0, rest.find_first_of("<("));
}

std::string short_name(const std::string& name) {
  if (name.find("operator") != std::string::npos) return name;
  const size_t end = name.find_last_of(')');  // behind it there may be "const"
  std::string kept;
  int depth = 0;
  for (const char c : name.substr(0, end)) {
    if (c == '<' || c == '(') ++depth;
    if (depth == 0 && c == ' ') kept.clear();
    if (depth == 0 && c != ' ') kept += c;
    if (c == '>' || c == ')') --depth;
  }
  return kept.empty() ? name : kept;
}

}  // namespace palpate::wcet
