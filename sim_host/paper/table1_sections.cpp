// Table 1 and Figure 6 as sections of a report.
#include <fmt/format.h>

#include "output/gnuplot.hpp"
#include "output/output_file.hpp"
#include "paper/table1_output.hpp"

namespace palpate::sim {
namespace {

Cell number(double value, Mark mark = Mark::kPlain) { return Cell{fmt::format("{:.4f}", value), mark}; }
Cell count(uint32_t value, Mark mark = Mark::kPlain) { return Cell{fmt::format("{}", value), mark}; }

Mark mark_of(const Table1& table, const Table1Row& row) {
  if (row.run.failure || requirement(table, row) == Verdict::kFails) return Mark::kFails;
  switch (goal(table, row)) {
    case Verdict::kHolds:
      return Mark::kGoalMet;
    case Verdict::kFails:
      return Mark::kGoalMissed;
    default:
      return requirement(table, row) == Verdict::kHolds ? Mark::kHolds : Mark::kOurs;
  }
}

void add_paper_cells(std::vector<Cell>& cells, const published::Table1Column* column) {
  if (column == nullptr) {
    cells.resize(cells.size() + 4);
    return;
  }
  const published::Errors& errors = column->errors;
  cells.push_back(count(column->rotation_tets, Mark::kPaper));
  for (const double error : {errors.average_mm, errors.maximum_mm, errors.minimum_mm}) {
    cells.push_back({fmt::format("{:g}", error), Mark::kPaper});
  }
}

std::vector<std::string> header(bool has_paper) {
  std::vector<std::string> names = {"θ, degrees", "rotation tets", "average",
                                    "maximum",    "minimum",       "average from NL-FEM"};
  if (has_paper) {
    for (const char* name : {"paper: tets", "average", "maximum", "minimum"}) names.emplace_back(name);
  }
  return names;
}

Table table_of(const Table1& table, Table1Part part, const std::string& caption) {
  const bool has_paper = table.options.is_the_papers();
  Table result{caption, header(has_paper), {}};
  for (const Table1Row& row : table.rows) {
    if (row.part != part) continue;
    std::vector<Cell> cells = {{fmt::format("{:.4g}", row.run.theta_deg)},
                               count(row.run.rotation_tets),
                               number(row.error.mean_mm, mark_of(table, row)),
                               number(row.error.max_mm),
                               {fmt::format("{:.5f}", row.error.min_mm)},
                               row.stvk_error ? number(row.stvk_error->mean_mm) : Cell{"–"}};
    if (has_paper) add_paper_cells(cells, row.column);
    result.rows.push_back(cells);
  }
  return result;
}

void add_model(Table& table, const char* name, const Table1Model& model, const published::Errors* paper) {
  std::vector<Cell> cells = {{name}};
  for (const std::optional<Distance>& error : {std::optional(model.error), model.stvk_error}) {
    for (const double value :
         error ? std::array{error->mean_mm, error->max_mm, error->min_mm} : std::array{-1.0, -1.0, -1.0}) {
      cells.push_back(value < 0.0 ? Cell{"–"} : Cell{fmt::format("{:.3f}", value), Mark::kOurs});
    }
  }
  if (paper != nullptr) {
    for (const double value : {paper->average_mm, paper->maximum_mm, paper->minimum_mm}) {
      cells.push_back({fmt::format("{:.3f}", value), Mark::kPaper});
    }
  } else {
    cells.resize(cells.size() + 3, Cell{"–"});
  }
  table.rows.push_back(cells);
}

Table model_table(const Table1& table) {
  Table result{"The other models, in double precision: distances in mm from full corotation and from NL-FEM.",
               {"model", "average", "maximum", "minimum", "from NL-FEM", "maximum", "minimum",
                "paper: average", "maximum", "minimum"},
               {}};
  add_model(result, "L-FEM", table.linear, table.options.is_the_papers() ? &published::kLinear : nullptr);
  add_model(result, "full corotation", table.full, nullptr);
  return result;
}

Chart curve_chart(const std::vector<ErrorCurve>& curves) {
  Chart chart{"table1_curves.svg", {"rotation tets"}, {"average error, mm", true}, {}};
  for (const ErrorCurve& curve : curves) {
    const bool is_paper = curve.name == "paper";
    Series series{curve.title, ChartPoints{}, is_paper ? SeriesStyle::kPoints : SeriesStyle::kLineAndPoints,
                  curve.name == "misfit"};
    for (const CurvePoint& point : curve.points) {
      std::get<ChartPoints>(series.data)
          .push_back({static_cast<double>(point.rotation_tets), point.average_mm});
    }
    chart.series.push_back(series);
  }
  return chart;
}

void draw(const Table1Study& study, const std::filesystem::path& folder) {
  run_gnuplot(chart_script(curve_chart(study.curves)) + chart_script(time_chart(study.times, "fig6b.svg")),
              folder);
  run_gnuplot(wireframe_script(study.bodies), folder);
}

void add_error_section(ReportPage& page, const Table1Study& study) {
  const Table1& table = study.table;
  page.add_section(fmt::format("Table 1: errors of displacement, bar {}", describe_pose(table.options)));
  page.add_paragraph(
      fmt::format("The fixed-point core holds one end of the bar, turns the other, and comes to rest: over "
                  "500 ticks no node moves "
                  "by more than 0.1 µm and no free node is out of balance by more than 0.005 mN. Errors are "
                  "distances in mm of "
                  "the {} free nodes from full corotation in double precision at the same pose.",
                  table.free_nodes));
  page.add_paragraph(
      "Our criterion weighs a misfit by the volume that has it, the paper's does not, so the same θ stands "
      "for different "
      "meshes. Hence two tables: at the paper's θ, and at the largest number of rotation tets that some θ "
      "reaches and "
      "that is not above the paper's. There the average must not be above the paper's, and from 578 tets up "
      "a quarter of "
      "it is the goal.");
  page.add_table(table_of(table, Table1Part::kCount, "At the paper's number of rotation tets, mm."));
  page.add_table(table_of(table, Table1Part::kTheta, "At the paper's θ, mm."));
  if (!table.options.is_quick) {
    page.add_table(
        table_of(table, Table1Part::kSiblings, "The paper's criterion in our core, at the paper's θ, mm."));
    page.add_table(
        table_of(table, Table1Part::kFull, "Every tet with its own rotation: what fixed point costs, mm."));
  }
  page.add_table(model_table(table));
  std::string caption =
      "Average error over the number of rotation tets. Ours is of the core in fixed point, a point a run.";
  if (!table.options.is_quick) {
    caption +=
        " The search, in double precision, exchanges rotation tets as long as that lowers the error: near "
        "the best that "
        "this many tets can do.";
  }
  page.add_figures({{"table1_curves.svg", caption}});
}

void add_figure6_section(ReportPage& page, const Table1Study& study) {
  page.add_section("Figure 6: the bar at rest, and the time of a tick");
  std::vector<Figure> figures;
  for (std::size_t i = 0; i < study.bodies.size(); ++i) {
    figures.push_back({study.bodies[i].file + ".png", study.body_captions[i]});
  }
  page.add_figures(figures);
  page.add_figures(
      {{"fig6b.svg",
        fmt::format(
            "Time of a tick of 1 ms with {} substeps on the machine that made this page, one thread, by "
            "stage: the "
            "median over slices of {} ticks of the whole run. L-FEM and NL-FEM are the double-precision "
            "reference's plain, scalar evaluation of all elastic forces, {} times a tick, without "
            "integration: "
            "another arithmetic and other code than the core's, so their height tells the order of magnitude "
            "only. L-FEM in the core's own arithmetic would be the leftmost of our bars without rotation "
            "extraction and re-mesh.",
            study.substeps, RestRun::kSliceTicks, study.substeps)}});
}

}  // namespace

void write_table1_tables(const Table1Study& study, const std::filesystem::path& folder) {
  write_whole_file((folder / "table1.csv").string(), table1_csv(study.table));
  write_whole_file((folder / "table1_curves.csv").string(), curves_csv(study.curves));
  write_whole_file((folder / "fig6b.csv").string(), time_csv(study.times));
}

void add_table1_sections(ReportPage& page, const std::filesystem::path& folder, const Table1Study& study) {
  write_table1_tables(study, folder);
  draw(study, folder);
  add_error_section(page, study);
  add_figure6_section(page, study);
}

}  // namespace palpate::sim
