// A quiet device for tests of the whole safety layer: each tick all is well, until a test spoils it.
#pragma once

#include <array>

#include "palpate/safety/safety.hpp"

namespace palpate::safety::test {

inline constexpr Ampere kNoCurrent = Ampere::from_raw(0);
/// The motor codes of no current.
inline constexpr std::array<uint16_t, 3> kZeroCodes{2048, 2048, 2048};

inline Force3 force_along_x(phantom::Newton newtons) {
  Force3 force = zero_vector<phantom::Newton>();
  force.x() = newtons;
  return force;
}

/// All is well, in tick `number`.
inline Observation quiet(uint32_t number) {
  return {{},
          zero_vector<phantom::Metre>(),
          zero_vector<phantom::Newton>(),
          {kNoCurrent, kNoCurrent, kNoCurrent},
          {number, number, false},
          ConditionSet(),
          EventSet()};
}

/// A tick of the layer.
inline Verdict guard(Safety& safety, const Observation& seen) {
  (void)sense(safety, seen);
  return judge(safety, seen);
}

class BenchArm {
 public:
  explicit BenchArm(const Parameters& parameters = kPremium15Parameters) : safety(make_safety(parameters)) {}

  /// The next tick; `spoil` changes what it shows.
  template <class Spoil>
  Verdict tick(Spoil spoil) {
    Observation seen = quiet(++number_);
    spoil(seen);
    return guard(safety, seen);
  }
  Verdict tick(EventSet requests = EventSet()) {
    return tick([&](Observation& seen) { seen.requests = requests; });
  }
  Verdict tick(Event request) { return tick(EventSet::of(request)); }

  Verdict run(int ticks) {
    Verdict last{};
    for (int i = 0; i < ticks; ++i) last = tick();
    return last;
  }
  void reach_idle() {
    for (const Event event :
         {Event::kBootDone, Event::kSelfTestPassed, Event::kCalibrationStarted, Event::kCalibrationDone}) {
      (void)tick(event);
    }
  }
  void reach_active() {
    reach_idle();
    (void)tick(Event::kEnable);
    (void)run(2010);
  }

  Safety safety;

 private:
  uint32_t number_ = 0;
};

}  // namespace palpate::safety::test
