#include "paper/table1.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace palpate::sim {
namespace {

using published::kTable1;
using published::Table1Column;

constexpr uint32_t kGoalFromTets = 578;
constexpr double kGoal = 0.25;  // of the paper's average

class Builder {
 public:
  Builder(const Table1Options& options, const BarReference& bar, BarRuns& runs, StatusLine& status)
      : bar_(bar), runs_(runs), status_(status) {
    table_.options = options;
    table_.free_nodes = bar.free_nodes();
    table_.linear = compare(bar.linear());
    table_.full = compare(bar.full());
    if (bar.nonlinear().converged) table_.stvk_volume_change = bar.nonlinear().volume_change;
  }

  void add_at_theta(Table1Part part, const Table1Column& column) {
    const char* criterion = part == Table1Part::kSiblings ? "siblings" : "misfit";
    begin(fmt::format("the paper's theta {:g} deg, criterion: {}", column.theta_deg, criterion));
    add(part, &column, runs_.run(criterion, column.theta_deg));
  }
  void add_at_count(const Table1Column& column) {
    begin(fmt::format("up to the paper's {} rotation tets", column.rotation_tets));
    add(Table1Part::kCount, &column, runs_.most_tets_up_to(column.rotation_tets));
  }
  void add_full() {
    begin("full corotation");
    add(Table1Part::kFull, nullptr, runs_.run("full", Scenario{}.model.remesh.rotation_split_deg));
  }
  Table1 finish() {
    const auto is_unsettled = [](const RestRun& run) { return run.failure.has_value(); };
    table_.runs = runs_.all().size();
    table_.unsettled_runs =
        static_cast<std::size_t>(std::count_if(runs_.all().begin(), runs_.all().end(), is_unsettled));
    return std::move(table_);
  }

 private:
  void begin(const std::string& task) {
    const std::size_t rows = table_.options.is_quick ? 2 : 3 * kTable1.size() + 1;
    status_.begin(
        fmt::format("row {} of {}, {} (run {})", table_.rows.size() + 1, rows, task, runs_.all().size() + 1));
  }
  [[nodiscard]] Table1Model compare(const BarReference::Equilibrium& model) const {
    return Table1Model{bar_.distance(model.x, bar_.full().x), bar_.distance(model.x, bar_.nonlinear()),
                       model.volume_change};
  }
  void add(Table1Part part, const Table1Column* column, const RestRun& run) {
    const reference::Positions x = bar_.positions_of(run.fields);
    table_.rows.push_back(
        Table1Row{part, column, run, bar_.distance(x, bar_.full().x), bar_.distance(x, bar_.nonlinear())});
  }

  const BarReference& bar_;
  BarRuns& runs_;
  StatusLine& status_;
  Table1 table_{};
};

std::string text_of(const Table1Row& row) {
  return fmt::format("part {}, theta {:.4g} deg, {} rotation tets", name_of(row.part), row.run.theta_deg,
                     row.run.rotation_tets);
}

bool has_paper_value(const Table1& table, const Table1Row& row) {
  return table.options.is_the_papers() && row.part == Table1Part::kCount;
}

}  // namespace

const char* name_of(Table1Part part) {
  switch (part) {
    case Table1Part::kTheta:
      return "theta";
    case Table1Part::kCount:
      return "count";
    case Table1Part::kSiblings:
      return "siblings";
    default:
      return "full";
  }
}

Table1 compute_table1(const Table1Options& options, const BarReference& bar, BarRuns& runs,
                      StatusLine& status) {
  Builder builder(options, bar, runs, status);
  if (options.is_quick) {
    builder.add_at_theta(Table1Part::kTheta, kTable1[1]);
    builder.add_at_count(kTable1[1]);
    return builder.finish();
  }
  for (const Table1Column& column : kTable1) builder.add_at_theta(Table1Part::kTheta, column);
  for (const Table1Column& column : kTable1) builder.add_at_count(column);
  for (const Table1Column& column : kTable1) builder.add_at_theta(Table1Part::kSiblings, column);
  builder.add_full();
  return builder.finish();
}

Verdict requirement(const Table1& table, const Table1Row& row) {
  if (!has_paper_value(table, row)) return Verdict::kNone;
  return row.error.mean_mm <= row.column->errors.average_mm ? Verdict::kHolds : Verdict::kFails;
}

Verdict goal(const Table1& table, const Table1Row& row) {
  if (!has_paper_value(table, row) || row.column->rotation_tets < kGoalFromTets) return Verdict::kNone;
  return row.error.mean_mm <= kGoal * row.column->errors.average_mm ? Verdict::kHolds : Verdict::kFails;
}

std::vector<std::string> find_objections(const Table1& table) {
  std::vector<std::string> objections;
  for (const Table1Row& row : table.rows) {
    if (row.run.failure) objections.push_back(fmt::format("{}: {}", text_of(row), *row.run.failure));
    if (requirement(table, row) != Verdict::kFails) continue;
    objections.push_back(fmt::format("{}: the average error is {:.4f} mm, the paper's {:g} mm", text_of(row),
                                     row.error.mean_mm, row.column->errors.average_mm));
  }
  return objections;
}

}  // namespace palpate::sim
