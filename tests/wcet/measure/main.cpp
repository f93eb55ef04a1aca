// palpate-measure: runs a target program in QEMU, counts what a root of it does, and holds that against the
// root's bound, graph and flow facts.
#include "command_line.hpp"
#include "counted_run.hpp"
#include "measurement.hpp"
#include "output/output_file.hpp"
#include "planning.hpp"

namespace palpate::wcet {
namespace {

struct Options {
  std::string elf;
  std::string root;
  std::string json;
  std::string plugin;
  double most_ratio = 0;
  double least_coverage = 0;
  std::vector<std::string> command;
};

std::string plugin_beside_program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "palpate-counting.so";
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("ELF", options.elf, "the linked program")->required();
  app.add_option("--root", options.root,
                 "the function: its name, or a part that no other function's name has")
      ->required();
  app.add_option("--run", options.command,
                 "last: the command that runs the program in QEMU; -plugin is put behind it")
      ->required()
      ->expected(1, -1);
  app.add_option("--json", options.json, "writes all figures to this file");
  app.add_option("--plugin", options.plugin,
                 "QEMU's plugin; by default palpate-counting.so beside this program");
  app.add_option("--most-ratio", options.most_ratio,
                 "fails when the bound is more than so many times the count");
  app.add_option("--least-coverage", options.least_coverage, "fails when fewer percent of the blocks ran");
}

std::vector<std::string> broken_limits(const Options& options, const Measurement& measurement) {
  std::vector<std::string> broken;
  if (options.most_ratio > 0 && measurement.ratio() > options.most_ratio) {
    broken.push_back("the bound is " + std::to_string(measurement.ratio()) +
                     " of the most that was seen, and may be " + std::to_string(options.most_ratio));
  }
  if (measurement.coverage_percent() < options.least_coverage) {
    broken.push_back(std::to_string(measurement.coverage_percent()) + " % of the blocks ran, and " +
                     std::to_string(options.least_coverage) + " % must");
  }
  return broken;
}

/// Whether all gates hold.
bool measure(const Options& options) {
  const Program program(options.elf);
  const CallGraph calls(program, program.image().find_function(options.root).start);
  const BoundAnalysis bounds(program, calls, read_cost_model("instructions"));
  const Counts counts = run_counted(options.command, options.plugin, make_plan(program, calls, bounds));
  const Measurement measurement = measure(program, calls, bounds, counts);
  print(measurement);
  std::fflush(stdout);
  if (!options.json.empty())
    sim::write_whole_file(options.json, to_json(program, measurement).dump(1) + "\n");
  std::vector<std::string> broken = broken_gates(program, measurement);
  for (const std::string& limit : broken_limits(options, measurement)) broken.push_back(limit);
  for (const std::string& gate : broken) std::fprintf(stderr, "palpate-measure: %s\n", gate.c_str());
  return broken.empty();
}

int run(int argc, char** argv) {
  CLI::App app(
      "Counts in QEMU what a function of a linked Cortex-M program does, with all that it calls, and holds "
      "it\n"
      "against the function's bound, its control-flow graph and its flow facts.\n"
      "Exit codes: 0 fine, 1 a check failed, 2 bad input, 3 the environment.\n"
      "This program links GLPK and is therefore distributed under the GPL, version 3 or later.",
      "palpate-measure");
  Options options;
  options.plugin = plugin_beside_program();
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return measure(options) ? kFine : kFailed; });
}

}  // namespace
}  // namespace palpate::wcet

int main(int argc, char** argv) { return palpate::wcet::run(argc, argv); }
