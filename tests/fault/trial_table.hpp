// What the trials of each event showed, as docs/safety.md has it.
#pragma once

#include "trial.hpp"

namespace palpate::fault {

class TrialTable {
 public:
  void add(EventKind kind, const Outcome& outcome);
  /// Trials of this kind in which its condition was raised.
  [[nodiscard]] uint32_t found(EventKind kind) const { return rows_[static_cast<std::size_t>(kind)].found; }
  [[nodiscard]] std::string text() const;

 private:
  struct Row {
    uint32_t trials, found, detected_in, zero_torque_in, recovery_ticks;
    bool needs_start;
  };
  std::array<Row, kEventKinds> rows_{};
};

/// The page shows `text` between its markers of this name; with PALPATE_WRITE_DOCS=1 it is put there.
void expect_in_page(const std::string& name, const std::string& text);

}  // namespace palpate::fault
