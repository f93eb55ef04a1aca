#include "names.hpp"

#include <string_view>

namespace palpate::wcet {

std::string shortened(const std::string& name) {
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

std::optional<std::string> stage_name(const std::string& function) {
  constexpr std::string_view kMark = "_stages::";
  // Behind the name come its template arguments or its parameters, which may name stages too.
  const size_t at = function.find(kMark);
  if (at == std::string::npos || function.find('(') < at) return std::nullopt;
  const std::string rest = function.substr(at + kMark.size());
  return rest.substr(0, rest.find_first_of("<("));
}

}  // namespace palpate::wcet
