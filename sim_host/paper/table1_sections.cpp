// Table 1 and Figure 6 as sections of a report.
#include <fmt/format.h>

#include "output/gnuplot.hpp"
#include "output/output_file.hpp"
#include "paper/table1_output.hpp"

namespace palpate::sim {
namespace {

Cell number(double value, Mark mark = Mark::kPlain) { return Cell{fmt::format("{:.5f}", value), mark}; }
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
                                    "maximum",    "minimum",       "from NL-FEM"};
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
                               number(row.error.min_mm),
                               row.stvk_error ? number(row.stvk_error->mean_mm) : Cell{"–"}};
    if (has_paper) add_paper_cells(cells, row.column);
    result.rows.push_back(cells);
  }
  return result;
}

void add_distance(std::vector<Cell>& cells, const std::optional<Distance>& error) {
  if (!error) {
    cells.resize(cells.size() + 3, Cell{"–"});
    return;
  }
  for (const double mm : {error->mean_mm, error->max_mm, error->min_mm}) {
    cells.push_back({fmt::format("{:.3f}", mm), Mark::kOurs});
  }
}

Table model_table(const Table1& table) {
  Table result{"The other models, in double precision: distances in mm from full corotation and from NL-FEM.",
               {"model", "average", "maximum", "minimum", "from NL-FEM", "maximum", "minimum"},
               {}};
  for (const auto& [name, model] :
       {std::pair("L-FEM", table.linear), std::pair("full corotation", table.full)}) {
    std::vector<Cell> cells = {{name}};
    add_distance(cells, model.error);
    add_distance(cells, model.stvk_error);
    result.rows.push_back(cells);
  }
  if (!table.options.is_the_papers()) return result;
  const published::Errors& paper = published::kLinear;
  for (const char* name : {"paper: average", "maximum", "minimum"}) result.header.emplace_back(name);
  for (const double mm : {paper.average_mm, paper.maximum_mm, paper.minimum_mm}) {
    result.rows[0].push_back({fmt::format("{:.3f}", mm), Mark::kPaper});
    result.rows[1].push_back({"–"});
  }
  return result;
}

Chart curve_chart(const std::vector<ErrorCurve>& curves) {
  // Below, everything is at full corotation; above, nothing is but L-FEM.
  constexpr Range kErrorMm{1e-5, 3.0};
  Chart chart{"table1_curves.svg", {"rotation tets"}, {"average error, mm", true, kErrorMm}, {}};
  for (const ErrorCurve& curve : curves) {
    const bool is_line = curve.name == "misfit" || curve.name == "searched";
    Series series{curve.title, ChartPoints{}, is_line ? SeriesStyle::kLineAndPoints : SeriesStyle::kPoints,
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
                  "500 ticks no node moves by more than 0.1 µm and no free node is out of balance by more "
                  "than 0.005 mN. Errors are distances in mm of the {} free nodes from full corotation in "
                  "double precision at the same pose.",
                  table.free_nodes));
  page.add_paragraph(
      "Our criterion weighs a misfit by the volume that has it, the paper's does not, so the same θ stands "
      "for different meshes. Hence two tables: at the paper's θ, and at the largest number of rotation "
      "tets that some θ reaches and that is not above the paper's. There the average must not be above the "
      "paper's, and from 578 tets up a quarter of it is the goal.");
  page.add_table(table_of(table, Table1Part::kCount, "At the paper's number of rotation tets, mm."));
  page.add_table(table_of(table, Table1Part::kTheta, "At the paper's θ, mm."));
  if (!table.options.is_quick) {
    page.add_table(table_of(table, Table1Part::kSiblings,
                            "The paper's criterion in our core, siblings compared, at the paper's θ, mm."));
    page.add_table(
        table_of(table, Table1Part::kFull, "Every tet with its own rotation: what fixed point costs, mm."));
  }
  page.add_table(model_table(table));
  std::string caption =
      "Average error over the number of rotation tets. Ours is of the core in fixed point, a point a run.";
  if (!table.options.is_quick) {
    caption +=
        " The search, in double precision, exchanges rotation tets as long as that lowers the error: near "
        "the best that so many tets can do. Errors below 1e-5 mm are not shown.";
  }
  page.add_figures({{"table1_curves.svg", caption}});
}

Table time_table(const std::vector<TickTime>& times) {
  Table table{
      "Time of a tick, ms; L-FEM and NL-FEM: elastic forces only, in double precision.",
      {"model", "θ, degrees", "rotation tets", "rotations", "re-mesh", "forces", "other stages", "together"},
      {}};
  for (const TickTime& time : times) {
    std::vector<Cell> cells = {{time.row ? "ours" : time.name},
                               {time.row ? fmt::format("{:g}", time.row->run.theta_deg) : "–"},
                               {time.row ? fmt::format("{}", time.row->run.rotation_tets) : "–"}};
    double sum = time.double_forces_ms;
    for (const double ms : shown_times_ms(time)) {
      cells.push_back({time.row ? fmt::format("{:.4f}", ms) : "–"});
      sum += ms;
    }
    cells.push_back({fmt::format("{:.4f}", sum)});
    table.rows.push_back(cells);
  }
  return table;
}

std::string describe_times(const Table1Study& study) {
  return fmt::format(
      "Time of a tick of 1 ms with {} substeps on the machine that made this page, one thread, by stage: "
      "the median over slices of {} ticks of the whole run. L-FEM and NL-FEM stand for the plain scalar "
      "evaluation of all elastic forces in double precision, {} times a tick, without integration. That is "
      "other arithmetic and other code, so these two bars tell the order of magnitude only: a PC does "
      "doubles at no extra cost, while the core's fixed point is made for controllers. In the core's own "
      "arithmetic, L-FEM would cost about what our leftmost bar does without its rotations and re-mesh.",
      study.substeps, RestRun::kSliceTicks, study.substeps);
}

void add_figure6_section(ReportPage& page, const Table1Study& study) {
  page.add_section("Figure 6: the bar at rest, and the time of a tick");
  std::vector<Figure> figures;
  for (std::size_t i = 0; i < study.bodies.size(); ++i) {
    figures.push_back({study.bodies[i].file + ".png", study.body_captions[i]});
  }
  page.add_figures(figures);
  page.add_figures({{"fig6b.svg", describe_times(study)}});
  page.add_table(time_table(study.times));
  page.add_paragraph(
      fmt::format("The paper's re-mesh takes {:g} ms, on its own machine.", published::kRemeshMs));
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
