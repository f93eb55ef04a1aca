// The range that help prints is the range that holds: its ends are taken, by the model too, and what is just
// outside is refused with the range.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "program.hpp"
#include "scenario/parameter_table.hpp"

namespace palpate::sim {

/// For the tests' messages; found beside Parameter only.
std::ostream& operator<<(std::ostream& stream, const Parameter& parameter) { return stream << parameter.key; }

namespace {

using test::Outcome;
using test::TemporaryFolder;

bool has_range(const Parameter& parameter) { return parameter.range.low < parameter.range.high; }

bool is_whole(const Parameter& parameter) {
  return std::holds_alternative<Field<int>>(parameter.access) ||
         std::holds_alternative<Field<std::array<int, 3>>>(parameter.access) ||
         std::holds_alternative<Field<std::vector<int>>>(parameter.access);
}

/// A value as it is written; lists get it in each place but a map of cubes, which needs one cube that is
/// there.
std::string text_of(const Parameter& parameter, double value) {
  const std::string one = fmt::format("{:.17g}", value);
  const auto is = [&](auto field) { return std::holds_alternative<decltype(field)>(parameter.access); };
  if (is(Field<std::vector<int>>{})) return one + ",0,0";
  const bool is_triple = is(Field<std::array<double, 3>>{}) || is(Field<std::array<int, 3>>{});
  return is_triple ? fmt::format("{0},{0},{0}", one) : one;
}

ScenarioKind kind_of(const Parameter& parameter) {
  for (const ScenarioKind kind : {ScenarioKind::kGrasp, ScenarioKind::kTouch, ScenarioKind::kSine}) {
    if ((parameter.kinds & kind_bit(kind)) != 0) return kind;
  }
  return ScenarioKind::kBend;
}

/// A model with room for one parameter to go to its end.
Scenario easy_scenario(const Parameter& parameter) {
  Scenario scenario = built_in_scenario(kind_name(kind_of(parameter)));
  scenario.model.regions.assign(kRegions, RegionParameters{500.0, 0.3, 2000.0});
  scenario.model.level = 6;
  if (parameter.key == "least_level") scenario.model.level = kDeepestLevel;
  if (parameter.key == "most_level") scenario.model.level = 0;
  const bool needs_large_cubes = parameter.unit == "m" || parameter.key == "motion_scale";
  scenario.model.edge_m = needs_large_cubes ? domain::kEdgeM.high : 0.064;
  scenario.scene.body_centre_in_device_m = {0.0, 0.0, 0.0};
  return scenario;
}

/// Why the model is refused; empty when it is not.
std::string objection_to(const Scenario& scenario) {
  try {
    check_domain(scenario.model);
    check_domain(scenario.scene, scenario.model);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

/// With as many substeps as it takes.
std::string objection_at_any_step(const Parameter& parameter, Scenario scenario) {
  std::string objection = objection_to(scenario);
  for (int substeps = 1; parameter.key != "substeps" && substeps <= 8 && !objection.empty(); ++substeps) {
    scenario.model.substeps = substeps;
    objection = objection_to(scenario);
  }
  return objection;
}

class ParameterRange : public testing::TestWithParam<Parameter> {};

TEST_P(ParameterRange, EndsAreTaken) {
  const Parameter& parameter = GetParam();
  for (const double end : {parameter.range.low, parameter.range.high}) {
    Scenario scenario = easy_scenario(parameter);
    const std::string text = text_of(parameter, end);
    EXPECT_NO_THROW(set_parameter(scenario, parameter, text, "")) << text;
    EXPECT_EQ(objection_at_any_step(parameter, scenario), "") << text;
  }
}

TEST_P(ParameterRange, OutsideIsRefusedWithTheRange) {
  const Parameter& parameter = GetParam();
  const TemporaryFolder folder;
  const auto& [low, high] = parameter.range;
  const double below = is_whole(parameter) ? low - 1.0 : std::nextafter(low, -1e9);
  const double above = is_whole(parameter) ? high + 1.0 : std::nextafter(high, 1e9);
  const ScenarioKind kind = kind_of(parameter);
  std::string flag = parameter.key;
  std::replace(flag.begin(), flag.end(), '_', '-');
  for (const double outside : {below, above}) {
    const Outcome outcome =
        run_program(folder, fmt::format("{} {} --{}={}", has_device(kind) ? "hil" : "run", kind_name(kind),
                                        flag, text_of(parameter, outside)));
    EXPECT_EQ(outcome.exit_code, 2);
    test::expect_one_line(outcome.err);
    EXPECT_NE(outcome.err.find(describe_range(parameter)), std::string::npos) << outcome.err;
  }
}

std::vector<Parameter> ranged_parameters() {
  std::vector<Parameter> ranged;
  std::copy_if(parameter_table().begin(), parameter_table().end(), std::back_inserter(ranged), has_range);
  return ranged;
}

std::string name_of(const testing::TestParamInfo<Parameter>& info) { return info.param.key; }

INSTANTIATE_TEST_SUITE_P(Table, ParameterRange, testing::ValuesIn(ranged_parameters()), name_of);

}  // namespace
}  // namespace palpate::sim
