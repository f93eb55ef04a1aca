// A line on a terminal that shows how far a run is; nothing when standard error is not a terminal.
#pragma once

#include <chrono>
#include <cstdint>

namespace palpate::sim {

class Progress {
 public:
  explicit Progress(uint32_t total_ticks);
  Progress(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress& operator=(Progress&&) = delete;
  /// Clears the line.
  ~Progress();

  void show(uint32_t ticks);

 private:
  using Clock = std::chrono::steady_clock;

  uint32_t total_ticks_;
  bool is_terminal_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_;
};

}  // namespace palpate::sim
