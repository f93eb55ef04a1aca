// Plant, hand, firmware cycle and user in a closed loop, as `hil touch` has them, but as one value: a copy is
// a snapshot. Around the cycle it does what the firmware's tick interrupt does.
#pragma once

#include "device.hpp"

namespace palpate::fault {

/// A tick on its way from the plant to the cycle: what an injector may change.
struct TickCase {
  firmware::Sensors sensors{};
  bool is_late = false;     ///< the cycle will end after the next one is due
  bool loses_edge = false;  ///< an edge of the watchdog's line will not reach the amplifiers
};

class Loop {
 public:
  Loop() : Loop(scenario_hand(), device_parameters()) {}
  Loop(const plant::Hand& usual_hand, const safety::Parameters& parameters);

  /// `inject(TickCase&, Loop&)` sees the tick before the cycle does.
  template <class Inject>
  void advance(Inject&& inject) {
    look();
    inject(now, *this);
    compute();
  }
  void advance() {
    advance([](TickCase&, Loop&) {});
  }

  /// The hand that the loop began with is back.
  void return_hand() { plant.hand_over(usual_hand_); }
  /// A new start of the firmware, whatever it was; the plant goes on.
  void start_firmware();
  /// From now on the hand goes from where the tip is through these places; times from now, in s.
  void lead_hand(const std::vector<plant::Knot>& way);

  [[nodiscard]] uint32_t tick() const { return plant.output().tick; }
  [[nodiscard]] safety::State state() const { return cycle.safety.state; }
  [[nodiscard]] bool is_at_reset_pose() const;
  [[nodiscard]] bool has_torque() const;

  plant::Plant plant;
  Cycle cycle{};
  TickCase now;                                     // of the last tick
  firmware::Actuators given = firmware::at_rest();  // by the last tick
  uint32_t timer = uint32_t{0} - 700;               // the tick's number; it wraps in the scenario
  uint32_t reading = uint32_t{0} - 1100;            // the number of the sensors' message
  uint32_t ticks_unfed = 0;                         // that the amplifiers have seen no edge
  bool was_late = false;                            // the last cycle ended after this one was due
  bool line_level = false;                          // of the amplifiers' watchdog

 private:
  void look();
  void compute();

  plant::Hand usual_hand_;
  safety::Parameters parameters_;
};

}  // namespace palpate::fault
