// palpate-timing: the worst-case figures of all profiles, as tables, JSON and a page, and whether they hold.
#include <fstream>
#include <sstream>

#include "command_line.hpp"
#include "output/output_file.hpp"
#include "timing_report.hpp"

namespace palpate::wcet::timing {
namespace {

struct Options {
  std::string figures = PALPATE_SOURCE_FOLDER "/tests/wcet/figures.toml";
  std::string changelog = PALPATE_SOURCE_FOLDER "/CHANGELOG.md";
  Builds builds{{{"m4", PALPATE_SOURCE_FOLDER "/build/m4"}, {"m7", PALPATE_SOURCE_FOLDER "/build/m7"}},
                PALPATE_SOURCE_FOLDER "/tests/wcet/devices"};
  std::string core;
  std::string out;
  std::string document = PALPATE_SOURCE_FOLDER "/docs/timing.md";
};

std::string read_text(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw BadInput("can't open " + path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Results {
  std::vector<ProfileTiming> timings;
  std::vector<Finding> findings;

  [[nodiscard]] bool has_failed() const {
    for (const Finding& finding : findings) {
      if (finding.is_failure) return true;
    }
    return false;
  }
};

Results run_analyses(const Options& options) {
  FigureFile figures = read_figures(options.figures);
  if (!options.core.empty()) {
    std::vector<FigureRow> rows;
    for (const FigureRow& row : figures.rows) {
      if (row.core == options.core) rows.push_back(row);
    }
    if (rows.empty()) throw BadInput(options.figures + " has no profile on " + options.core);
    figures.rows = rows;
  }
  Results results{time_profiles(figures, options.builds), {}};
  const std::string changelog = read_text(options.changelog);
  for (const ProfileTiming& timing : results.timings) {
    for (Finding& finding : judge(timing, changelog)) results.findings.push_back(std::move(finding));
  }
  return results;
}

ExitCode finish(const Results& results) {
  for (const Finding& finding : results.findings)
    std::printf("%s %s\n", finding.is_failure ? "FAILED" : "note  ", finding.text.c_str());
  return results.has_failed() ? kFailed : kFine;
}

ExitCode check(const Options& options) {
  const Results results = run_analyses(options);
  std::printf("%s\n", make_tables(results.timings).c_str());
  return finish(results);
}

ExitCode report(const Options& options) {
  const Results results = run_analyses(options);
  const std::filesystem::path out = options.out;
  std::filesystem::create_directories(out);
  sim::write_whole_file(out / "timing.json", make_json(results.timings).dump(1) + "\n");
  sim::write_whole_file(out / "timing.html", make_page(results.timings, results.findings));
  sim::write_whole_file(out / "timing.md", make_markdown(results.timings));
  std::printf("%s\n", make_tables(results.timings).c_str());
  return finish(results);
}

/// What is between the marks becomes the tables.
std::string with_tables(const std::string& document, const std::string& tables, const std::string& path) {
  constexpr std::string_view kBegin = "<!-- figures: palpate-timing commit -->\n";
  constexpr std::string_view kEnd = "<!-- end of figures -->\n";
  const size_t begin = document.find(kBegin);
  const size_t end = document.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw BadInput(path + " has no marks around its figures");
  return document.substr(0, begin + kBegin.size()) + "\n" + tables + "\n" + document.substr(end);
}

ExitCode commit(const Options& options) {
  const Results results = run_analyses(options);
  // What fails is not made right by committing it.
  if (results.has_failed()) return finish(results);
  std::vector<FigureRow> rows;
  for (const ProfileTiming& timing : results.timings) {
    rows.push_back(timing.row);
    rows.back().committed = timing.now();
  }
  const std::string figures = with_committed(read_text(options.figures), rows);
  const std::string document =
      with_tables(read_text(options.document), make_markdown(results.timings), options.document);
  sim::write_whole_file(options.figures, figures);
  sim::write_whole_file(options.document, document);
  return finish(results);
}

void add_options(CLI::App& command, Options& options) {
  for (auto& [core, folder] : options.builds.folders)
    command.add_option("--" + core, folder, "folder with the images for this core");
  command.add_option("--figures", options.figures, "the committed figures");
  command.add_option("--changelog", options.changelog, "where growth is said");
}

int run(int argc, char** argv) {
  CLI::App app(
      "Bounds every profile's tick on the images palpate_timing_<profile>.elf and compares with what is "
      "committed.\n"
      "Exit codes: 0 fine, 1 something that must hold does not, 2 bad input, 3 the environment.\n"
      "This program links GLPK and is therefore distributed under the GPL, version 3 or later.",
      "palpate-timing");
  app.require_subcommand(1);
  Options options;
  ExitCode code = kFine;
  CLI::App* const report_command =
      app.add_subcommand("report", "tables, timing.json, timing.html and timing.md");
  add_options(*report_command, options);
  report_command->add_option("--out", options.out, "folder for them")->required();
  report_command->callback([&] { code = report(options); });
  CLI::App* const check_command = app.add_subcommand("check", "tables, and whether everything holds");
  add_options(*check_command, options);
  check_command->add_option("--core", options.core, "only the images of this core: m4, m7");
  check_command->callback([&] { code = check(options); });
  CLI::App* const commit_command = app.add_subcommand(
      "commit", "makes the figures now the committed ones, and puts them into the document");
  add_options(*commit_command, options);
  commit_command->add_option("--document", options.document, "the document with their tables");
  commit_command->callback([&] { code = commit(options); });
  return run_program(app, argc, argv, [&] { return code; });
}

}  // namespace
}  // namespace palpate::wcet::timing

int main(int argc, char** argv) { return palpate::wcet::timing::run(argc, argv); }
