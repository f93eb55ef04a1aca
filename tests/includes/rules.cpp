#include "rules.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "source_text.hpp"

namespace palpate::test {
namespace {

constexpr std::string_view kPlatform = "palpate/numeric/platform.hpp";
constexpr std::string_view kImage = "palpate/firmware/scenario_image.hpp";

/// A folder and what its files may include: folders below palpate/, or single headers.
struct Part {
  std::string_view folder;
  std::vector<std::string_view> uses;
};

const std::vector<Part>& parts() {
  static const std::vector<Part> all = {
      {"core/numeric/", {"numeric"}},
      {"core/memory/", {"numeric", "memory"}},
      {"core/mesh/", {"numeric", "memory", "mesh"}},
      {"core/elastic/", {"numeric", "memory", "mesh", "elastic"}},
      {"core/remesh/", {"numeric", "memory", "mesh", "remesh"}},
      {"core/solve/", {"numeric", "memory", "mesh", "solve"}},
      {"core/touch/", {"numeric", "memory", "mesh", "touch"}},
      {"core/embed/", {"numeric", "memory", "mesh", "embed"}},
      {"core/tick/", {"numeric", "memory", "mesh", "elastic", "remesh", "solve", "touch", "embed", "tick"}},
      {"hal/ports/", {kPlatform, "ports"}},
      {"hal/phantom/", {"numeric", "phantom"}},
      {"firmware/container/", {"numeric", "container"}},
      {"firmware/safety/", {"numeric", "phantom", "safety"}},
      {"firmware/cycle/",
       {"numeric", "memory", "mesh", "elastic", "remesh", "solve", "touch", "embed", "tick", "phantom",
        "container", "safety", "firmware"}},
      {"firmware/link/", {"numeric", "link"}},
      {"firmware/telemetry/", {"numeric", "phantom", "safety", "firmware", "link", "telemetry"}},
      {"firmware/main/",
       {"numeric", "tick", "container", "safety", "firmware", "link", "telemetry", "ports"}},
      {"board/lockstep/", {kPlatform, "ports", "link"}},
      {"board/scripted/", {kPlatform, "ports", kImage}},
      {"board/", {kPlatform, "ports"}},
  };
  return all;
}

bool starts_with(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

const Part* part_of(std::string_view path) {
  const auto found = std::find_if(parts().begin(), parts().end(),
                                  [&](const Part& part) { return starts_with(path, part.folder); });
  return found == parts().end() ? nullptr : &*found;
}

bool may_include(const Part& part, std::string_view header) {
  return std::any_of(part.uses.begin(), part.uses.end(), [&](std::string_view use) {
    return header == use || starts_with(header, "palpate/" + std::string(use) + "/");
  });
}

/// A line without its comment and without the spaces at its ends.
std::string line_of(const Source& source, std::size_t number) {
  std::size_t begin = 0;
  for (std::size_t line = 1; line < number; ++line) begin = source.text.find('\n', begin) + 1;
  const std::size_t end = std::min(source.text.find('\n', begin), source.text.size());
  std::string line = source.text.substr(begin, end - begin);
  line.erase(std::min(line.find("//"), line.size()));
  line.erase(0, line.find_first_not_of(' '));
  line.erase(line.find_last_not_of(" \r") + 1);
  return line;
}

bool is_exception(const Source& source, std::size_t line) {
  const std::string text = line_of(source, line);
  return std::any_of(exceptions().begin(), exceptions().end(), [&](const Exception& exception) {
    return exception.path == source.path && exception.line == text;
  });
}

void add_finding(const Source& source, std::size_t line, const std::string& what, Findings& findings) {
  if (is_exception(source, line)) return;
  findings.push_back(source.path + ":" + std::to_string(line) + ": " + what);
}

/// The host board is a process of its own kind: it may use the host's library.
bool is_host_board(const Source& source) { return starts_with(source.path, "board/host/"); }

bool is_platform(const Source& source) { return source.path == "core/numeric/palpate/numeric/platform.hpp"; }

const std::set<std::string_view>& forbidden_words() {
  static const std::set<std::string_view> all = {
      "float",        "double",      "new",         "delete",       "malloc",   "calloc", "realloc",
      "free",         "alloca",      "virtual",     "throw",        "try",      "catch",  "typeid",
      "dynamic_cast", "vector",      "string",      "map",          "set",      "list",   "deque",
      "function",     "unique_ptr",  "shared_ptr",  "string_view",  "iostream", "sort",   "unordered_map",
      "multimap",     "make_unique", "make_shared", "unordered_set"};
  return all;
}

/// Names that are common words elsewhere count only as the library's.
bool is_forbidden(const Word& word) {
  static const std::set<std::string_view> only_in_std = {"vector", "string", "map",      "set",
                                                         "list",   "deque",  "function", "sort"};
  const std::string& before = word.before;
  if (forbidden_words().count(word.text) == 0) return false;
  if (word.text == "delete" && !before.empty() && before.back() == '=') return false;
  if (only_in_std.count(word.text) == 0) return true;
  return before.size() >= 5 && before.compare(before.size() - 5, 5, "std::") == 0;
}

/// A range-for over bounded<...>(...), or over what a BoundedTotal lets nested loops take.
bool is_bounded(const std::string& head) {
  std::size_t colon = head.find(" : ");
  if (colon == std::string::npos || !starts_with(head, "for (")) return false;
  std::string_view range = std::string_view(head).substr(colon + 3);
  if (starts_with(range, "palpate::")) range.remove_prefix(9);
  constexpr std::string_view kTake = ".take(";
  const std::size_t take = range.find(kTake);
  const bool is_taken =
      take != std::string_view::npos && range.find_first_of("(<") == take + kTake.size() - 1;
  return starts_with(range, "bounded<") || is_taken;
}

}  // namespace

Findings check_includes(const Source& source) {
  Findings findings;
  const Part* part = part_of(source.path);
  if (part == nullptr) return {source.path + ":1: its folder has no rule for includes"};
  for (const Include& include : find_includes(source.text)) {
    if (include.is_system) {
      if (is_platform(source) || is_host_board(source)) continue;
      add_finding(source, include.line,
                  "includes <" + include.path + ">, but only platform.hpp includes system headers", findings);
    } else if (starts_with(include.path, "palpate/")) {
      if (may_include(*part, include.path)) continue;
      add_finding(source, include.line, "may not include " + include.path, findings);
    } else if (include.path.find('/') != std::string::npos) {
      add_finding(source, include.line,
                  "includes " + include.path + ", which is neither public nor beside it", findings);
    }
  }
  return findings;
}

Findings check_words(const Source& source) {
  Findings findings;
  if (is_host_board(source)) return findings;
  for (const Word& word : find_words(without_comments_and_literals(source.text))) {
    if (is_forbidden(word)) add_finding(source, word.line, "uses `" + word.text + "`", findings);
  }
  return findings;
}

Findings check_loops(const Source& source) {
  Findings findings;
  const bool concerned =
      starts_with(source.path, "core/") || starts_with(source.path, "hal/") ||
      (starts_with(source.path, "firmware/") && !starts_with(source.path, "firmware/main/"));
  if (!concerned) return findings;
  for (const Loop& loop : find_loops(without_comments_and_literals(source.text))) {
    if (!is_bounded(loop.head)) {
      add_finding(source, loop.line, "the loop `" + loop.head + "` is not over bounded<...>(...)", findings);
    }
  }
  return findings;
}

const std::vector<Exception>& exceptions() {
  static const std::vector<Exception> all = {
      {"core/numeric/palpate/numeric/platform.hpp", "#pragma GCC poison float double",
       "makes them errors on a target"},
      {"core/numeric/palpate/numeric/q.hpp", "for (int bit = 0; bit < F; ++bit) {",
       "Q::ratio, for compile-time constants"},
      {"core/elastic/palpate/elastic/groups.hpp", "for (int64_t left = 1; left <= kBlendSteps; ++left) {",
       "kBlendParts, for a compile-time constant"},
      {"core/elastic/palpate/elastic/group_forces.hpp", "for (const uint16_t* node : others) {",
       "a range that its caller takes from a BoundedTotal"},
      {"core/elastic/palpate/elastic/group_forces.hpp", "for (const uint16_t* place : range) {",
       "a range that its caller takes from a BoundedTotal"},
      {"firmware/container/palpate/container/crc32c.hpp",
       "for (uint32_t nibble = 0; nibble < 16; ++nibble) {", "make_table, for a compile-time constant"},
      {"firmware/container/palpate/container/crc32c.hpp",
       "for (int bit = 0; bit < 4; ++bit) rest = (rest >> 1) ^ ((rest & 1u) != 0 ? kReflected : 0u);",
       "make_table, for a compile-time constant"},
      {"hal/phantom/palpate/phantom/joint_angles.hpp", "for (std::size_t joint = 0; joint < 3; ++joint) {",
       "make_calibration, for compile-time constants"},
      {"hal/phantom/palpate/phantom/motor_code.hpp", "for (std::size_t joint = 0; joint < 3; ++joint) {",
       "make_drive, for compile-time constants"},
      {"firmware/safety/palpate/safety/conditions.hpp", "for (uint32_t i = 0; i < kConditionCount; ++i) {",
       "conditions_where, for compile-time constants"},
      {"firmware/safety/palpate/safety/state_machine.hpp", "for (uint32_t i = 0; i < kEventCount; ++i) {",
       "make_table, for a compile-time constant"},
      {"firmware/telemetry/palpate/telemetry/ring.hpp", "#include <atomic>",
       "what the tick and the background share, and nothing else does"},
      {"firmware/main/background.cpp", "#include <new>", "declares placement new, which allocates nothing"},
      {"firmware/main/background.cpp", "new (&g_storage.run) Run{};", "placement new on a static object"},
  };
  return all;
}

}  // namespace palpate::test
