// What a recording holds, at a glance.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "recording/recording_reader.hpp"

namespace palpate::recording {

struct StateChange {
  uint32_t tick;  // after which the new state holds
  safety::State from, to;
  std::string cause;  // name of the event
};

struct ConditionUse {
  safety::Condition condition;
  uint32_t first_tick, last_tick, ticks;
};

/// Lowest and highest of a figure.
struct Span {
  int32_t least, most;
};

/// Of one motor: the code farthest from no current.
struct PeakCode {
  uint16_t code = phantom::kZeroCode;
  uint32_t tick = 0;
};

struct RecordedChange {
  uint32_t tick;
  firmware::SettingChange change;
};

struct Inspection {
  /// Longer lists keep their beginning; the numbers beside them count all.
  static constexpr std::size_t kMostListed = 1000;

  Start start;
  bool has_start = false;   // a file that ends before is of no use
  uint32_t first_tick = 0;  // it begins after so many ticks
  uint32_t ticks = 0;       // rows
  uint32_t chunks = 0;
  uint32_t hash_points = 0;
  uint32_t snapshots = 0;
  uint32_t lost_ticks = 0;    // numbers that the timer skipped
  uint32_t late_ticks = 0;    // cycles that ended after the next one was due
  uint32_t mute_ticks = 0;    // without a new message of the sensors
  uint32_t torque_ticks = 0;  // with the amplifiers on
  uint32_t flags = 0;         // TickFlag bits of any tick
  uint32_t state_change_count = 0;
  uint32_t change_count = 0;
  std::vector<StateChange> state_changes;
  std::vector<ConditionUse> conditions;  // in the order of urgency
  std::vector<RecordedChange> changes;
  std::array<Span, 3> counts{};
  std::array<PeakCode, 3> peak_codes;
  safety::State last_state = safety::State::kBoot;
  firmware::Fault last_fault = firmware::Fault::kNone;
  /// Of the file at last: kEnd or kCut, or why it is refused.
  Finding finding = Finding::nothing();

  [[nodiscard]] bool is_usable() const {
    return has_start && container::is_usable(container::Kind::kRecording, finding.status);
  }
  [[nodiscard]] bool is_cut() const { return finding.status == ReadStatus::kCut; }
};

Inspection inspect(Bytes file);

/// Lines for a reader, and the same for a program (docs/container-format.md names the keys).
std::string inspection_text(const Inspection& inspection);
std::string inspection_json(const Inspection& inspection);

/// Figures of the rows over time, thinned to at most so many bins: of each bin the lowest and the highest.
struct Curves {
  static constexpr uint32_t kMostBins = 1000;
  std::vector<double> time_s;  // of each bin's beginning
  std::array<std::vector<Span>, 3> counts, codes;
  std::vector<Span> state;
};
/// Of a recording that `inspect` found usable.
Curves read_curves(Bytes file, const Inspection& inspection);

}  // namespace palpate::recording
