// Every parameter of a scenario, once: its TOML key, which with dashes is its command-line flag, its unit,
// range, default and meaning. Help, the TOML reader, the command line and summary.json are made from this
// table.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <variant>

#include "domain.hpp"
#include "scenario/scenario.hpp"

namespace palpate::sim {

template <class T>
using Field = T& (*)(Scenario&);

/// Where a parameter lives; its alternative is the parameter's type. A member of RegionParameters is set in
/// all regions.
using Access = std::variant<Field<double>, Field<int>, Field<bool>, Field<std::string>,
                            Field<std::array<double, 3>>, Field<std::array<int, 3>>, Field<std::vector<int>>,
                            double RegionParameters::*, int RegionParameters::*>;

template <class Where>
inline constexpr bool kIsOfRegion =
    std::is_same_v<Where, double RegionParameters::*> || std::is_same_v<Where, int RegionParameters::*>;

/// Scenarios that have a parameter, one bit a kind.
constexpr unsigned kind_bit(ScenarioKind kind) { return 1u << static_cast<unsigned>(kind); }
inline constexpr unsigned kToolKinds = kind_bit(ScenarioKind::kSine) | kind_bit(ScenarioKind::kBend);
inline constexpr unsigned kDeviceKinds = kind_bit(ScenarioKind::kGrasp) | kind_bit(ScenarioKind::kTouch);
inline constexpr unsigned kAllKinds = kToolKinds | kDeviceKinds;

struct Parameter {
  std::string key;
  std::string alias;  // a second, shorter key; may be empty
  std::string unit;
  std::string meaning;
  Range range;  // of numbers
  std::vector<std::string> choices;
  std::string default_text;  // empty: the built-in scenarios' value
  unsigned kinds;
  bool is_output;  // says what to record, not what to simulate
  Access access;
};

const std::vector<Parameter>& parameter_table();

/// The parameter with this key or alias, or nullptr.
const Parameter* find_parameter(const std::string& key);
/// All keys of a kind, separated by commas.
std::string list_keys(unsigned kinds);

/// Sets a parameter from text: a number, on|off, or numbers separated by commas. `place` begins the message
/// of the BadInput that a wrong value throws: "bar.toml:3:1: " or "--".
void set_parameter(Scenario& scenario, const Parameter& parameter, const std::string& text,
                   const std::string& place);

nlohmann::json parameter_value(const Parameter& parameter, const Scenario& scenario);

/// "1 .. 8", "one, both, none" and so on.
std::string describe_range(const Parameter& parameter);
std::string describe_default(const Parameter& parameter);

}  // namespace palpate::sim
