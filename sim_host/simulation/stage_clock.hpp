// A probe that adds up the host's time by stage.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

namespace palpate::sim {

template <class Stage, uint32_t Count>
class StageClock {
 public:
  void enter(Stage) { start_ = Clock::now(); }
  void leave(Stage stage) { spent_[static_cast<std::size_t>(stage)] += Clock::now() - start_; }

  /// Since construction, by stage.
  [[nodiscard]] std::vector<double> milliseconds() const {
    std::vector<double> all;
    for (const auto spent : spent_) all.push_back(std::chrono::duration<double, std::milli>(spent).count());
    return all;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_;
  std::array<Clock::duration, Count> spent_{};
};

}  // namespace palpate::sim
