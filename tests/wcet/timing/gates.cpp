#include "gates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "timing_report.hpp"

namespace palpate::wcet::timing {
namespace {

constexpr double kMostGrowth = 1.02;
constexpr double kMostFormulaError = 0.01;

std::string newest_section(const std::string& changelog) {
  constexpr std::string_view kHeading = "\n## ";
  const std::string text = "\n" + changelog;
  const size_t first = text.find(kHeading);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find(kHeading, first + 1) - first);
}

Cycles to_number(std::string digits) {
  digits.erase(std::remove(digits.begin(), digits.end(), ' '), digits.end());
  return std::stoll(digits);
}

bool has_grown(Cycles now, Cycles before) {
  return static_cast<double>(now) > kMostGrowth * static_cast<double>(before);
}

class Judge {
 public:
  Judge(const ProfileTiming& timing, const std::string& changelog)
      : timing_(timing), announced_(find_announced(changelog, timing.name, timing.row.core)) {}

  std::vector<Finding> run() {
    const DesignFigures& design = timing_.row.design;
    const CommittedFigures& before = timing_.row.committed;
    const CommittedFigures now = timing_.now();
    judge_design("cycles", design.cycles, now.cycles, before.cycles);
    judge_design("bytes of RAM", design.ram_bytes, now.ram_bytes, before.ram_bytes);
    judge_design("bytes of tick code", design.tick_code_bytes, now.tick_code_bytes, before.tick_code_bytes);
    judge_design("bytes of stack", design.stack_bytes, now.stack_bytes, before.stack_bytes);
    if (design.goal_cycles && now.cycles > *design.goal_cycles)
      say(false,
          fmt::format("goal not met: {} cycles of {}", grouped(now.cycles), grouped(*design.goal_cycles)));
    judge_growth("cycles", now.cycles, before.cycles, announced_ ? announced_->cycles : 0);
    judge_growth("instructions", now.instructions, before.instructions,
                 announced_ ? announced_->instructions : 0);
    judge_boards();
    judge_measurement();
    judge_formula();
    return std::move(findings_);
  }

 private:
  void say(bool is_failure, const std::string& what) {
    findings_.push_back({is_failure, fmt::format("{} on {}: {}", timing_.name, timing_.row.core, what)});
  }

  void judge_design(const char* unit, std::optional<Cycles> bound, Cycles now, Cycles before) {
    if (!bound || now <= *bound) return;
    const bool was_met = before <= *bound;
    say(was_met, fmt::format("{}: {} {} of {}", was_met ? "passes its design" : "design not met yet",
                             grouped(now), unit, grouped(*bound)));
  }

  void judge_growth(const char* unit, Cycles now, Cycles before, Cycles announced) {
    const double percent = 100.0 * static_cast<double>(now - before) / static_cast<double>(before);
    const std::string change =
        fmt::format("{} {}, {:+.1f} % of the committed {}", grouped(now), unit, percent, grouped(before));
    if (has_grown(before, now)) say(false, change + ": palpate-timing commit");
    if (!has_grown(now, before)) return;
    if (!has_grown(now, announced)) return say(false, change + ", as CHANGELOG.md says");
    say(true, fmt::format(
                  "{}; the newest section of CHANGELOG.md needs a line\n  - Timing: {} on {}: {} cycles, {} "
                  "instructions",
                  change, timing_.name, timing_.row.core, grouped(timing_.figures.cycles),
                  grouped(timing_.figures.instructions)));
  }

  void judge_boards() {
    for (const BoardTiming& board : timing_.boards) {
      if (board.board.profile == timing_.row.profile && board.slack_us() < 0)
        say(true, fmt::format("its tick takes {:.0f} us on the board whose preset has it, {}",
                              board.microseconds(), board.board.name));
    }
  }

  void judge_measurement() {
    if (!timing_.measured) return;
    const Cycles seen = timing_.measured->max_observed_instructions;
    if (seen > timing_.figures.instructions)
      say(true, fmt::format("{} instructions were seen, more than the bound of {}", grouped(seen),
                            grouped(timing_.figures.instructions)));
  }

  void judge_formula() {
    if (!timing_.formula) return;
    for (const char* quantity : {"leaves", "nodes"}) {
      const auto& terms = timing_.formula->terms;
      const auto is_it = [&](const FormulaTerm& term) { return term.quantity == quantity && term.each > 0; };
      if (std::none_of(terms.begin(), terms.end(), is_it))
        say(true, std::string("the formula knows no loop over ") + quantity);
    }
    if (timing_.formula_error > kMostFormulaError)
      say(true, fmt::format("the formula misses the bound of other quantities by {:.1f} %",
                            100 * timing_.formula_error));
  }

  const ProfileTiming& timing_;
  std::optional<Announced> announced_;
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> judge(const ProfileTiming& timing, const std::string& changelog) {
  return Judge(timing, changelog).run();
}

std::optional<Announced> find_announced(const std::string& changelog, const std::string& profile,
                                        const std::string& core) {
  const std::regex line("Timing: " + profile + " on " + core +
                        ": ([0-9][0-9 ]*) cycles, ([0-9][0-9 ]*) instructions");
  const std::string section = newest_section(changelog);
  std::smatch found;
  if (!std::regex_search(section, found, line)) return std::nullopt;
  return Announced{to_number(found[1]), to_number(found[2])};
}

}  // namespace palpate::wcet::timing
