#include "output/status_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

namespace palpate::sim {

StatusLine::StatusLine() : is_terminal_(isatty(STDERR_FILENO) == 1) {}

StatusLine::~StatusLine() {
  if (is_terminal_) fmt::print(stderr, "\r\033[K");
}

void StatusLine::show(const std::string& details) {
  constexpr auto kPause = std::chrono::milliseconds(100);
  if (!is_terminal_) return;
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + kPause;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  fmt::print(stderr, "\r{:4.0f} s  {}: {}\033[K", seconds, task_, details);
}

}  // namespace palpate::sim
