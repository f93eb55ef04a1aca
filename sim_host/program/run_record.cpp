#include "program/run_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "model_parameters.hpp"
#include "text/split_at.hpp"

namespace palpate::sim {
namespace {

namespace fs = std::filesystem;

template <class Number>
std::optional<Number> parse(const std::string& text, int base) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, base);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

bool is_hash(const std::string& text) { return text.size() == 16 && parse<uint64_t>(text, 16).has_value(); }

[[noreturn]] void refuse(const RunRecord& run, std::size_t line, const std::string& why) {
  throw BadInput(fmt::format("{}:{}: {}", run.source, line, why));
}

/// cells: tick and hashes.
void add_row(RunRecord& run, const std::vector<std::string>& cells, std::size_t line) {
  const auto tick = parse<uint32_t>(cells[0], 10);
  if (!tick) refuse(run, line, fmt::format("'{}' is no tick", cells[0]));
  if (cells.size() != run.stages.size() + 1) {
    refuse(
        run, line,
        fmt::format("the row has {} hashes, but there are {} stages", cells.size() - 1, run.stages.size()));
  }
  const auto wrong = std::find_if_not(cells.begin() + 1, cells.end(), is_hash);
  if (wrong != cells.end())
    refuse(run, line, fmt::format("'{}' is no hash of 16 hexadecimal digits", *wrong));
  if (!run.hashes.emplace(*tick, std::vector<std::string>(cells.begin() + 1, cells.end())).second) {
    refuse(run, line, fmt::format("tick {} is there twice", *tick));
  }
}

void read_hash_csv(RunRecord& run) {
  std::ifstream file(run.source);
  std::string text;
  for (std::size_t line = 1; std::getline(file, text); ++line) {
    const std::vector<std::string> cells = split_at_commas(text);
    if (line > 1) {
      add_row(run, cells, line);
    } else if (cells.size() < 2 || cells[0] != "tick") {
      refuse(run, line, "the header must be tick and the stages' names");
    } else {
      run.stages.assign(cells.begin() + 1, cells.end());
    }
  }
  if (run.hashes.empty()) run.problem = "has no hashes";
}

void read_summary_json(RunRecord& run, const fs::path& path) {
  std::ifstream file(path);
  const auto json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object()) throw BadInput(fmt::format("{}: not a run's summary", path.string()));
  for (const auto& [key, value] : json.items()) {
    run.summary[key] = value.is_string() ? value.get<std::string>() : value.dump();
  }
  const auto failure = json.find("failure");
  if (failure != json.end() && failure->is_string()) run.problem = "failed: " + failure->get<std::string>();
}

/// The target leaves the root to its reader: the square of the peak force is in (2^-27 N)^2.
void add_peak_force(RunRecord& run) {
  const auto found = run.summary.find("peak_force_square");
  if (found == run.summary.end()) return;
  const auto square = parse<uint64_t>(found->second, 16);
  if (!square) return;
  run.summary["peak_force_N"] = fmt::format("{}", std::ldexp(std::sqrt(static_cast<double>(*square)), -27));
}

void read_console(RunRecord& run) {
  std::ifstream file(run.source);
  std::string text;
  bool has_end = false;
  for (std::size_t line = 1; std::getline(file, text); ++line) {
    const std::vector<std::string> cells = split_at_commas(text);
    const std::vector<std::string> rest(cells.begin() + 1, cells.end());
    if (cells[0] == "stages") {
      run.stages = rest;
      run.stages.emplace_back("state");
    } else if (cells[0] == "hash" && !rest.empty()) {
      add_row(run, rest, line);
    } else if (cells[0] == "summary" && rest.size() >= 2) {
      run.summary[rest[0]] = rest[1];
    } else if (cells[0] == "error" || cells[0] == "fault") {
      run.problem = fmt::format("stopped: {}", text);
    }
    has_end = has_end || cells[0] == "end";
  }
  add_peak_force(run);
  const auto fault = run.summary.find("fault");
  const bool has_fault = fault != run.summary.end() && fault->second != "0";
  if (run.problem.empty() && has_fault) run.problem = "ended with fault " + fault->second;
  if (run.problem.empty() && !has_end) run.problem = "is cut off: its last line is not 'end'";
}

}  // namespace

RunRecord read_run(const std::string& folder) {
  RunRecord run;
  run.name = folder;
  const fs::path path(folder);
  if (!fs::is_directory(path)) throw BadInput(fmt::format("'{}' is not a folder", folder));
  if (fs::exists(path / "hash.csv")) {
    run.source = (path / "hash.csv").string();
    read_hash_csv(run);
    if (fs::exists(path / "summary.json")) read_summary_json(run, path / "summary.json");
  } else if (fs::exists(path / "console.csv")) {
    run.source = (path / "console.csv").string();
    read_console(run);
  } else {
    throw BadInput(fmt::format("'{}' holds neither hash.csv nor console.csv, so it is no run", folder));
  }
  return run;
}

}  // namespace palpate::sim
