// Which events are tried: all of them at ticks drawn with a fixed seed, more often where there is force.
#pragma once

#include <array>
#include <vector>

#include "device.hpp"
#include "event.hpp"
#include "support/random.hpp"

namespace palpate::fault {

/// A tick, a few, and long: beyond every detection time.
inline constexpr std::array<uint32_t, 3> kLengths = {1, 5, 150};

/// Builds that are many times slower try few.
#if defined(PALPATE_CHECKED) || defined(PALPATE_FEW_INJECTIONS)
inline constexpr bool kIsWhole = false;
#else
inline constexpr bool kIsWhole = true;
#endif
inline constexpr uint32_t kEventsOfAKind = kIsWhole ? 6 : 1;
inline constexpr uint32_t kPairs = kIsWhole ? 68 : 8;

/// The hand presses, or pulls.
inline uint32_t tick_with_force(test::Random& random) {
  return random.below(4) == 0 ? 690 + random.below(100) : 1240 + random.below(300);
}
inline uint32_t any_tick(test::Random& random) { return random.below(kScenarioTicks); }

inline constexpr uint32_t kDetails = 1u << 20;

inline std::vector<Event> events_of(EventKind kind, test::Random& random) {
  std::vector<Event> events;
  for (uint32_t i = 0; i < kEventsOfAKind; ++i) {
    const uint32_t start = i % 2 == 0 ? tick_with_force(random) : any_tick(random);
    events.push_back({kind, start, kLengths[(i + 2) % kLengths.size()], random.below(kDetails)});
  }
  return events;
}

/// The checked build ends itself where a mesh is broken.
inline bool can_be_tried([[maybe_unused]] EventKind kind) {
#ifdef PALPATE_CHECKED
  return kind != EventKind::kMeshLink;
#else
  return true;
#endif
}

inline Event random_event(test::Random& random, uint32_t start) {
  auto kind = EventKind::kMeshLink;
  do {
    kind = static_cast<EventKind>(random.below(kEventKinds));
  } while (!can_be_tried(kind));
  const uint32_t length = kLengths[random.below(kLengths.size())];
  return {kind, start, length, random.below(kDetails)};
}

/// The second one comes before the first one's consequences are over.
inline std::vector<Event> random_pair(test::Random& random) {
  const uint32_t start = random.below(2) == 0 ? tick_with_force(random) : any_tick(random);
  const Event first = random_event(random, start);
  return {first, random_event(random, start + random.below(kWatchedTicks))};
}

}  // namespace palpate::fault
