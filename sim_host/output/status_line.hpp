// A line on a terminal that says what is being done; nothing when standard error is not a terminal.
#pragma once

#include <chrono>
#include <string>

namespace palpate::sim {

class StatusLine {
 public:
  StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine(StatusLine&&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;
  StatusLine& operator=(StatusLine&&) = delete;
  /// Clears the line.
  ~StatusLine();

  /// What everything from now on is part of: "3 of 14: at the paper's count 48".
  void begin(const std::string& task) { task_ = task; }
  /// Details; shown at most ten times a second.
  void show(const std::string& details);

 private:
  using Clock = std::chrono::steady_clock;

  bool is_terminal_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_;
  std::string task_;
};

}  // namespace palpate::sim
