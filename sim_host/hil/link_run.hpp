// `hil` with the device here and the firmware elsewhere: its binary in QEMU (--board qemu), or on a bench at
// the other end of a serial line (--port).
#pragma once

#include <functional>

#include "output/run_folder.hpp"
#include "scenario/scenario.hpp"

namespace palpate::sim {

struct LinkRun {
  uint32_t ticks;
  double peak_hand_force_n;
  double duration_s;
  std::string last_state;  // of the safety layer
  std::string state_hash;  // of the last tick; "unknown" where no console says it
};

/// Writes device.csv, the model, and in QEMU console.csv. A board on a bench has its model already. `watch`
/// sees the number of each tick. Throws EnvironmentError when the firmware does not run to its end.
LinkRun run_over_link(const Scenario& scenario, const RunFolder& folder,
                      const std::function<void(uint32_t)>& watch);

}  // namespace palpate::sim
