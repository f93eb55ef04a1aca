// Table 1 as CSV and as text.
#include <fmt/format.h>

#include "paper/table1_output.hpp"

namespace palpate::sim {
namespace {

std::string columns(const Distance& error) {
  return fmt::format("{:.6f},{:.6f},{:.6f}", error.mean_mm, error.max_mm, error.min_mm);
}
std::string columns(const std::optional<Distance>& error) { return error ? columns(*error) : ",,"; }

std::string paper_columns(uint32_t tets, const published::Errors& errors) {
  return fmt::format("{},{},{},{}", tets, errors.average_mm, errors.maximum_mm, errors.minimum_mm);
}

std::string paper_columns(const Table1& table, const Table1Row& row) {
  if (row.column == nullptr || !table.options.is_the_papers()) return ",,,";
  return paper_columns(row.column->rotation_tets, row.column->errors);
}

std::string model_line(const char* name, const Table1Model& model, const std::string& paper) {
  return fmt::format("{},,,{},{},{},,ok\n", name, columns(model.error), columns(model.stvk_error), paper);
}

const char* heading(Table1Part part) {
  switch (part) {
    case Table1Part::kTheta:
      return "at the paper's thetas";
    case Table1Part::kCount:
      return "at most the paper's rotation tets";
    case Table1Part::kSiblings:
      return "the paper's criterion, at its thetas";
    default:
      return "full corotation in fixed point";
  }
}

std::string text_of(const Distance& error) {
  return fmt::format("{:9.5f} {:9.5f} {:9.5f}", error.mean_mm, error.max_mm, error.min_mm);
}

std::string paper_text(uint32_t tets, const published::Errors& errors) {
  return fmt::format(" | {:5} {:8.3f} {:8.3f} {:8.4f}", tets, errors.average_mm, errors.maximum_mm,
                     errors.minimum_mm);
}

std::string verdict_text(const Table1& table, const Table1Row& row) {
  if (row.run.failure) return "  FAILED: not at rest";
  std::string text;
  if (requirement(table, row) == Verdict::kFails) text += "  FAILED: above the paper's average";
  if (requirement(table, row) == Verdict::kHolds) text += "  holds";
  if (goal(table, row) == Verdict::kHolds) text += ", goal met";
  if (goal(table, row) == Verdict::kFails) text += ", goal missed";
  return text;
}

std::string line_of(const Table1& table, const Table1Row& row) {
  std::string text =
      fmt::format("{:9.4g} {:6} {}", row.run.theta_deg, row.run.rotation_tets, text_of(row.error));
  if (row.column != nullptr && table.options.is_the_papers()) {
    text += paper_text(row.column->rotation_tets, row.column->errors);
  }
  return text + verdict_text(table, row) + "\n";
}

}  // namespace

std::string describe_pose(const Table1Options& options) {
  if (options.twist_deg == 0.0) return fmt::format("bent by {:g} degrees", options.bend_deg);
  return fmt::format("twisted by {:g} degrees", options.twist_deg);
}

std::string table1_csv(const Table1& table) {
  std::string text =
      "part,theta_deg,rotation_tets,average_mm,maximum_mm,minimum_mm,stvk_average_mm,stvk_maximum_mm,"
      "stvk_minimum_mm,paper_tets,paper_average_mm,paper_maximum_mm,paper_minimum_mm,ticks,result\n";
  const bool has_paper = table.options.is_the_papers();
  text += model_line("l-fem", table.linear,
                     has_paper ? paper_columns(published::kLinearTets, published::kLinear) : ",,,");
  text += model_line("corotation", table.full, ",,,");
  for (const Table1Row& row : table.rows) {
    text += fmt::format("{},{},{},{},{},{},{},{}\n", name_of(row.part), row.run.theta_deg,
                        row.run.rotation_tets, columns(row.error), columns(row.stvk_error),
                        paper_columns(table, row), row.run.ticks, row.run.failure ? "failed" : "ok");
  }
  return text;
}

std::string curves_csv(const std::vector<ErrorCurve>& curves) {
  std::string text = "curve,rotation_tets,theta_deg,average_mm,maximum_mm\n";
  for (const ErrorCurve& curve : curves) {
    for (const CurvePoint& point : curve.points) {
      text += fmt::format("{},{},{},{:.6f},{:.6f}\n", curve.name, point.rotation_tets,
                          point.theta_deg ? fmt::format("{}", *point.theta_deg) : "", point.average_mm,
                          point.maximum_mm);
    }
  }
  return text;
}

std::string table1_text(const Table1& table) {
  std::string text = fmt::format(
      "Errors of displacement, mm, of the bar {}, over {} free nodes, from full corotation in double "
      "precision\n",
      describe_pose(table.options), table.free_nodes);
  text += fmt::format("{:>9} {:>6} {:>9} {:>9} {:>9}", "theta_deg", "tets", "average", "maximum", "minimum");
  if (table.options.is_the_papers())
    text += fmt::format(" | paper {:>8} {:>8} {:>8}", "average", "maximum", "minimum");
  text += "\nL-FEM\n" + fmt::format("{:16} {}", "", text_of(table.linear.error));
  if (table.options.is_the_papers()) text += paper_text(published::kLinearTets, published::kLinear);
  text += "\n";
  if (table.linear.stvk_error) {
    text += fmt::format("{:16} {} from NL-FEM\n", "", text_of(*table.linear.stvk_error));
  }
  const Table1Row* before = nullptr;
  for (const Table1Row& row : table.rows) {
    if (before == nullptr || before->part != row.part) text += fmt::format("{}\n", heading(row.part));
    text += line_of(table, row);
    before = &row;
  }
  return text + fmt::format("{} runs, of which {} did not come to rest\n", table.runs, table.unsettled_runs);
}

}  // namespace palpate::sim
