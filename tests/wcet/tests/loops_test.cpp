// How a bound depends on the bounds of its loops.
#include "../loops.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cross_compiler.hpp"

namespace palpate::wcet::test {
namespace {

constexpr const char* kLoopSource =
    "CASE void inner(uint32_t n) { for (const uint32_t i : bounded<9>(n, [] {})) { (void)i; keep(); } }\n"
    "CASE void root(uint32_t n) {\n"
    "  for (const uint32_t i : bounded<700>(n, [] {})) { (void)i; keep(); }\n"
    "  for (const uint32_t i : bounded<5>(n, [] {})) { (void)i; inner(n); }\n"
    "}";

class Loops : public testing::Test {
 protected:
  [[nodiscard]] BoundAnalysis bounds(const std::map<uint32_t, uint32_t>& limits = {}) const {
    return BoundAnalysis(target_.program(), calls_, model_, limits);
  }
  [[nodiscard]] LoopFigures loop_of(uint32_t bound) const {
    const BoundAnalysis analysis = bounds();
    const std::vector<LoopFigures> loops =
        measure_loops(target_.program(), analysis, walk_worst_path(calls_, analysis));
    const auto found = std::find_if(loops.begin(), loops.end(),
                                    [&](const LoopFigures& loop) { return loop.fact.bound == bound; });
    return found == loops.end() ? LoopFigures{} : *found;
  }

  TargetProgram target_{std::string(kShorthands) + kBoundedLoops + kLoopSource};
  CallGraph calls_{target_.program(), target_.entry_of("root")};
  CostModel model_ = read_cost_model("m4");
};

TEST_F(Loops, CountEntriesAndBodies) {
  EXPECT_DOUBLE_EQ(loop_of(700).entries, 1);
  EXPECT_DOUBLE_EQ(loop_of(700).bodies, 700);
  EXPECT_DOUBLE_EQ(loop_of(9).entries, 5) << "each call enters it";
  EXPECT_DOUBLE_EQ(loop_of(9).bodies, 5 * 9);
  EXPECT_EQ(loop_of(700).place, "root::{lambda()#1}");
  EXPECT_EQ(loop_of(9).place, "inner::{lambda()#1}");
}

// What a round more costs is what another solution says of one round more.
TEST_F(Loops, CostOfARoundMore) {
  for (const uint32_t bound : {700u, 9u, 5u}) {
    const LoopFigures loop = loop_of(bound);
    EXPECT_GT(loop.per_round, 0);
    const Cycles more = bounds({{loop.fact.body, bound + 1}}).bound() - bounds().bound();
    EXPECT_DOUBLE_EQ(loop.per_round, static_cast<double>(more)) << bound;
  }
}

TEST_F(Loops, OfOtherBounds) {
  const LoopFigures loop = loop_of(700);
  const Cycles without = bounds({{loop.fact.body, 0}}).bound();
  EXPECT_NEAR(static_cast<double>(without) + 700 * loop.per_round, static_cast<double>(bounds().bound()), 10);
}

}  // namespace
}  // namespace palpate::wcet::test
