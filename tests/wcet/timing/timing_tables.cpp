#include <fmt/format.h>

#include <cmath>
#include <map>
#include <vector>

#include "timing_report.hpp"

namespace palpate::wcet::timing {

const char* const kCaveat =
    "Cycles on m4 are by Arm's own table at zero wait states. Cycles on m7 hold under a stated model, since "
    "Arm publishes no "
    "table: they are to be confirmed on a board with DWT CYCCNT. Device registers cost what "
    "tests/wcet/devices assumes, "
    "unmeasured.";

namespace {

std::string measured_text(const ProfileTiming& timing) {
  return timing.measured ? grouped(timing.measured->max_observed_instructions) : "not measured";
}

std::string ratio_text(const ProfileTiming& timing) {
  return timing.measured ? fmt::format("{:.2f}", *timing.ratio()) : "";
}

std::string predicted_text(const ProfileTiming& timing) {
  return timing.figures.predicted_cycles ? grouped(*timing.figures.predicted_cycles) : "";
}

std::string design_text(const ProfileTiming& timing) {
  const std::optional<Cycles>& design = timing.row.design.cycles;
  if (!design) return "none";
  return fmt::format("{}, {}", grouped(*design), timing.figures.cycles <= *design ? "met" : "not met");
}

std::string formula_text(const ProfileTiming& timing) {
  std::string text =
      fmt::format("{} on {}: cycles <= {:.0f}", timing.name, timing.row.core, timing.formula->constant);
  for (const FormulaTerm& term : timing.formula->terms)
    text += fmt::format(" + {:.0f} x {} ({})", term.each, term.quantity, term.count);
  return text;
}

std::string profiles_in_text(const std::vector<ProfileTiming>& timings) {
  constexpr const char* kRow = "{:<14} {:<5} {:>13} {:>13} {:>6} {:>11} {:>11} {:>20} {:>7} {:>8} {:>8}\n";
  std::string text = fmt::format(fmt::runtime(kRow), "profile", "core", "bound, instr.", "most observed",
                                 "ratio", "cycles", "predicted", "design, cycles", "stack", "RAM", "code");
  for (const ProfileTiming& timing : timings) {
    const CommittedFigures now = timing.now();
    text += fmt::format(fmt::runtime(kRow), timing.name, timing.row.core, grouped(now.instructions),
                        measured_text(timing), ratio_text(timing), grouped(now.cycles),
                        predicted_text(timing), design_text(timing), grouped(now.stack_bytes),
                        grouped(now.ram_bytes), grouped(now.tick_code_bytes));
  }
  return text;
}

std::string boards_in_text(const std::vector<ProfileTiming>& timings) {
  std::string text = fmt::format("{:<14} {:<16} {:>8} {:>11} {:>11} {:>12}\n", "profile", "board", "MHz",
                                 "cycles", "us", "slack, us");
  for (const ProfileTiming& timing : timings) {
    for (const BoardTiming& board : timing.boards) {
      text +=
          fmt::format("{:<14} {:<16} {:>8.0f} {:>11} {:>11.1f} {:>12.1f}\n", timing.name, board.board.name,
                      board.board.clock_mhz, grouped(board.cycles), board.microseconds(), board.slack_us());
    }
  }
  return text;
}

std::string profiles_in_markdown(const std::vector<ProfileTiming>& timings) {
  std::string text =
      "| profile | core | bound, instructions | most observed | bound, cycles | static predictor | design |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const ProfileTiming& timing : timings) {
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", timing.name, timing.row.core,
                        grouped(timing.figures.instructions), measured_text(timing),
                        grouped(timing.figures.cycles), predicted_text(timing), design_text(timing));
  }
  return text;
}

std::string memory_in_markdown(const std::vector<ProfileTiming>& timings) {
  std::string text =
      "| profile | core | stack: background + frame + tick | RAM | tick code | flash "
      "|\n|---|---|---|---|---|---|\n";
  for (const ProfileTiming& timing : timings) {
    const ImageFigures& figures = timing.figures;
    text += fmt::format("| {} | {} | {} + {} + {} = {} | {} | {} | {} |\n", timing.name, timing.row.core,
                        figures.stack.background, figures.stack.frame, figures.stack.interrupt,
                        figures.stack.bytes(), grouped(figures.ram_bytes()), grouped(figures.tick_code_bytes),
                        grouped(figures.flash_bytes()));
  }
  return text;
}

