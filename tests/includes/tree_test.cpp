// The source tree keeps its rules.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "rules.hpp"

namespace palpate::test {
namespace {

std::vector<Source> read_tree() {
  namespace fs = std::filesystem;
  const fs::path top = PALPATE_SOURCE_TREE;
  std::vector<Source> sources;
  for (const char* folder : {"core", "hal", "firmware", "board"}) {
    for (const auto& entry : fs::recursive_directory_iterator(top / folder)) {
      const fs::path extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp" && extension != ".h" && extension != ".c") continue;
      std::ifstream file(entry.path());
      std::stringstream text;
      text << file.rdbuf();
      sources.push_back({entry.path().lexically_relative(top).generic_string(), text.str()});
    }
  }
  return sources;
}

const std::vector<Source>& tree() {
  static const std::vector<Source> read = read_tree();
  return read;
}

template <class Check>
void expect_no_findings(Check check) {
  for (const Source& source : tree()) {
    for (const std::string& finding : check(source)) ADD_FAILURE() << finding;
  }
}

TEST(SourceTree, IsRead) {
  EXPECT_GT(tree().size(), 60u);
  const auto is_tick = [](const Source& s) {
    return s.path == "core/tick/palpate/tick/tick.hpp" && !s.text.empty();
  };
  EXPECT_TRUE(std::any_of(tree().begin(), tree().end(), is_tick));
}

TEST(SourceTree, IncludesOnlyWhatItsPartsMay) { expect_no_findings(check_includes); }

TEST(SourceTree, HasNoFloatNoHeapAndNoVirtual) { expect_no_findings(check_words); }

TEST(SourceTree, HasOnlyBoundedLoops) { expect_no_findings(check_loops); }

TEST(SourceTree, NeedsEveryException) {
  for (const Exception& exception : exceptions()) {
    const bool is_needed = std::any_of(tree().begin(), tree().end(), [&](const Source& source) {
      return source.path == exception.path && source.text.find(exception.line) != std::string::npos;
    });
    EXPECT_TRUE(is_needed) << exception.path << " no longer has the line\n  " << exception.line;
    EXPECT_FALSE(exception.reason.empty());
  }
}

}  // namespace
}  // namespace palpate::test
