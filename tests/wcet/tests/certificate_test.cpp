// Networks that can be solved by hand, and dual values that prove nothing.
#include "../certificate.hpp"

#include <gtest/gtest.h>

namespace palpate::wcet::test {
namespace {

Arc arc(size_t from, size_t to, Cycles cost) {
  Arc made;
  made.from = from;
  made.to = to;
  made.own = cost;
  return made;
}

constexpr LoopFact kTenRounds{1, 1, 10};

// Node 0 enters a loop, node 1 is its body, node 2 leaves.
Network make_loop() {
  Network network;
  network.nodes.resize(3);
  network.nodes[0].marks = {{FactKind::kEnter, 1, 0}};
  network.nodes[1].marks = {{FactKind::kBody, 1, 0}};
  network.arcs = {arc(0, 1, 5), arc(1, 1, 7), arc(1, 2, 8), arc(2, kExit, 1)};
  return network;
}

TEST(LongestPath, OfALoop) {
  const Network network = make_loop();
  const Solution solution = find_longest_path(network, {kTenRounds});
  ASSERT_TRUE(solution.is_bounded);
  EXPECT_DOUBLE_EQ(solution.counts[1], 9);
  EXPECT_EQ(prove_bound(network, {kTenRounds}, solution), 5 + 9 * 7 + 8 + 1);
}

TEST(LongestPath, HasNoBoundWithoutTheFact) {
  const Network network = make_loop();
  EXPECT_FALSE(find_longest_path(network, {}).is_bounded);
  EXPECT_EQ(find_unbounded_arcs(network, {}), (std::vector<bool>{false, true, false, false}));
  EXPECT_EQ(find_unbounded_arcs(network, {kTenRounds}), (std::vector<bool>(4, false)));
}

// Three bodies a round, ten in all: the solution is three and a third rounds, the proof is exact.
TEST(LongestPath, WithFractions) {
  Network network = make_loop();
  network.nodes[1].marks.assign(3, {FactKind::kBody, 1, 0});
  const Solution solution = find_longest_path(network, {kTenRounds});
  ASSERT_TRUE(solution.is_bounded);
  EXPECT_EQ(prove_bound(network, {kTenRounds}, solution), 5 + 16 + 8 + 1) << "7 x 7 / 3 is 16 and a third";
}

TEST(Certificate, RefusesAPotentialThatIsTooSmall) {
  const Network network = make_loop();
  Solution solution = find_longest_path(network, {kTenRounds});
  solution.potentials[0] -= 1;
  EXPECT_EQ(prove_bound(network, {kTenRounds}, solution), std::nullopt);
}

TEST(Certificate, RefusesAMultiplierBelowZero) {
  Network network = make_loop();
  network.arcs = {arc(0, kExit, 5)};
  Solution solution;
  solution.potentials = {5, 0, 0};
  solution.multipliers = {0};
  EXPECT_EQ(prove_bound(network, {kTenRounds}, solution), 5);
  solution.multipliers = {-0.5};
  EXPECT_EQ(prove_bound(network, {kTenRounds}, solution), std::nullopt);
}

TEST(Certificate, RefusesAMultiplierThatIsTooSmall) {
  const Network network = make_loop();
  Solution solution = find_longest_path(network, {kTenRounds});
  solution.multipliers[0] -= 0.25;
  EXPECT_EQ(prove_bound(network, {kTenRounds}, solution), std::nullopt);
}

TEST(Facts, HoldOnlyBehindAnEntry) {
  Network network = make_loop();
  EXPECT_EQ(find_body_without_entry(network, kTenRounds), std::nullopt);
  network.nodes.push_back({});
  network.arcs.push_back(arc(0, 3, 0));
  network.nodes[3].marks = {{FactKind::kBody, 1, 0x44}};
  EXPECT_EQ(find_body_without_entry(network, kTenRounds), std::nullopt) << "the entry is before it";
  network.nodes[0].marks.clear();
  network.nodes[1].marks = {{FactKind::kEnter, 1, 0}, {FactKind::kBody, 1, 0}};
  EXPECT_EQ(find_body_without_entry(network, kTenRounds), 0x44u);
}

}  // namespace
}  // namespace palpate::wcet::test
