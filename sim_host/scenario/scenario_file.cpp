#include "scenario/scenario_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "scenario/parameter_table.hpp"

namespace palpate::sim {
namespace {

const char* const kRegionKeys = "youngs_modulus_pa, poisson_ratio, density_kg_m3, least_level, most_level";

std::string place_of(const std::string& path, const toml::source_region& source) {
  return fmt::format("{}:{}:{}: ", path, source.begin.line, source.begin.column);
}

toml::table parse(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  if (!file || std::filesystem::is_directory(path)) {
    throw BadInput(fmt::format("cannot read '{}': {}", path, std::strerror(errno != 0 ? errno : EISDIR)));
  }
  try {
    return toml::parse(text.str());
  } catch (const toml::parse_error& error) {
    throw BadInput(place_of(path, error.source()) + std::string(error.description()));
  }
}

/// The text that set_parameter reads; tables and mixed arrays have none.
std::string text_of(const toml::node& node, const Parameter& parameter, const std::string& place) {
  if (const auto* whole = node.as_integer()) return fmt::format("{}", whole->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "on" : "off";
  if (const auto* text = node.as_string()) {
    if (std::holds_alternative<Field<std::string>>(parameter.access)) return text->get();
    throw BadInput(fmt::format("{}{} is text, but must be {} without quotes", place, parameter.key,
                               describe_range(parameter)));
  }
  if (const auto* array = node.as_array()) {
    std::vector<std::string> items;
    for (const toml::node& item : *array) items.push_back(text_of(item, parameter, place));
    return fmt::format("{}", fmt::join(items, ","));
  }
  throw BadInput(fmt::format("{}{} must be {}", place, parameter.key, describe_range(parameter)));
}

bool is_of_region(const Parameter& parameter) {
  return std::visit([](auto access) { return kIsOfRegion<decltype(access)>; }, parameter.access);
}

void read_region(const toml::table& table, const std::string& path, Scenario& scenario,
                 RegionParameters region) {
  Scenario reader = scenario;
  reader.model.regions = {region};
  for (const auto& [key, node] : table) {
    const std::string place = place_of(path, key.source());
    const Parameter* parameter = find_parameter(std::string(key.str()));
    if (parameter == nullptr || !is_of_region(*parameter)) {
      throw BadInput(
          fmt::format("{}a [[region]] has no key '{}'; its keys are {}", place, key.str(), kRegionKeys));
    }
    set_parameter(reader, *parameter, text_of(node, *parameter, place), place);
  }
  scenario.model.regions.push_back(reader.model.regions[0]);
}

void read_regions(const toml::node& node, const std::string& path, Scenario& scenario) {
  const toml::array* tables = node.as_array();
  if (tables == nullptr || !tables->is_homogeneous(toml::node_type::table)) {
    throw BadInput(place_of(path, node.source()) + "region must be [[region]] tables");
  }
  const RegionParameters base = scenario.model.regions[0];
  scenario.model.regions.clear();
  for (const toml::node& table : *tables) read_region(*table.as_table(), path, scenario, base);
}

/// The file's name as a word: it goes into paths and into C++.
std::string scenario_name(const std::string& path) {
  std::string name = std::filesystem::path(path).stem().string();
  for (char& character : name) {
    const bool is_word = std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '-';
    if (!is_word) character = '_';
  }
  return name;
}

Scenario start_from(const toml::table& table, const std::string& path) {
  const auto base = table["scenario"].value<std::string>();
  if (!base) {
    throw BadInput(fmt::format("{}: the key scenario is missing or no text; it must be one of {}", path,
                               fmt::join(scenario_names(), ", ")));
  }
  Scenario scenario = built_in_scenario(*base);
  scenario.name = scenario_name(path);
  return scenario;
}

}  // namespace

Scenario read_scenario_file(const std::string& path) {
  const toml::table table = parse(path);
  Scenario scenario = start_from(table, path);
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (name == "scenario" || name == "region") continue;
    const std::string place = place_of(path, key.source());
    const Parameter* parameter = find_parameter(name);
    if (parameter == nullptr || (parameter->kinds & kind_bit(scenario.kind)) == 0) {
      throw BadInput(fmt::format("{}{} has no key '{}'; its keys are {}, region", place,
                                 kind_name(scenario.kind), name, list_keys(kind_bit(scenario.kind))));
    }
    set_parameter(scenario, *parameter, text_of(node, *parameter, place), place);
  }
  if (const toml::node* regions = table.get("region")) read_regions(*regions, path, scenario);
  return scenario;
}

}  // namespace palpate::sim
