// The error over the number of rotation tets: ours, the paper's, and what a search for the best tets finds.
#pragma once

#include "paper/table1.hpp"

namespace palpate::sim {

struct CurvePoint {
  uint32_t rotation_tets;
  std::optional<double> theta_deg;
  double average_mm, maximum_mm;
};

struct ErrorCurve {
  std::string name;   // in the CSV file
  std::string title;  // in the chart
  std::vector<CurvePoint> points;
};

/// In double precision, at rest: from the tets that our criterion takes, exchanges of tets that lower the
/// error are made as long as there are any. Near the best, no more than that: nothing proves that there are
/// no better tets.
ErrorCurve search_best_tets(const BarReference& bar, StatusLine& status);

/// Every run that came to rest, the paper's points if they are of this pose, and `searched` unless it is
/// empty.
std::vector<ErrorCurve> collect_curves(const Table1& table, const BarReference& bar, const BarRuns& runs,
                                       const ErrorCurve& searched);

}  // namespace palpate::sim
