#include "paper/error_curves.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "output/interrupt.hpp"
#include "reference/front_search.hpp"
#include "reference/rotation_criterion.hpp"
#include "scenario/errors.hpp"

namespace palpate::sim {
namespace {

using published::Table1Column;

/// The paper's counts and some between them.
constexpr std::array<uint32_t, 12> kSearchedCounts = {18,  32,  48,  100, 150, 200,
                                                      300, 400, 578, 696, 908, 1072};
constexpr int kRounds = 30;

ErrorCurve online_curve(const BarReference& bar, const BarRuns& runs, const char* criterion,
                        const char* title) {
  ErrorCurve curve{criterion, title, {}};
  for (const RestRun& run : runs.all()) {
    if (run.rotations != criterion || run.failure) continue;
    const Distance error = bar.distance(bar.positions_of(run.fields), bar.full().x);
    curve.points.push_back({run.rotation_tets, run.theta_deg, error.mean_mm, error.max_mm});
  }
  std::sort(curve.points.begin(), curve.points.end(), [](const CurvePoint& a, const CurvePoint& b) {
    return std::pair(a.rotation_tets, *b.theta_deg) < std::pair(b.rotation_tets, *a.theta_deg);
  });
  return curve;
}

}  // namespace

ErrorCurve search_best_tets(const BarReference& bar, StatusLine& status) {
  status.begin("search for the best rotation tets");
  reference::AdaptiveCorotation body(bar.tree(), bar.problem(ElasticModel::kCorotation),
                                     reference::RotationSource::kMeanGradient);
  const std::vector<reference::FrontPoint> taken = reference::refine_worst_first(
      body, reference::Criterion::kRemainingRotation, reference::Closure::kNone, kSearchedCounts.back());
  ErrorCurve curve{"searched", "searched", {}};
  for (const uint32_t count : kSearchedCounts) {
    if (is_interrupted()) throw Interrupted();
    status.show(fmt::format("{} tets", count));
    reference::Front front = reference::point_at(taken, count).front;
    reference::grow(body, front, count);
    reference::polish(body, front, kRounds);
    if (!body.settle(front)) continue;
    curve.points.push_back({front.count(), std::nullopt, body.error().mean_mm, body.error().max_mm});
  }
  return curve;
}

std::vector<ErrorCurve> collect_curves(const Table1& table, const BarReference& bar, const BarRuns& runs,
                                       const ErrorCurve& searched) {
  std::vector<ErrorCurve> curves = {online_curve(bar, runs, "misfit", "ours"),
                                    online_curve(bar, runs, "siblings", "paper's criterion")};
  if (table.options.is_the_papers()) {
    ErrorCurve paper{"paper", "paper", {}};
    for (const Table1Column& column : published::kTable1) {
      paper.points.push_back(
          {column.rotation_tets, column.theta_deg, column.errors.average_mm, column.errors.maximum_mm});
    }
    curves.push_back(paper);
  }
  if (!searched.points.empty()) curves.push_back(searched);
  return curves;
}

}  // namespace palpate::sim
