#include "paper/table1_study.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace palpate::sim {
namespace {

/// Counts of the paper whose rotation tets are shown.
constexpr std::array<uint32_t, 2> kShownCounts = {48, 300};

std::string percent(double part) { return fmt::format("{:+.1f} %", 100.0 * part); }

void add_body(Table1Study& study, const std::string& file, const BodyShape& shape, bool shows_rotation_tets,
              const std::string& caption) {
  study.bodies.push_back(WireframePicture{file, shape, shows_rotation_tets});
  study.body_captions.push_back(caption);
}

double volume_change(const BarReference& bar, const RestRun& run) {
  return reference::volume_change(bar.tree().mesh, bar.positions_of(run.fields));
}

/// The run's surface with its nodes where a model of the reference has them.
BodyShape placed(BodyShape shape, const BarReference& bar, const BarReference::Equilibrium& model) {
  shape.now_mm = bar.place(shape.rest_mm, model);
  return shape;
}

void add_bodies(Table1Study& study, const BarReference& bar) {
  for (const Table1Row& row : study.table.rows) {
    const bool is_shown = row.part == Table1Part::kCount &&
                          std::count(kShownCounts.begin(), kShownCounts.end(), row.column->rotation_tets) > 0;
    if (!is_shown) continue;
    add_body(study, fmt::format("fig6a_{}", row.column->rotation_tets), row.run.shape, true,
             fmt::format(
                 "Ours in fixed point, {} rotation tets in bold red of 1152: volume {}, {:.3f} mm from full "
                 "corotation on average.",
                 row.run.rotation_tets, percent(volume_change(bar, row.run)), row.error.mean_mm));
  }
  const BodyShape& shape = study.table.rows.back().run.shape;
  add_body(study, "fig6a_linear", placed(shape, bar, bar.linear()), false,
           fmt::format("L-FEM: volume {}.", percent(bar.linear().volume_change)));
  if (!bar.nonlinear().converged) return;
  add_body(study, "fig6a_nonlinear", placed(shape, bar, bar.nonlinear()), false,
           fmt::format("NL-FEM, St. Venant-Kirchhoff: volume {}. Full corotation: {}.",
                       percent(bar.nonlinear().volume_change), percent(bar.full().volume_change)));
}

}  // namespace

Table1Study study_table1(const Table1Options& options) {
  StatusLine status;
  const Scenario scenario = bar_scenario(options.bend_deg, options.twist_deg);
  status.begin("equilibria in double precision");
  status.show("full corotation, L-FEM, NL-FEM");
  const BarReference bar(scenario);
  BarRuns runs(scenario, status);
  Table1Study study;
  study.table = compute_table1(options, bar, runs, status);
  study.substeps = scenario.model.substeps;
  const ErrorCurve searched = options.is_quick ? ErrorCurve{} : search_best_tets(bar, status);
  study.curves = collect_curves(study.table, bar, runs, searched);
  study.times = collect_times(study.table, bar, study.substeps);
  add_bodies(study, bar);
  return study;
}

}  // namespace palpate::sim