std::string boards_in_markdown(const std::vector<ProfileTiming>& timings) {
  std::string text =
      "| profile | board | clock, MHz | cycles | µs | slack of 1 ms, µs |\n|---|---|---|---|---|---|\n";
  for (const ProfileTiming& timing : timings) {
    for (const BoardTiming& board : timing.boards) {
      text +=
          fmt::format("| {} | {} | {:.0f} | {} | {} | {} |\n", timing.name, board.board.name,
                      board.board.clock_mhz, grouped(board.cycles),
                      grouped(std::llround(board.microseconds())), grouped(std::llround(board.slack_us())));
    }
  }
  return text;
}

// Rows by name and columns by profile; what a profile does not have is empty.
class MarkdownMatrix {
 public:
  explicit MarkdownMatrix(const std::string& corner) : head_("| " + corner + " |"), line_("|---|") {}

  void begin_column(const ProfileTiming& timing) {
    ++columns_;
    head_ += fmt::format(" {}, {} |", timing.name, timing.row.core);
    line_ += "---|";
  }
  void add(const std::string& row, const std::string& cell) {
    if (cells_.count(row) == 0) order_.push_back(row);
    std::vector<std::string>& cells = cells_[row];
    cells.resize(columns_);
    cells.back() = cell;
  }
  [[nodiscard]] std::string text() {
    std::string text = head_ + "\n" + line_ + "\n";
    for (const std::string& row : order_) {
      cells_[row].resize(columns_);
      text += "| " + row + " |";
      for (const std::string& cell : cells_[row]) text += " " + cell + " |";
      text += "\n";
    }
    return text;
  }

 private:
  std::string head_, line_;
  size_t columns_ = 0;
  std::vector<std::string> order_;
  std::map<std::string, std::vector<std::string>> cells_;
};

std::string stages_in_markdown(const std::vector<ProfileTiming>& timings) {
  MarkdownMatrix matrix("cycles of a stage, all its calls");
  for (const ProfileTiming& timing : timings) {
    matrix.begin_column(timing);
    for (const PathRow& stage : timing.figures.stages)
      matrix.add(stage.name, grouped(std::llround(stage.with_callees)));
  }
  return matrix.text();
}

std::string formulas_in_markdown(const std::vector<ProfileTiming>& timings) {
  MarkdownMatrix matrix("cycles of each");
  for (const ProfileTiming& timing : timings) {
    if (!timing.formula) return "";
    matrix.begin_column(timing);
    matrix.add("constant", grouped(std::llround(timing.formula->constant)));
    for (const FormulaTerm& term : timing.formula->terms)
      matrix.add(term.quantity, fmt::format("{} x {}", grouped(std::llround(term.each)), term.count));
  }
  return matrix.text();
}

}  // namespace

std::string grouped(Cycles number) {
  std::string text = std::to_string(number);
  const size_t first = text[0] == '-' ? 1 : 0;
  for (size_t at = text.size(); at > first + 3;) text.insert(at -= 3, " ");
  return text;
}

std::string make_tables(const std::vector<ProfileTiming>& timings) {
  std::string text = profiles_in_text(timings) + "\n" + boards_in_text(timings) + "\n" + kCaveat + "\n";
  for (const ProfileTiming& timing : timings) {
    if (timing.formula) text += "\n" + formula_text(timing) + "\n";
  }
  return text;
}

std::string make_markdown(const std::vector<ProfileTiming>& timings) {
  return profiles_in_markdown(timings) + "\n" + boards_in_markdown(timings) + "\n" +
         stages_in_markdown(timings) + "\n" + memory_in_markdown(timings) + "\n" +
         formulas_in_markdown(timings);
}

}  // namespace palpate::wcet::timing
