#include "hil/setting_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "recording/setting_table.hpp"
#include "scenario/errors.hpp"
#include "text/split_at.hpp"

namespace palpate::sim {
namespace {

std::string all_names() {
  std::vector<std::string> names;
  for (const recording::Setting& setting : recording::setting_table()) names.emplace_back(setting.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// One of the changes, as text.
struct Part {
  std::string text;

  [[noreturn]] void refuse(const std::string& what) const {
    throw BadInput(fmt::format("settings: in '{}' {}", text, what));
  }
};

template <class Number>
Number read_number(const Part& part, const std::string& text, const char* what) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) part.refuse(fmt::format("'{}' is no {}", text, what));
  return value;
}

/// The thresholds as they are before the first change, and then after each.
struct Thresholds {
  safety::Parameters parameters;
  RemeshRules rules;
};

firmware::SettingChange read_setting(const Part& part, const std::string& name, double value) {
  const std::vector<recording::Setting>& table = recording::setting_table();
  const auto found = std::find_if(table.begin(), table.end(), [&name](const recording::Setting& setting) {
    return name == setting.name;
  });
  if (found == table.end()) part.refuse(fmt::format("'{}' is no setting; they are {}", name, all_names()));
  if (!(value >= found->least && value <= found->most)) {
    part.refuse(fmt::format("the value must be {:g} .. {:g}", found->least, found->most));
  }
  if (found->lsb == 1.0 && value != std::floor(value)) part.refuse("the value must be a whole number");
  return recording::change_to(static_cast<uint16_t>(found - table.begin() + 1), value);
}

PlannedChange read_change(const Part& part, Thresholds& now) {
  const std::vector<std::string> halves = split_at(part.text, ':');
  if (halves.size() != 2) part.refuse("there must be a tick, a colon and NAME = VALUE");
  const std::vector<std::string> sides = split_at(halves[1], '=');
  if (sides.size() != 2) part.refuse("there must be NAME = VALUE behind the colon");
  const auto tick = read_number<uint32_t>(part, halves[0], "number of a tick");
  const firmware::SettingChange change =
      read_setting(part, sides[0], read_number<double>(part, sides[1], "number"));
  if (!firmware::change_setting(now.parameters, now.rules, change)) {
    part.refuse("the value contradicts the other settings: the firmware would refuse it");
  }
  return {tick, change};
}

}  // namespace

std::vector<PlannedChange> planned_changes(const Scenario& scenario) {
  std::vector<PlannedChange> changes;
  if (scenario.settings.empty()) return changes;
  Thresholds now{safety::kPremium15Parameters, cycle_model(scenario).body.remesh};
  for (const std::string& text : split_at(scenario.settings, ';')) {
    const Part part{text};
    changes.push_back(read_change(part, now));
    const uint32_t before = changes.size() > 1 ? changes[changes.size() - 2].tick : 0;
    if (changes.back().tick <= before) part.refuse(fmt::format("the tick must be above {}", before));
  }
  return changes;
}

}  // namespace palpate::sim
