#include "trial_table.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace palpate::fault {
namespace {

constexpr const char* kPage = PALPATE_SOURCE_FOLDER "/docs/safety.md";

/// Up to a multiple of 50: the plant is in doubles, and another libm may move a tick.
uint32_t rounded_up(uint32_t ticks) { return (ticks + 49) / 50 * 50; }

std::string ticks_text(uint32_t ticks) { return ticks == 0 ? "" : fmt::format("{}", ticks); }

}  // namespace

void TrialTable::add(EventKind kind, const Outcome& outcome) {
  Row& row = rows_[static_cast<std::size_t>(kind)];
  ++row.trials;
  row.recovery_ticks = std::max(row.recovery_ticks, outcome.recovery_ticks);
  row.needs_start = row.needs_start || outcome.needed_new_start;
  uint32_t detected_in = 0;
  for (uint32_t i = 0; i < safety::kConditionCount; ++i) {
    const auto condition = static_cast<safety::Condition>(i);
    if (expected_of(kind).has(condition)) detected_in = outcome.checks.detected_in(condition);
  }
  row.found += detected_in > 0 ? 1u : 0u;
  row.detected_in = std::max(row.detected_in, detected_in);
  row.zero_torque_in = std::max(row.zero_torque_in, outcome.checks.zero_torque_in());
}

std::string TrialTable::text() const {
  std::string text =
      "| event | injections | found | detected in, ticks | zero torque in, ticks | active again in, ticks |\n"
      "|---|---|---|---|---|---|\n";
  for (uint32_t i = 0; i < kEventKinds; ++i) {
    const Row& row = rows_[i];
    text += fmt::format("| {} | {} | {} | {} | {} | {}{} |\n", event_text(static_cast<EventKind>(i)),
                        row.trials, row.found, ticks_text(row.detected_in), ticks_text(row.zero_torque_in),
                        rounded_up(row.recovery_ticks), row.needs_start ? ", after a new start" : "");
  }
  return text;
}

void expect_in_page(const std::string& name, const std::string& text) {
  std::stringstream read;
  read << std::ifstream(kPage).rdbuf();
  const std::string page = read.str();
  const std::string begin = "<!-- " + name + ": begin -->\n";
  const std::size_t from = page.find(begin);
  const std::size_t to = page.find("<!-- " + name + ": end -->\n");
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos) << kPage << " has no markers of " << name;
  const std::string before = page.substr(0, from + begin.size());
  if (page == before + text + page.substr(to)) return;
  if (std::getenv("PALPATE_WRITE_DOCS") != nullptr) {
    std::ofstream(kPage) << before << text << page.substr(to);
    return;
  }
  ADD_FAILURE() << kPage
                << " differs from what the trials show. Run this test with PALPATE_WRITE_DOCS=1, or put "
                << "this between the markers of " << name << ":\n"
                << text;
}

}  // namespace palpate::fault
