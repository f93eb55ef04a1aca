// docs/safety.md shows the tables and the state machine of the code. PALPATE_WRITE_DOCS=1 in the environment
// puts what the code prints into the page.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "every.hpp"

namespace palpate::safety {
namespace {

using test::every_condition;
using test::every_event;
using test::every_state;
using test::number;

constexpr const char* kPage = PALPATE_SOURCE_FOLDER "/docs/safety.md";

std::string read_page() {
  std::ifstream file(kPage);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string marker(const std::string& name, const char* which) {
  return "<!-- " + name + ": " + which + " -->\n";
}

/// What stands between the page's two markers of this name.
std::string section(const std::string& page, const std::string& name) {
  const std::size_t begin = page.find(marker(name, "begin"));
  const std::size_t end = page.find(marker(name, "end"));
  if (begin == std::string::npos || end == std::string::npos) return "no such markers";
  const std::size_t text = begin + marker(name, "begin").size();
  return page.substr(text, end - text);
}

void expect_in_page(const std::string& name, const std::string& text) {
  const std::string page = read_page();
  if (section(page, name) == text) return;
  const std::size_t begin = page.find(marker(name, "begin"));
  const std::size_t end = page.find(marker(name, "end"));
  if (std::getenv("PALPATE_WRITE_DOCS") != nullptr && begin != std::string::npos &&
      end != std::string::npos) {
    std::ofstream(kPage) << page.substr(0, begin) << marker(name, "begin") << text << page.substr(end);
    return;
  }
  ADD_FAILURE() << kPage
                << " differs from the code. Run this test with PALPATE_WRITE_DOCS=1, or put this between "
                << marker(name, "begin") << " and " << marker(name, "end") << text;
}

std::string condition_rows() {
  std::ostringstream out;
  out << "| condition | cause | detected in | reaction | clears |\n|---|---|---|---|---|\n";
  for (const Condition condition : every_condition()) {
    const Answer what = answer(condition);
    out << "| " << condition_name(condition) << " | " << condition_cause(condition) << " | "
        << what.detected_in_ticks << (what.detected_in_ticks == 1 ? " tick" : " ticks") << " | "
        << reaction_name(what.reaction) << " | " << condition_clears(condition) << " |\n";
  }
  return out.str();
}

std::string threshold_rows() {
  const Parameters p;
  struct Threshold {
    const char* name;
    double value;
    const char* unit;
  };
  const std::vector<Threshold> all = {
      {"force.max_newtons", number(p.force.max_newtons), "N"},
      {"force.impulse_newtons_per_tick", number(p.force.impulse_newtons_per_tick), "N in a tick"},
      {"force.impulse_newtons_per_window", number(p.force.impulse_newtons_per_window), "N in 8 ticks"},
      {"motion.max_metres_per_tick", number(p.motion.max_metres_per_tick), "m: 2 m/s"},
      {"motion.max_counts_per_tick", static_cast<double>(p.motion.max_counts_per_tick), "counts"},
      {"motion.moving_amperes", number(p.motion.moving_amperes), "A"},
      {"motion.stuck_ticks", static_cast<double>(p.motion.stuck_ticks), "ticks"},
      {"timing.silent_ticks", static_cast<double>(p.timing.silent_ticks), "ticks"},
      {"timing.overrun_ticks", static_cast<double>(p.timing.overrun_ticks), "ticks"},
      {"thermal.ambient", number(p.thermal.ambient), "degC"},
      {"thermal.release", number(p.thermal.release), "degC"},
      {"thermal.warm", number(p.thermal.warm), "degC"},
      {"thermal.winding_limit", number(p.thermal.winding_limit), "degC"},
      {"thermal.peak_amperes", number(p.thermal.peak_amperes), "A"},
      {"thermal.continuous_amperes", number(p.thermal.continuous_amperes), "A"},
      {"thermal.decay_per_tick", number(p.thermal.decay_per_tick), ""},
      {"thermal.rise_amperes_per_tick", number(p.thermal.rise_amperes_per_tick), "A"},
      {"ramp.step_per_tick", number(p.ramp.step_per_tick), "of the force, a ramp of 2.0 s"},
      {"ramp.contact_newtons", number(p.ramp.contact_newtons), "N"},
      {"ramp.free_ticks", static_cast<double>(p.ramp.free_ticks), "ticks"}};
  std::ostringstream out;
  out.precision(4);
  out << "| threshold | default | unit |\n|---|---|---|\n";
  for (const Threshold& one : all)
    out << "| " << one.name << " | " << one.value << " | " << one.unit << " |\n";
  return out.str();
}

using NamedArrow = std::tuple<std::string, std::string, std::string>;  // from, event, to

std::set<NamedArrow> arrows_of_table() {
  std::set<NamedArrow> arrows;
  for (const State state : every_state()) {
    for (const Event event : every_event()) {
      const Step taken = step(state, event);
      if (taken.is_arrow) arrows.insert({state_name(state), event_name(event), state_name(taken.to)});
    }
  }
  return arrows;
}

/// "any fault" and "any drop" stand for all conditions with that reaction.
std::vector<std::string> events_of_label(const std::string& label) {
  std::vector<std::string> events;
  for (const Condition condition : every_condition()) {
    if (label == std::string("any ") + reaction_name(answer(condition).reaction)) {
      events.emplace_back(condition_name(condition));
    }
  }
  if (events.empty()) events.push_back(label);
  return events;
}

/// Of lines "  From --> To : label"; [*] is where it starts.
std::set<NamedArrow> arrows_of_drawing(const std::string& page) {
  std::set<NamedArrow> arrows;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string from, arrow, to, colon, label;
    if (!(words >> from >> arrow >> to) || arrow != "-->" || from == "[*]") continue;
    words >> colon >> std::ws;
    std::getline(words, label);
    for (const std::string& event : events_of_label(label)) {
      EXPECT_TRUE(arrows.insert({from, event, to}).second) << "drawn twice: " << line;
    }
  }
  return arrows;
}

std::string text_of(const std::set<NamedArrow>& arrows, const std::set<NamedArrow>& without) {
  std::string text;
  for (const auto& [from, event, to] : arrows) {
    if (without.count({from, event, to}) != 0) continue;
    text.append("  ").append(from).append(" --> ").append(to).append(" : ").append(event).append("\n");
  }
  return text;
}

TEST(SafetyPage, ShowsTheConditionsOfTheCode) { expect_in_page("conditions", condition_rows()); }

TEST(SafetyPage, ShowsTheThresholdsOfTheCode) { expect_in_page("thresholds", threshold_rows()); }

TEST(SafetyPage, DrawsTheArrowsOfTheTable) {
  const std::set<NamedArrow> drawn = arrows_of_drawing(read_page());
  const std::set<NamedArrow> coded = arrows_of_table();
  EXPECT_EQ(text_of(coded, drawn), "") << "add these to the drawing in " << kPage;
  EXPECT_EQ(text_of(drawn, coded), "") << "remove these from the drawing in " << kPage;
  EXPECT_EQ(drawn, coded);
}

TEST(SafetyPage, StartsInBoot) { EXPECT_NE(read_page().find("  [*] --> Boot\n"), std::string::npos); }

}  // namespace
}  // namespace palpate::safety
