// The recording of a simulated run (`--record`), a file that grows with it.
#pragma once

#include <memory>

#include "output/output_file.hpp"
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
        recorder_(sink_, state, recording::start_of(state, scenario.name, is_guarded),
                  {static_cast<uint32_t>(scenario.hash_every), kSnapshotEvery}) {}

  void note(const firmware::Sensors& sensors) { recorder_.note(sensors); }
  void end() {
    if (recorder_.end() != container::WriteStatus::kDone)
      throw std::logic_error("a recording that cannot be written");
    file_.close();
  }

 private:
  static constexpr uint32_t kSnapshotEvery = 5000;

  /// A full disk throws.
  struct Sink {
    OutputFile& file;
    bool operator()(const uint8_t* bytes, uint32_t size) {
      file.write(reinterpret_cast<const char*>(bytes), size);
      return true;
    }
  };

  OutputFile file_;
  Sink sink_{file_};
  recording::RunRecorder<Profile, Sink> recorder_;
};

/// Nothing when the scenario asks for none.
template <class Profile>
std::unique_ptr<CycleRecorder<Profile>> make_recorder(const Scenario& scenario,
                                                      firmware::CycleState<Profile>& state, bool is_guarded) {
  if (scenario.record.empty()) return nullptr;
  return std::make_unique<CycleRecorder<Profile>>(scenario, state, is_guarded);
}

}  // namespace palpate::sim
