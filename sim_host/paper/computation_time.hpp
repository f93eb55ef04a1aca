// Figure 6b: what a tick costs on this machine, by stage, over theta; beside it what the paper's other two
// models cost.
#pragma once

#include "output/chart.hpp"
#include "paper/table1.hpp"

namespace palpate::sim {

struct TickTime {
  std::string name;
  std::optional<Table1Row> row;  // of the core; none for L-FEM and NL-FEM
  std::vector<double> stage_ms;  // of the core, empty without
  double double_forces_ms;       // of the reference, zero with a row
};

/// The rows at the paper's thetas. For L-FEM and NL-FEM the time of as many force evaluations as a tick has
/// substeps, in double precision, with the reference's plain code.
std::vector<TickTime> collect_times(const Table1& table, const BarReference& bar, int substeps);

/// Of the core's bars, the parts of the chart from below: rotations, re-mesh, forces, other stages.
std::vector<double> shown_times_ms(const TickTime& time);

StackedBars time_chart(const std::vector<TickTime>& times, const std::string& file);
std::string time_csv(const std::vector<TickTime>& times);

}  // namespace palpate::sim
