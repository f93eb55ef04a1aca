// Records a run of the cycle as it goes on: a row a tick, hashes and snapshots at their pace.
//
//   RunRecorder recorder(sink, state, start_of(state, "touch", true), {100, 1000});
//   each tick:  firmware::cycle(state, sensors, actuators, probe);  recorder.note(sensors);
//   recorder.end();
#pragma once

#include "recording/recording_writer.hpp"

namespace palpate::recording {

/// In ticks; 0: never.
struct Pace {
  uint32_t hash_every = 100;
  uint32_t snapshot_every = 0;
};

template <class Profile, class Sink>
class RunRecorder {
 public:
  /// A state that has done ticks before is recorded as a snapshot first.
  RunRecorder(Sink& sink, const firmware::CycleState<Profile>& state, const Start& start, Pace pace)
      : writer_(sink), state_(state), pace_(pace), tick_(state.core.tick) {
    writer_.begin(start);
    if (tick_ != 0) writer_.add_snapshot(tick_, state_);
  }

  /// After each cycle, with what it was fed with. A change that was refused is as none.
  void note(const firmware::Sensors& sensors) {
    const firmware::SettingChange& change = sensors.report.change;
    if (change.setting != 0 && !state_.is_setting_refused) writer_.add(tick_, change);
    ++tick_;
    writer_.add(row_of(sensors, state_));
    if (is_due(pace_.hash_every)) writer_.add(hashes_of(tick_, state_));
    if (is_due(pace_.snapshot_every)) writer_.add_snapshot(tick_, state_);
  }
  /// With the hashes of the last tick. kDone: the sink has taken everything.
  [[nodiscard]] container::WriteStatus end() {
    if (!is_due(pace_.hash_every)) writer_.add(hashes_of(tick_, state_));
    return writer_.end();
  }

 private:
  [[nodiscard]] bool is_due(uint32_t every) const { return every != 0 && tick_ % every == 0; }

  RecordingWriter<Sink> writer_;
  const firmware::CycleState<Profile>& state_;
  Pace pace_;
  uint32_t tick_;
};

}  // namespace palpate::recording
