// The recording of a simulated run (`--record`), a file that grows with it.
#pragma once

#include <memory>

#include "output/recording_file.hpp"
#include "recording/run_recorder.hpp"
#include "scenario/errors.hpp"
#include "scenario/scenario.hpp"

namespace palpate::sim {

template <class Profile>
class CycleRecorder {
 public:
  /// `state` has been started, and guarded if a hand holds the device.
  CycleRecorder(const Scenario& scenario, firmware::CycleState<Profile>& state, bool is_guarded)
      : file_(scenario.record),
        recorder_(file_, state, recording::start_of(state, scenario.name, is_guarded),
                  {static_cast<uint32_t>(scenario.hash_every), kSnapshotEvery}) {}

  void note(const firmware::Sensors& sensors) { recorder_.note(sensors); }
  void end() { file_.close(recorder_.end()); }

 private:
  static constexpr uint32_t kSnapshotEvery = 5000;

  RecordingFile file_;
  recording::RunRecorder<Profile, RecordingFile> recorder_;
};

/// Nothing when the scenario asks for none.
template <class Profile>
std::unique_ptr<CycleRecorder<Profile>> make_recorder(const Scenario& scenario,
                                                      firmware::CycleState<Profile>& state, bool is_guarded) {
  if (scenario.record.empty()) return nullptr;
  return std::make_unique<CycleRecorder<Profile>>(scenario, state, is_guarded);
}

}  // namespace palpate::sim
