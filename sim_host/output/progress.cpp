#include "output/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <string>

namespace palpate::sim {

Progress::Progress(uint32_t total_ticks)
    : total_ticks_(total_ticks), is_terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (is_terminal_) fmt::print(stderr, "\r\033[K");
}

void Progress::show(uint32_t ticks) {
  constexpr auto kPause = std::chrono::milliseconds(100);
  constexpr double kWidth = 30.0;
  if (!is_terminal_) return;
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + kPause;
  const double part = static_cast<double>(ticks) / total_ticks_;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const std::string bar(static_cast<std::size_t>(part * kWidth), '#');
  fmt::print(stderr, "\r[{:<30}] {:3.0f} %  {} of {} ticks, {:.0f} ticks/s\033[K", bar, part * 100.0, ticks,
             total_ticks_, seconds > 0.0 ? ticks / seconds : 0.0);
}

}  // namespace palpate::sim
