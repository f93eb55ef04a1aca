// Text to values, with one message for everything that can be wrong with them.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "scenario/parameter_table.hpp"
#include "text/split_at.hpp"

namespace palpate::sim {
namespace {

struct Source {
  const Parameter& parameter;
  const std::string& text;
  const std::string& place;

  [[noreturn]] void refuse() const {
    throw BadInput(
        fmt::format("{}{} is '{}', but must be {}", place, parameter.key, text, describe_range(parameter)));
  }
};

template <class Number>
Number read_number(const std::string& text, const Source& source) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const auto as_double = static_cast<double>(value);
  if (error != std::errc{} || stop != end || !std::isfinite(as_double)) source.refuse();
  if (!source.parameter.range.contains(as_double)) source.refuse();
  return value;
}

void assign(double& value, const Source& source) { value = read_number<double>(source.text, source); }
void assign(int& value, const Source& source) { value = read_number<int>(source.text, source); }

void assign(bool& value, const Source& source) {
  if (source.text != "on" && source.text != "off") source.refuse();
  value = source.text == "on";
}

void assign(std::string& value, const Source& source) {
  const auto& choices = source.parameter.choices;
  const bool known =
      choices.empty() || std::find(choices.begin(), choices.end(), source.text) != choices.end();
  if (!known || source.text.empty()) source.refuse();
  value = source.text;
}

template <class Number>
void assign(std::array<Number, 3>& value, const Source& source) {
  const std::vector<std::string> parts = split_at_commas(source.text);
  if (parts.size() != value.size()) source.refuse();
  for (std::size_t i = 0; i < value.size(); ++i) value[i] = read_number<Number>(parts[i], source);
}

void assign(std::vector<int>& value, const Source& source) {
  value.clear();
  for (const std::string& part : split_at_commas(source.text))
    value.push_back(read_number<int>(part, source));
}

}  // namespace

void set_parameter(Scenario& scenario, const Parameter& parameter, const std::string& text,
                   const std::string& place) {
  const Source source{parameter, text, place};
  std::visit(
      [&](auto access) {
        if constexpr (kIsOfRegion<decltype(access)>) {
          for (RegionParameters& region : scenario.model.regions) assign(region.*access, source);
        } else {
          assign(access(scenario), source);
        }
      },
      parameter.access);
  if (parameter.key == "node_mm") scenario.node_given = true;
}

}  // namespace palpate::sim
