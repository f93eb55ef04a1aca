// The probe of the firmware: how long each stage and each tick take. It reads a clock and nothing else, and
// nothing that it knows enters the state.
#pragma once

#include "palpate/firmware/stage.hpp"
#include "palpate/ports/cycle_counter.hpp"

namespace palpate::firmware {

struct TimeFigure {
  uint32_t max_cycles = 0;
  uint64_t total_cycles = 0;

  void add(uint32_t cycles) {
    if (cycles > max_cycles) max_cycles = cycles;
    total_cycles += cycles;
  }
};

class StageTimer {
 public:
  void begin_tick() {
    tick_start_ = port::read_cycle_counter();
    for (const uint32_t stage : bounded<kStageCount>(kStageCount, [] {})) this_tick_[stage] = 0;
  }
  void enter(Stage stage) { starts_[index(stage)] = port::read_cycle_counter(); }
  /// A stage may run several times in a tick; its time is then the sum.
  void leave(Stage stage) { this_tick_[index(stage)] += port::read_cycle_counter() - starts_[index(stage)]; }
  void end_tick() {
    tick_.add(port::read_cycle_counter() - tick_start_);
    for (const uint32_t stage : bounded<kStageCount>(kStageCount, [] {}))
      stages_[stage].add(this_tick_[stage]);
  }

  /// Cycles of each stage since begin_tick.
  [[nodiscard]] const std::array<uint32_t, kStageCount>& this_tick() const { return this_tick_; }
  [[nodiscard]] const TimeFigure& tick() const { return tick_; }
  [[nodiscard]] const TimeFigure& stage(Stage stage) const { return stages_[index(stage)]; }

 private:
  static constexpr uint32_t index(Stage stage) { return static_cast<uint32_t>(stage); }

  TimeFigure tick_;
  std::array<TimeFigure, kStageCount> stages_;
  uint32_t tick_start_ = 0;
  std::array<uint32_t, kStageCount> starts_{};
  std::array<uint32_t, kStageCount> this_tick_{};
};

}  // namespace palpate::firmware
