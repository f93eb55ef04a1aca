// Stands between plant and cycle, and does what an event says, from its first tick on; in the tick after its
// last one it puts right what it had changed for good.
#pragma once

#include "event.hpp"
#include "loop.hpp"

namespace palpate::fault {

class Injector {
 public:
  explicit Injector(const Event& event) : event_(event) {}

  void operator()(TickCase& now, Loop& loop);
  [[nodiscard]] const Event& event() const { return event_; }

 private:
  void spoil(TickCase& now, Loop& loop, bool is_first);
  void mend(Loop& loop) const;
  void spoil_counts(TickCase& now, bool is_first);
  void spoil_clockwork(TickCase& now, Loop& loop);
  void request(TickCase& now) const;
  [[nodiscard]] std::size_t joint() const { return event_.detail % 3; }

  Event event_;
  firmware::Sensors before_{};  // of the first tick, or of the one before it
};

}  // namespace palpate::fault
