#include "source_text.hpp"

#include <algorithm>
#include <cctype>

namespace palpate::test {
namespace {

bool is_word_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::size_t line_at(std::string_view text, std::size_t at) {
  return 1 + static_cast<std::size_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

/// The end of the comment or literal that begins at `at`, or `at` when none does.
std::size_t end_of_blank(std::string_view text, std::size_t at) {
  const auto until = [&](std::string_view what, std::size_t from) {
    const std::size_t found = text.find(what, from);
    return found == std::string_view::npos ? text.size() : found + what.size();
  };
  if (text.substr(at, 2) == "//") return std::min(text.find('\n', at), text.size());
  if (text.substr(at, 2) == "/*") return until("*/", at + 2);
  if (text.substr(at, 3) == "R\"(" && (at == 0 || !is_word_character(text[at - 1])))
    return until(")\"", at + 3);
  const char quote = text[at];
  // A quote within a number, as in 1'000, separates digits.
  const bool opens = quote == '"' || (quote == '\'' && (at == 0 || !is_word_character(text[at - 1])));
  if (!opens) return at;
  std::size_t end = at + 1;
  while (end < text.size() && text[end] != quote && text[end] != '\n') end += text[end] == '\\' ? 2u : 1u;
  return std::min(end + 1, text.size());
}

/// Blanks what `blanks` accepts, keeping line ends, and the quotes of literals.
template <class Blanks>
std::string blank(std::string_view text, Blanks blanks) {
  std::string result(text);
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = end_of_blank(text, at);
    if (end == at) {
      ++at;
      continue;
    }
    if (blanks(text[at])) {
      for (std::size_t i = at; i < end; ++i) {
        const bool is_quote = (i == at || i + 1 == end) && text[i] == '"';
        if (text[i] != '\n' && !is_quote) result[i] = ' ';
      }
    }
    at = end;
  }
  return result;
}

std::size_t skip_spaces(std::string_view text, std::size_t at) {
  while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at])) != 0) ++at;
  return at;
}

/// The place after the parenthesis that closes the one at `open`.
std::size_t after_matching(std::string_view text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && --depth == 0) return i + 1;
  }
  return text.size();
}

std::string with_single_spaces(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool is_space = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!is_space) result += c;
    if (is_space && !result.empty() && result.back() != ' ') result += ' ';
  }
  return result;
}

/// Calls visit(begin, end) for every word.
template <class Visit>
void visit_words(std::string_view text, Visit visit) {
  std::size_t at = 0;
  while (at < text.size()) {
    if (!is_word_character(text[at])) {
      ++at;
      continue;
    }
    const std::size_t begin = at;
    while (at < text.size() && is_word_character(text[at])) ++at;
    visit(begin, at);
  }
}

}  // namespace

std::string without_comments_and_literals(std::string_view text) {
  return blank(text, [](char) { return true; });
}

std::vector<Include> find_includes(std::string_view text) {
  const std::string code = blank(text, [](char first) { return first == '/'; });
  std::vector<Include> includes;
  std::size_t line = 1;
  for (std::size_t begin = 0; begin < code.size(); ++line) {
    const std::size_t end = std::min(code.find('\n', begin), code.size());
    std::string directive;
    for (std::size_t i = begin; i < end; ++i) {
      if (std::isspace(static_cast<unsigned char>(code[i])) == 0) directive += code[i];
    }
    constexpr std::string_view kInclude = "#include";
    if (directive.compare(0, kInclude.size(), kInclude) == 0 && directive.size() > kInclude.size() + 2) {
      const bool is_system = directive[kInclude.size()] == '<';
      includes.push_back(
          {line, directive.substr(kInclude.size() + 1, directive.size() - kInclude.size() - 2), is_system});
    }
    begin = end + 1;
  }
  return includes;
}

std::vector<Word> find_words(std::string_view blanked) {
  std::vector<Word> words;
  visit_words(blanked, [&](std::size_t begin, std::size_t end) {
    const std::size_t line_begin = begin == 0 ? 0 : blanked.rfind('\n', begin - 1) + 1;
    std::string before(blanked.substr(line_begin, begin - line_begin));
    while (!before.empty() && before.back() == ' ') before.pop_back();
    words.push_back({line_at(blanked, begin), std::string(blanked.substr(begin, end - begin)), before});
  });
  return words;
}

std::vector<Loop> find_loops(std::string_view blanked) {
  std::vector<Loop> loops;
  visit_words(blanked, [&](std::size_t begin, std::size_t end) {
    const std::string_view word = blanked.substr(begin, end - begin);
    if (word == "do" || word == "goto") loops.push_back({line_at(blanked, begin), std::string(word)});
    if (word != "for" && word != "while") return;
    const std::size_t open = skip_spaces(blanked, end);
    const std::size_t close = after_matching(blanked, open);
    loops.push_back({line_at(blanked, begin), with_single_spaces(blanked.substr(begin, close - begin))});
  });
  return loops;
}

}  // namespace palpate::test
