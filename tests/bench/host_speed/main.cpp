// palpate_host_speed: how fast the core is on this machine, beside Bullet's deformable body. Goals are
// reported and never fail. Exit codes: 0 done, 1 the core's two builds differ in a bit, 2 bad input, 3 the
// environment.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>

#include "measure.hpp"
#include "output/gnuplot.hpp"
#include "output/output_file.hpp"
#include "output/status_line.hpp"
#include "peer.hpp"
#include "scenario/errors.hpp"

namespace palpate::bench {
namespace {

namespace fs = std::filesystem;

struct Request {
  std::string out = "out/bench";
  uint32_t rounds = 31;
};

enum ExitCode : int { kDone = 0, kFailed = 1, kBadInput = 2, kEnvironment = 3 };

/// As Linux has it.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

void write_files(const Report& report, const fs::path& folder) {
  sim::write_whole_file((folder / "bench.json").string(), report_json(report).dump(2) + "\n");
  sim::write_whole_file((folder / "bench.txt").string(), report_text(report));
  sim::write_whole_file((folder / "cost.csv").string(), cost_csv(report));
  sim::run_gnuplot(sim::chart_script(cost_chart(report, "cost.svg")), folder);
}

int run(const Request& request) {
  sim::require_gnuplot();
  std::error_code error;
  fs::create_directories(request.out, error);
  if (error) {
    throw sim::EnvironmentError(fmt::format("cannot make '{}': {}", request.out, error.message()));
  }
  Report report{};
  report.processor = processor_name();
  report.compiler = PALPATE_COMPILER;
  report.flags = PALPATE_FLAGS;
  report.peer = peer_name();
  report.rounds = request.rounds;
  {
    sim::StatusLine status;
    const Show show = [&status](const std::string& what) { status.show(what); };
    measure_bar(request.rounds, show, report);
    measure_sizes(request.rounds, show, report);
  }
  write_files(report, request.out);
  fmt::print("{}\nwritten to {}: bench.json, bench.txt, cost.csv, cost.svg\n", report_text(report),
             request.out);
  return report.same_bits ? kDone : kFailed;
}

int run_command_line(int argc, char** argv) {
  Request request;
  CLI::App app("Times the core beside Bullet's deformable body", "palpate_host_speed");
  app.add_option("--out", request.out, "folder for the results")->capture_default_str();
  app.add_option("--rounds", request.rounds, "how often everything is timed, in turn")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return kDone;
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "palpate_host_speed: {}; see --help\n", error.what());
    return kBadInput;
  }
  try {
    return run(request);
  } catch (const std::exception& error) {
    fmt::print(stderr, "palpate_host_speed: {}\n", error.what());
    return kEnvironment;
  }
}

}  // namespace
}  // namespace palpate::bench

int main(int argc, char** argv) { return palpate::bench::run_command_line(argc, argv); }
