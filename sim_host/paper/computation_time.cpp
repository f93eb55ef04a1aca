#include "paper/computation_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "palpate/tick/stage.hpp"

namespace palpate::sim {
namespace {

constexpr const char* kDoubleForces = "forces, double";

/// Stages that are shown together: what costs next to nothing has no colour of its own.
struct Group {
  const char* title;
  std::vector<CoreStage> stages;
};

const std::vector<Group>& groups() {
  static const std::vector<Group> all = {
      {"rotations", {CoreStage::kRotations}},
      {"re-mesh", {CoreStage::kRemesh}},
      {"forces", {CoreStage::kForces}},
      {"other stages", {CoreStage::kIntegrate, CoreStage::kTouch, CoreStage::kReaction}}};
  return all;
}

double group_ms(const TickTime& time, const Group& group) {
  double sum = 0.0;
  if (time.stage_ms.empty()) return sum;
  for (const CoreStage stage : group.stages) sum += time.stage_ms.at(static_cast<std::size_t>(stage));
  return sum;
}

/// The median time of an evaluation.
double forces_ms(const BarReference& bar, ElasticModel model) {
  constexpr std::size_t kTimes = 101;
  using Clock = std::chrono::steady_clock;
  const reference::StaticProblem problem = bar.problem(model);
  const std::vector<reference::Element> elements = reference::elements_of(problem.mesh);
  std::vector<double> ms;
  double sum = 0.0;  // so that nothing is left out
  for (std::size_t i = 0; i < kTimes; ++i) {
    const auto start = Clock::now();
    sum += reference::static_forces(elements, problem.materials, bar.full().x, model)[0][0];
    ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  const auto middle = ms.begin() + kTimes / 2;
  std::nth_element(ms.begin(), middle, ms.end());
  return sum == sum ? *middle : 0.0;
}

}  // namespace

std::vector<TickTime> collect_times(const Table1& table, const BarReference& bar, int substeps) {
  std::vector<TickTime> times;
  times.push_back({"L-FEM", std::nullopt, {}, substeps * forces_ms(bar, ElasticModel::kLinear)});
  for (const Table1Row& row : table.rows) {
    if (row.part != Table1Part::kTheta) continue;
    times.push_back({fmt::format("{:g}", row.run.theta_deg), row, row.run.stage_ms, 0.0});
  }
  times.push_back({"NL-FEM", std::nullopt, {}, substeps * forces_ms(bar, ElasticModel::kStVenantKirchhoff)});
  return times;
}

std::vector<double> shown_times_ms(const TickTime& time) {
  std::vector<double> shown;
  for (const Group& group : groups()) shown.push_back(group_ms(time, group));
  return shown;
}

StackedBars time_chart(const std::vector<TickTime>& times, const std::string& file) {
  StackedBars chart{file, "threshold θ, degrees", "time of a tick, ms", {}, {}};
  for (const Group& group : groups()) chart.parts.push_back({group.title, {}});
  chart.parts.push_back({kDoubleForces, {}});
  for (const TickTime& time : times) {
    chart.bars.push_back(time.name);
    const std::vector<double> shown = shown_times_ms(time);
    for (std::size_t i = 0; i < shown.size(); ++i) chart.parts[i].values.push_back(shown[i]);
    chart.parts.back().values.push_back(time.double_forces_ms);
  }
  return chart;
}

std::string time_csv(const std::vector<TickTime>& times) {
  std::string text = "model,theta_deg,rotation_tets";
  for (uint32_t i = 0; i < kCoreStages; ++i) {
    text += fmt::format(",{}_ms", stage_name(static_cast<CoreStage>(i)));
  }
  text += ",double_forces_ms\n";
  for (const TickTime& time : times) {
    text += time.row ? fmt::format("ours,{},{}", time.row->run.theta_deg, time.row->run.rotation_tets)
                     : fmt::format("{},,", time.name);
    for (uint32_t i = 0; i < kCoreStages; ++i) {
      text += time.row ? fmt::format(",{:.6f}", time.stage_ms.at(i)) : std::string(",");
    }
    text += time.row ? std::string(",\n") : fmt::format(",{:.6f}\n", time.double_forces_ms);
  }
  return text;
}

}  // namespace palpate::sim
