#include "trial.hpp"

#include <algorithm>

#include "injector.hpp"
#include "recovery.hpp"
#include "support/soak.hpp"

namespace palpate::fault {
namespace {

bool has(const std::vector<Event>& events, EventKind kind) {
  return std::any_of(events.begin(), events.end(), [kind](const Event& event) { return event.kind == kind; });
}

constexpr uint32_t kLookEvery = 8;

/// Half of a trial's time is the wait for a body at rest: a soak waits in one of so many.
constexpr uint32_t kSoakRestEvery = 8;

uint32_t first_tick(const std::vector<Event>& events) {
  uint32_t first = events.front().start;
  for (const Event& event : events) first = std::min(first, event.start);
  return first;
}

uint32_t last_tick(const std::vector<Event>& events) {
  uint32_t last = 0;
  for (const Event& event : events) last = std::max(last, event.end());
  return last;
}

/// From the snapshot until the events are over and some hundred ticks more have passed.
std::string run_events(Snapshot& now, const std::vector<Event>& events) {
  std::vector<Injector> injectors(events.begin(), events.end());
  const uint32_t end = last_tick(events) + kWatchedTicks;
  std::string failure;
  while (failure.empty() && now.loop.tick() < end) {
    now.loop.advance([&](TickCase& tick, Loop& loop) {
      for (Injector& injector : injectors) injector(tick, loop);
    });
    failure = now.checks.see(now.loop);
  }
  return failure;
}

/// A count out of range needs a new start, and a mesh that is broken, unless a change of the mesh has mended
/// it.
std::string check_need(const Snapshot& now, const std::vector<Event>& events, bool needs_start) {
  const bool is_broken = now.checks.causes().ticks_of(safety::Condition::kInvariantBroken) > 0;
  const bool may = has(events, EventKind::kMeshLink) || has(events, EventKind::kCountRange);
  const bool must = is_broken || has(events, EventKind::kCountRange);
  if (must && !needs_start) return "it does not ask for a new start";
  return needs_start && !may ? "it asks for a new start" : "";
}

}  // namespace

SnapshotStore::SnapshotStore() {
  Snapshot now{Loop(), Checks()};
  pools_at_rest_ = pools_in_use(now.loop.cycle);
  while (failure_.empty() && now.loop.tick() <= kScenarioTicks) {
    if (now.loop.tick() % kEvery == 0) snapshots_.push_back(now);
    now.loop.advance();
    failure_ = now.checks.see(now.loop);
  }
}

Outcome run_trial(const SnapshotStore& store, const std::vector<Event>& events) {
  Snapshot now = store.before(std::max(1u, first_tick(events)) - 1);
  if (std::any_of(events.begin(), events.end(), [](const Event& event) { return may_clamp(event.kind); })) {
    now.checks.allow_clamps();
  }
  if (has(events, EventKind::kMeshLink)) now.checks.allow_broken_mesh();
  now.checks.look_at_mesh_every(kLookEvery);
  Outcome outcome;
  outcome.failure = run_events(now, events);
  outcome.checks = now.checks;
  if (!outcome.failure.empty()) return outcome;
  Recovery recovery(now.loop, now.checks);
  outcome.needed_new_start = now.loop.cycle.safety.raised.overlaps(safety::kUntilNewStart);
  outcome.failure = check_need(now, events, outcome.needed_new_start);
  if (!outcome.failure.empty()) return outcome;
  outcome.failure = recovery.run(outcome.needed_new_start);
  outcome.recovery_ticks = recovery.ticks_to_active();
  const bool waits_for_rest = first_tick(events) % test::in_soak(kSoakRestEvery, 1u) == 0;
  if (outcome.failure.empty() && waits_for_rest) {
    outcome.failure = recovery.come_to_rest(store.pools_at_rest());
  }
  return outcome;
}

}  // namespace palpate::fault
