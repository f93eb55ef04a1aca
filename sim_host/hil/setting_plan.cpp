#include "hil/setting_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>

#include "palpate/firmware/settings.hpp"
#include "scenario/errors.hpp"
#include "text/split_at.hpp"

namespace palpate::sim {
namespace {

std::string all_names() {
  std::vector<std::string> names;
  for (uint16_t i = 1; i <= firmware::kSettings; ++i) names.emplace_back(firmware::setting_name(i));
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Among the fields that are given, the one with a name: its number, and the raw value of what it is to be.
/// Takes the calls of a FieldReader.
class NamedSetting {
 public:
  NamedSetting(std::string name, double value) : name_(std::move(name)), value_(value) {}

  template <class Integer>
  void number(const char* name, Integer&,
              std::common_type_t<Integer> least = std::numeric_limits<Integer>::min(),
              std::common_type_t<Integer> most = std::numeric_limits<Integer>::max()) {
    note(name, 1.0, static_cast<double>(least), static_cast<double>(most));
  }
  template <int I, int F>
  void fixed(const char* name, Q<I, F>&, Q<I, F> least = Q<I, F>::min(), Q<I, F> most = Q<I, F>::max()) {
    note(name, std::ldexp(1.0, F), std::ldexp(least.raw(), -F), std::ldexp(most.raw(), -F));
  }
  /// Its number is 0 when no field has the name.
  [[nodiscard]] firmware::SettingChange change() const { return change_; }
  /// What the value must be, and is not; empty: it is.
  [[nodiscard]] const std::string& objection() const { return objection_; }

 private:
  void note(const char* name, double per_unit, double least, double most) {
    ++at_;
    if (name != name_) return;
    const double raw = value_ * per_unit;
    if (!(value_ >= least && value_ <= most)) objection_ = fmt::format("{:g} .. {:g}", least, most);
    if (per_unit == 1.0 && raw != std::floor(raw)) objection_ = "a whole number";
    // 32 bits without a sign travel in the same 32 bits.
    const auto bits = objection_.empty() ? static_cast<uint32_t>(std::llround(raw)) : 0u;
    change_ = {at_, static_cast<int32_t>(bits)};
  }

  std::string name_;
  double value_;
  uint16_t at_ = 0;
  firmware::SettingChange change_{0, 0};
  std::string objection_;
};

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

PlannedChange read_change(const Part& part, Thresholds& now) {
  const std::vector<std::string> halves = split_at(part.text, ':');
  if (halves.size() != 2) part.refuse("there must be a tick, a colon and NAME = VALUE");
  const std::vector<std::string> sides = split_at(halves[1], '=');
  if (sides.size() != 2) part.refuse("there must be NAME = VALUE behind the colon");
  const auto tick = read_number<uint32_t>(part, halves[0], "number of a tick");
  NamedSetting setting(sides[0], read_number<double>(part, sides[1], "number"));
  firmware::all_settings(setting, now.parameters, now.rules);
  if (setting.change().setting == 0) {
    part.refuse(fmt::format("'{}' is no setting; they are {}", sides[0], all_names()));
  }
  if (!setting.objection().empty()) part.refuse(fmt::format("the value must be {}", setting.objection()));
  if (!firmware::change_setting(now.parameters, now.rules, setting.change())) {
    part.refuse("the value contradicts the other settings: the firmware would refuse it");
  }
  return {tick, setting.change()};
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
