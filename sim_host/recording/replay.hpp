// Runs a recording again, on this machine and with this program, and says where it no longer does the same.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "recording/recording_reader.hpp"

namespace palpate::recording {

/// A difference between what is recorded and what is computed after `tick` ticks.
struct Mismatch {
  uint32_t tick;
  std::string what;  // "stage forces", "motor code 2"
  std::string recorded, computed;
};

struct ReplayOptions {
  /// Begins with the last snapshot at or before this tick, or at the start where there is none.
  uint32_t from_tick = 0;
};

struct ReplayReport {
  Start start;
  bool has_start = false;    // a file that ends before is of no use
  uint32_t first_tick = 0;   // it began after so many ticks
  uint32_t last_tick = 0;    // and ended after so many
  uint32_t hash_points = 0;  // compared
  uint32_t mismatches = 0;
  std::optional<Mismatch> first;
  /// Of the file at last: kEnd or kCut, or why it is refused; then nothing was run.
  Finding finding = Finding::nothing();

  [[nodiscard]] bool is_usable() const {
    return has_start && container::is_usable(container::Kind::kRecording, finding.status);
  }
};

/// Rows are compared after every tick, hashes where there are some. `on_mismatch` sees each difference, of a
/// tick the first one only, and says whether to go on. The whole file is checked before the first tick is
/// run.
ReplayReport replay(Bytes file, const ReplayOptions& options,
                    const std::function<bool(const Mismatch&)>& on_mismatch);

}  // namespace palpate::recording
