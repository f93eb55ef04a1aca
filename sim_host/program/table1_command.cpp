// `table1`: the paper's Table 1 in the fixed-point core.
#include <fmt/format.h>

#include "output/gnuplot.hpp"
#include "output/run_folder.hpp"
#include "paper/table1_output.hpp"
#include "program/commands.hpp"

namespace palpate::sim {
namespace {

constexpr const char* kPage = "index.html";

std::vector<std::string> table1_files() {
  std::vector<std::string> files = {kPage,       "table1.csv", "table1_curves.csv", "table1_curves.svg",
                                    "fig6b.csv", "fig6b.svg"};
  for (const char* body : {"fig6a_48", "fig6a_300", "fig6a_linear", "fig6a_nonlinear"}) {
    for (const char* ending : {".svg", ".png"}) files.push_back(std::string(body) + ending);
  }
  return files;
}

void write_page(const Table1Study& study, const RunFolder& folder) {
  ReportPage page(fmt::format("A bar {}", describe_pose(study.table.options)),
                  "Soft tissue in fixed point beside the paper's first experiment.");
  add_table1_sections(page, folder.temporary(), study);
  page.write(folder.file(kPage));
}

}  // namespace

int make_table1(const Table1Request& request) {
  if (request.plots) require_gnuplot();
  RunFolder folder(request.out, table1_files());
  const Table1Study study = study_table1(request.options);
  if (request.plots) {
    write_page(study, folder);
  } else {
    write_table1_tables(study, folder.temporary());
  }
  folder.commit();
  fmt::print("{}", table1_text(study.table));
  fmt::print("written to {}\n", request.plots ? request.out + "/" + kPage : request.out);
  const std::vector<std::string> objections = find_objections(study.table);
  for (const std::string& objection : objections) fmt::print(stderr, "palpate: {}\n", objection);
  return objections.empty() ? 0 : 1;
}

}  // namespace palpate::sim
