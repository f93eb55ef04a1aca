// Every event at ticks drawn with a fixed seed, and pairs of events; docs/safety.md shows what was found. In
// a soak every event at every tick, and 10^5 pairs.
#include <gtest/gtest.h>

#include <cstdio>

#include "slice.hpp"
#include "support/soak.hpp"
#include "trial.hpp"
#include "trial_table.hpp"

namespace palpate::fault {
namespace {

const SnapshotStore& store() {
  static const SnapshotStore snapshots;
  return snapshots;
}

void expect_safe(const std::vector<Event>& events, const Outcome& outcome) {
  EXPECT_EQ(outcome.failure, "") << describe(events);
}

TEST(FaultScenario, HasEverythingInIt) {
  ASSERT_EQ(store().failure(), "");
  ASSERT_EQ(store().size(), 1 + kScenarioTicks / SnapshotStore::kEvery);
  EXPECT_EQ(store().pools_at_rest().leaves, 144u);
  Loop loop;
  uint32_t states = 0;
  uint32_t flags = 0;
  double most_amperes = 0.0;
  for (uint32_t i = 0; i < kScenarioTicks; ++i) {
    loop.advance();
    states |= 1u << static_cast<uint32_t>(loop.state());
    flags |= loop.cycle.output.flags;
    most_amperes = std::max(most_amperes, loop.plant.truth().currents.cwiseAbs().maxCoeff());
  }
  constexpr uint32_t kAllButBootAndFault = 0x7e;
  EXPECT_EQ(states, kAllButBootAndFault);
  for (const TickFlag flag : {TickFlag::kTouching, TickFlag::kGrasping}) {
    EXPECT_NE(flags & static_cast<uint32_t>(flag), 0u);
  }
  EXPECT_GT(loop.cycle.core.remesh.bisected, 20u);
  EXPECT_GT(loop.cycle.core.remesh.merged, 20u);
  EXPECT_GT(most_amperes, 1.0);
  EXPECT_EQ(loop.cycle.safety.seen.bits(), 0u);
}

TEST(FaultScenario, GoesOnFromASnapshotAsIfNothingHadBeen) {
  Loop whole;
  while (whole.tick() < 1420) whole.advance();
  Loop part = store().before(1310).loop;
  ASSERT_EQ(part.tick(), 1300u);
  while (part.tick() < 1420) part.advance();
  EXPECT_EQ(state_hash(part.cycle), state_hash(whole.cycle));
  EXPECT_EQ(part.given.motor_codes, whole.given.motor_codes);
  EXPECT_EQ(part.plant.truth().arm.q, whole.plant.truth().arm.q);
}

/// In a soak at every tick, with the lengths in turn.
std::vector<Event> events_to_try(EventKind kind, test::Random& random) {
  if (!test::is_soak()) return events_of(kind, random);
  std::vector<Event> events;
  for (uint32_t tick = 0; tick < kScenarioTicks; ++tick) {
    events.push_back({kind, tick, kLengths[tick % kLengths.size()], random.below(kDetails)});
  }
  return events;
}

TEST(FaultInjection, OfEveryEventLeavesTheDeviceSafe) {
  ASSERT_EQ(store().failure(), "");
  test::Random random(2024);
  TrialTable table;
  for (uint32_t i = 0; i < kEventKinds; ++i) {
    const auto kind = static_cast<EventKind>(i);
    if (!can_be_tried(kind)) continue;
    for (const Event& event : events_to_try(kind, random)) {
      const Outcome outcome = run_trial(store(), {event});
      expect_safe({event}, outcome);
      table.add(kind, outcome);
    }
    const bool must_be_found = kIsWhole && !expected_of(kind).is_empty();
    EXPECT_TRUE(table.found(kind) > 0 || !must_be_found) << event_name(kind);
  }
  std::printf("%s", table.text().c_str());
  if (kIsWhole && !test::is_soak()) expect_in_page("injections", table.text());
}

/// A walk around an edge of this one came to places that no leaf has, before the leaf's turn to be examined.
TEST(FaultInjection, OfABrokenLinkDoesNotLeadOutOfTheMesh) {
  const Event event{EventKind::kMeshLink, 1414, 150, 371544};
  if (can_be_tried(event.kind)) expect_safe({event}, run_trial(store(), {event}));
}

/// A merge brings the wrong leaf to where the walk over the leaves has been: the next round finds it.
TEST(FaultInjection, OfABrokenLinkIsFoundThoughItsLeafMoves) {
  const std::vector<Event> pair = {{EventKind::kCountRange, 1482, 1, 714645},
                                   {EventKind::kMeshLink, 1510, 5, 818217}};
  if (can_be_tried(EventKind::kMeshLink)) expect_safe(pair, run_trial(store(), pair));
}

/// Back at home, the body swings over the tool before it can touch.
TEST(FaultInjection, OfABodyThatSwingsOverTheToolLetsItTouchAgain) {
  const Event event{EventKind::kBodyMoved, 611, 150, 672727};
  expect_safe({event}, run_trial(store(), {event}));
}

/// In parts that can run side by side.
class FaultInjectionPart : public testing::TestWithParam<uint32_t> {};
constexpr uint32_t kParts = 4;

TEST_P(FaultInjectionPart, OfPairsOfEventsLeavesTheDeviceSafe) {
  ASSERT_EQ(store().failure(), "");
  test::Random random(4048 + GetParam());
  const uint32_t pairs = test::in_soak(100000u, kPairs) / kParts;
  for (uint32_t i = 0; i < pairs; ++i) {
    const std::vector<Event> pair = random_pair(random);
    expect_safe(pair, run_trial(store(), pair));
    if (test::is_soak() && i % 1000 == 999) std::printf("%u pairs\n", i + 1);
  }
}
INSTANTIATE_TEST_SUITE_P(FaultInjection, FaultInjectionPart, testing::Range(0u, kParts));

}  // namespace
}  // namespace palpate::fault
