// The paper's Table 1, "errors of displacement", computed in the fixed-point core: a bar is bent or twisted,
// comes to rest, and its free nodes are compared with full corotation in double precision.
//
// Our criterion's theta is absolute in volume, the paper's is not, so equal thetas give other counts. Rows
// are therefore computed at the paper's thetas and again at the paper's counts, and with the paper's own
// criterion.
#pragma once

#include "paper/bar_reference.hpp"
#include "paper/bar_runs.hpp"
#include "paper/published.hpp"

namespace palpate::sim {

struct Table1Options {
  double bend_deg = published::kBendDeg;
  double twist_deg = 0.0;
  bool is_quick = false;  // two rows

  /// Only this pose has figures in the paper.
  [[nodiscard]] bool is_the_papers() const { return bend_deg == published::kBendDeg && twist_deg == 0.0; }
};

enum class Table1Part { kTheta, kCount, kSiblings, kFull };
const char* name_of(Table1Part part);

struct Table1Row {
  Table1Part part;
  const published::Table1Column* column;  // whose theta or count it has; none for kFull
  RestRun run;
  Distance error;                      // from full corotation
  std::optional<Distance> stvk_error;  // from NL-FEM, if that converged
};

/// A model of the reference, beside the rows.
struct Table1Model {
  Distance error;
  std::optional<Distance> stvk_error;
  double volume_change;
};

struct Table1 {
  Table1Options options;
  std::vector<Table1Row> rows;
  Table1Model linear, full;
  std::optional<double> stvk_volume_change;
  std::size_t free_nodes;
  std::size_t runs,
      unsettled_runs;  // those that did not come to rest are only in a row if it asks for their theta
};

/// Makes the runs that it needs.
Table1 compute_table1(const Table1Options& options, const BarReference& bar, BarRuns& runs,
                      StatusLine& status);

/// Required: at the paper's count the average is not above the paper's. Goal: from 578 tets up a quarter of
/// it.
enum class Verdict { kNone, kHolds, kFails };
Verdict requirement(const Table1& table, const Table1Row& row);
Verdict goal(const Table1& table, const Table1Row& row);

/// What keeps the table from holding, a reason a line: requirements that fail and runs that are not at rest.
std::vector<std::string> find_objections(const Table1& table);

}  // namespace palpate::sim
