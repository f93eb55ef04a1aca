// Ranges and defaults in words, for help and for messages.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "scenario/parameter_table.hpp"

namespace palpate::sim {

std::string describe_range(const Parameter& parameter) {
  if (!parameter.choices.empty()) return fmt::format("{}", fmt::join(parameter.choices, ", "));
  if (std::holds_alternative<Field<bool>>(parameter.access)) return "on, off";
  if (std::holds_alternative<Field<std::string>>(parameter.access)) return "a path";
  std::string range = fmt::format("{:g} .. {:g}{}{}", parameter.range.low, parameter.range.high,
                                  parameter.unit.empty() ? "" : " ", parameter.unit);
  if (std::holds_alternative<Field<std::array<double, 3>>>(parameter.access))
    return "three numbers, " + range;
  if (std::holds_alternative<Field<std::array<int, 3>>>(parameter.access))
    return "three whole numbers, " + range;
  if (std::holds_alternative<Field<std::vector<int>>>(parameter.access))
    return "a whole number a cube, " + range;
  const bool is_whole = std::holds_alternative<Field<int>>(parameter.access) ||
                        std::holds_alternative<int RegionParameters::*>(parameter.access);
  if (is_whole) return "a whole number, " + range;
  return range;
}

std::string describe_default(const Parameter& parameter) {
  if (!parameter.default_text.empty()) return parameter.default_text;
  const nlohmann::json value = parameter_value(parameter, Scenario{});
  if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_array()) {
    std::vector<std::string> items;
    for (const auto& item : value) items.push_back(item.dump());
    return items.empty() ? "all 0" : fmt::format("{}", fmt::join(items, ","));
  }
  return fmt::format("{:g}", value.get<double>());
}

}  // namespace palpate::sim
