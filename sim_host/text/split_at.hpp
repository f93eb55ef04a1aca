// Text in parts: a line of a CSV file, of a target's console, a list on the command line.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace palpate::sim {

/// The parts between the separators without blanks at their ends, a carriage return among them. Never empty:
/// a text without separators is one part.
inline std::vector<std::string> split_at(const std::string& text, char separator) {
  constexpr const char* kBlanks = " \t\r";
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const std::size_t first = part.find_first_not_of(kBlanks);
    const std::size_t last = part.find_last_not_of(kBlanks);
    parts.push_back(first == std::string::npos ? "" : part.substr(first, last - first + 1));
    begin = end + 1;
  }
  return parts;
}

inline std::vector<std::string> split_at_commas(const std::string& text) { return split_at(text, ','); }

}  // namespace palpate::sim
