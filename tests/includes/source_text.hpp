// What the checks see of a C++ source: its lines with comments and literals blanked, its includes and its
// loops.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::test {

/// The text with comments as spaces, and with literals as spaces between their quotes. Lines stay where they
/// are.
std::string without_comments_and_literals(std::string_view text);

struct Include {
  std::size_t line;  // from 1
  std::string path;
  bool is_system;  // <path>, not "path"
};
/// The includes that are not comments.
std::vector<Include> find_includes(std::string_view text);

struct Word {
  std::size_t line;
  std::string text;
  std::string before;  // what stands before it on its line, without spaces at its end
};
/// The identifiers and keywords of a text without comments.
std::vector<Word> find_words(std::string_view blanked);

struct Loop {
  std::size_t line;
  std::string head;  // for (...), while (...) or do
};
/// The loops of a text without comments.
std::vector<Loop> find_loops(std::string_view blanked);

}  // namespace palpate::test
