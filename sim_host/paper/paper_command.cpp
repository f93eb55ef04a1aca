// `palpate paper`: the paper's experiments and a report on them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "output/gnuplot.hpp"
#include "paper/criterion_ranking.hpp"
#include "paper/parallel.hpp"
#include "paper/sections.hpp"
#include "paper/table1_output.hpp"
#include "program/commands.hpp"
#include "scenario/errors.hpp"

namespace palpate::sim {
namespace {

void make_folder(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    throw BadInput(fmt::format("'{}' is not a folder; choose another --out", folder.string()));
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw EnvironmentError(fmt::format("cannot write '{}': {}", folder.string(), error.message()));
}

std::string summary_of(const Requirements& requirements, const Experiment& experiment) {
  if (experiment.is_quick)
    return "In haste: every run was cut off after a few ticks, so no figure here means anything.";
  const std::size_t all = requirements.all().size();
  return fmt::format(
      "The experiments of Tagawa, Yamada and Tanaka, run again with Palpate. {} of the {} requirements hold.",
      all - requirements.failed(), all);
}

void print_requirements(const Requirements& requirements) {
  for (const Requirement& one : requirements.all()) {
    fmt::print("{:<6} {}\n         required: {}\n         measured: {}\n", one.holds ? "holds" : "FAILS",
               one.what, one.required, one.measured);
  }
}

void add_requirements_section(const Requirements& requirements, ReportPage& page) {
  page.add_section("What must hold");
  page.add_table(requirements.table());
}

void require_table1(const Table1& table, Requirements& requirements) {
  const std::vector<std::string> objections = find_objections(table);
  requirements.add(
      {"Table 1: rest, and the average error at the paper's numbers of rotation tets",
       "not above the paper's in any row",
       objections.empty() ? "not above it in any row" : fmt::format("{}", fmt::join(objections, "; ")),
       objections.empty()});
}

}  // namespace

int run_paper(const std::string& out, bool is_quick) {
  require_gnuplot();
  const Experiment experiment{out, is_quick};
  make_folder(experiment.folder);
  make_folder(experiment.runs());
  print_line("Table 1 and Figure 6");
  Table1Options options;
  options.is_quick = is_quick;
  const Table1Study table1 = study_table1(options);
  print_line("Figure 7 and the smoothness of the force");
  const PaperRuns runs = run_sines(experiment);
  print_line("Which criterion refines the mesh");
  const std::vector<LoadStudy> studies = study_criteria(experiment);
  Requirements requirements;
  require_table1(table1.table, requirements);
  require_smoothness(runs, requirements);

  const std::string summary = summary_of(requirements, experiment);
  ReportPage page("The paper's experiments, run again", summary);
  if (!is_quick) add_requirements_section(requirements, page);
  add_table1_sections(page, experiment.folder, table1);
  add_fig7_sections(runs, experiment, page);
  add_smoothness_section(runs, experiment, page);
  add_remesh_section(runs, experiment, page);
  add_criterion_section(studies, experiment, page);
  add_files_section(runs, page);
  const std::filesystem::path report = experiment.folder / "report.html";
  page.write(report);

  fmt::print("\n");
  if (!is_quick) print_requirements(requirements);
  fmt::print("{}\n{}\nreport: {}\n", conclusion_of(studies), summary, report.string());
  return !is_quick && requirements.failed() > 0 ? 1 : 0;
}

}  // namespace palpate::sim
