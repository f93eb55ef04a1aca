// The rules must be able to object: each is shown sources that break it, and sources that look as if they
// did.
#include "rules.hpp"

#include <gtest/gtest.h>

#include "source_text.hpp"

namespace palpate::test {
namespace {

std::string only(const Findings& findings) { return findings.size() == 1 ? findings[0] : "not one finding"; }

std::string include_finding(const char* path, const char* header) {
  return only(check_includes({path, std::string("\n#include \"palpate/") + header + "\"\n"}));
}

TEST(IncludeRule, RefusesPeers) {
  EXPECT_EQ(include_finding("core/elastic/palpate/elastic/a.hpp", "solve/integrate.hpp"),
            "core/elastic/palpate/elastic/a.hpp:2: may not include palpate/solve/integrate.hpp");
  EXPECT_NE(include_finding("core/touch/a.cpp", "elastic/groups.hpp"), "not one finding");
  EXPECT_NE(include_finding("core/remesh/a.cpp", "embed/surface.hpp"), "not one finding");
}

TEST(IncludeRule, RefusesWhatIsAbove) {
  EXPECT_NE(include_finding("core/numeric/a.cpp", "mesh/forest.hpp"), "not one finding");
  EXPECT_NE(include_finding("core/mesh/palpate/mesh/a.hpp", "elastic/groups.hpp"), "not one finding");
  EXPECT_NE(include_finding("core/tick/palpate/tick/a.hpp", "firmware/cycle.hpp"), "not one finding");
}

TEST(IncludeRule, SeparatesCoreDeviceAndBoard) {
  EXPECT_NE(include_finding("core/tick/palpate/tick/a.hpp", "phantom/premium.hpp"), "not one finding");
  EXPECT_NE(include_finding("core/numeric/a.cpp", "ports/motors.hpp"), "not one finding");
  EXPECT_NE(include_finding("hal/phantom/a.cpp", "mesh/forest.hpp"), "not one finding");
  EXPECT_NE(include_finding("hal/ports/palpate/ports/a.hpp", "numeric/q.hpp"), "not one finding");
  EXPECT_NE(include_finding("firmware/cycle/palpate/firmware/a.hpp", "ports/motors.hpp"), "not one finding");
  EXPECT_NE(include_finding("firmware/link/palpate/link/a.hpp", "phantom/premium.hpp"), "not one finding");
  EXPECT_NE(include_finding("firmware/link/palpate/link/a.hpp", "firmware/cycle.hpp"), "not one finding");
  EXPECT_NE(include_finding("board/mps2/a.cpp", "tick/tick.hpp"), "not one finding");
  EXPECT_NE(include_finding("board/mps2/a.cpp", "firmware/scenario_image.hpp"), "not one finding");
}

TEST(IncludeRule, AcceptsWhatIsBelow) {
  EXPECT_TRUE(check_includes({"core/mesh/palpate/mesh/a.hpp", "#include \"palpate/memory/index_pool.hpp\"\n"})
                  .empty());
  EXPECT_TRUE(check_includes({"core/tick/a.cpp", "#include \"palpate/touch/grasp.hpp\"\n"}).empty());
  EXPECT_TRUE(check_includes({"firmware/cycle/a.cpp", "#include \"palpate/phantom/premium.hpp\"\n"}).empty());
  EXPECT_TRUE(
      check_includes({"board/scripted/a.cpp", "#include \"palpate/firmware/scenario_image.hpp\"\n"}).empty());
  EXPECT_TRUE(check_includes({"firmware/link/a.cpp", "#include \"palpate/numeric/bounded.hpp\"\n"}).empty());
  EXPECT_TRUE(check_includes({"firmware/main/a.cpp", "#include \"run.hpp\"\n"}).empty());
}

TEST(IncludeRule, KnowsSystemHeaders) {
  EXPECT_EQ(only(check_includes({"core/mesh/a.cpp", "# include <vector>\n"})),
            "core/mesh/a.cpp:1: includes <vector>, but only platform.hpp includes system headers");
  EXPECT_TRUE(check_includes({"core/mesh/a.cpp", "// #include <vector>\n/*\n#include <map>\n*/\n"}).empty());
  EXPECT_TRUE(check_includes({"board/host/a.cpp", "#include <cstdio>\n"}).empty());
  EXPECT_EQ(check_includes({"board/mps2/a.cpp", "#include <cstdio>\n"}).size(), 1u);
}

TEST(IncludeRule, RefusesPathsAroundTheParts) {
  EXPECT_EQ(check_includes({"core/mesh/a.cpp", "#include \"../solve/x.hpp\"\n"}).size(), 1u);
}

TEST(IncludeRule, RefusesAFolderThatItDoesNotKnow) {
  EXPECT_EQ(check_includes({"core/novel/palpate/novel/a.hpp", ""}).size(), 1u);
}

TEST(WordRule, RefusesFloatHeapAndVirtual) {
  const auto count = [](const char* text) { return check_words({"core/mesh/a.cpp", text}).size(); };
  EXPECT_EQ(count("float x = 0;"), 1u);
  EXPECT_EQ(count("long double x = 0;"), 1u);
  EXPECT_EQ(count("int* p = new int;"), 1u);
  EXPECT_EQ(count("delete p;"), 1u);
  EXPECT_EQ(count("void* p = malloc(4);"), 1u);
  EXPECT_EQ(count("struct A { virtual void f(); };"), 1u);
  EXPECT_EQ(count("std::vector<int> v;"), 1u);
  EXPECT_EQ(count("std :: string s;"), 0u) << "the formatter leaves no such spaces";
  EXPECT_EQ(count("throw 1;"), 1u);
}

TEST(WordRule, AcceptsWhatOnlyLooksLikeIt) {
  const auto count = [](const char* text) { return check_words({"core/mesh/a.cpp", text}).size(); };
  EXPECT_EQ(count("// a new double float\n/* virtual */ int renewed = 1;"), 0u);
  EXPECT_EQ(count("check(ok, \"new \\\" float\"); char c = 'x'; int n = 1'000;"), 0u);
  EXPECT_EQ(count("A(const A&) = delete;"), 0u);
  EXPECT_EQ(count("const auto set = [] {}; int vector = 1;"), 0u);
}

TEST(LoopRule, RefusesWhatIsNotBounded) {
  const auto count = [](const char* text) { return check_loops({"core/mesh/a.cpp", text}).size(); };
  EXPECT_EQ(count("for (int i = 0; i < n; ++i) f(i);"), 1u);
  EXPECT_EQ(count("for (const auto& leaf : leaves) f(leaf);"), 1u);
  EXPECT_EQ(count("while (true) {}"), 1u);
  EXPECT_EQ(count("do { f(); } while (g());"), 2u);
  EXPECT_EQ(count("again: goto again;"), 1u);
  EXPECT_EQ(count("for (const int i : unbounded<4>(4, [] {})) f(i);"), 1u);
  EXPECT_EQ(count("for (const int i : leaves.takes(1, 2)) f(i);"), 1u);
  EXPECT_EQ(count("for (const int i : take(1, 2)) f(i);"), 1u);
}

TEST(LoopRule, AcceptsBoundedRanges) {
  const auto count = [](const char* text) { return check_loops({"core/mesh/a.cpp", text}).size(); };
  EXPECT_EQ(count("for (const uint32_t i : bounded<4>(4, [] {})) f(i);"), 0u);
  EXPECT_EQ(count("for ([[maybe_unused]] const uint32_t step :\n     bounded<kMax>(count(a), [] {})) f();"),
            0u);
  EXPECT_EQ(count("for (const uint32_t i : leaves.take(begin, count)) f(i);"), 0u);
  EXPECT_EQ(count("for (const uint32_t i : left.leaves.take(begin, count)) f(i);"), 0u);
  EXPECT_EQ(count("// while (true) for (;;)\n\"do\";"), 0u);
}

TEST(LoopRule, LeavesTheBackgroundAlone) {
  EXPECT_TRUE(check_loops({"firmware/main/a.cpp", "for (;;) wait();"}).empty());
  EXPECT_EQ(check_loops({"firmware/cycle/a.cpp", "for (;;) wait();"}).size(), 1u);
  EXPECT_EQ(check_loops({"firmware/link/a.cpp", "for (;;) wait();"}).size(), 1u);
}

TEST(Exceptions, HoldForTheirFileAndLineOnly) {
  const Exception& exception = exceptions()[1];
  const std::string line(exception.line);
  EXPECT_TRUE(check_loops({std::string(exception.path), "  " + line + "\n"}).empty());
  EXPECT_EQ(check_loops({"core/mesh/a.cpp", "  " + line + "\n"}).size(), 1u);
  EXPECT_EQ(check_loops({std::string(exception.path), line + " for (;;)\n"}).size(), 2u);
}

TEST(SourceText, KeepsLines) {
  EXPECT_EQ(without_comments_and_literals("a /* b\nc */ d // e\n\"f\" 'g'"),
            "a     \n     d     \n\" \"    ");
}

}  // namespace
}  // namespace palpate::test
