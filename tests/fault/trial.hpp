// A trial: the scenario from the last snapshot before the first event, the events, some hundred ticks, and
// then the way back to force.
#pragma once

#include <optional>
#include <vector>

#include "checks.hpp"
#include "event.hpp"

namespace palpate::fault {

struct Snapshot {
  Loop loop;
  Checks checks;
};

/// The scenario undisturbed, kept every 50 ticks.
class SnapshotStore {
 public:
  static constexpr uint32_t kEvery = 50;
  SnapshotStore();

  /// The last one before this tick.
  [[nodiscard]] const Snapshot& before(uint32_t tick) const { return snapshots_[tick / kEvery]; }
  [[nodiscard]] std::size_t size() const { return snapshots_.size(); }
  /// What went wrong undisturbed; empty: nothing.
  [[nodiscard]] const std::string& failure() const { return failure_; }
  [[nodiscard]] const PoolsInUse& pools_at_rest() const { return pools_at_rest_; }

 private:
  std::vector<Snapshot> snapshots_;
  std::string failure_;
  PoolsInUse pools_at_rest_{};
};

struct Outcome {
  std::string failure;          ///< the first rule that did not hold; empty: all held
  Checks checks;                ///< before any new start
  uint32_t recovery_ticks = 0;  ///< from a hand that starts for home to Active
  bool needed_new_start = false;
};

Outcome run_trial(const SnapshotStore& store, const std::vector<Event>& events);

}  // namespace palpate::fault
