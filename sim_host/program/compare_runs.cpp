// `compare`: whether two runs have the same bits, stage by stage.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>

#include "program/commands.hpp"
#include "program/run_record.hpp"

namespace palpate::sim {
namespace {

std::string summary_or(const RunRecord& run, const char* key, const char* otherwise) {
  const auto found = run.summary.find(key);
  return found == run.summary.end() ? otherwise : found->second;
}

std::string last_state_hash(const RunRecord& run) {
  return run.hashes.empty() ? "-" : run.hashes.rbegin()->second.back();
}

std::string tets(const RunRecord& run) {
  return summary_or(run, "tets", summary_or(run, "leaves", "-").c_str());
}

std::string peak_force(const RunRecord& run) {
  double newtons = 0.0;
  const std::string text = summary_or(run, "peak_force_N", "");
  const auto result = std::from_chars(text.data(), text.data() + text.size(), newtons);
  return result.ec == std::errc{} ? fmt::format("{:.3f} mN", newtons * 1e3) : "-";
}

std::string last_tick(const RunRecord& run) {
  return run.hashes.empty() ? "-" : fmt::format("{}", run.hashes.rbegin()->first);
}

void print_both(const RunRecord& a, const RunRecord& b) {
  constexpr std::size_t kHashWidth = 16;
  const std::size_t width = std::max(kHashWidth, a.name.size());
  const auto row = [width](const char* what, const std::string& of_a, const std::string& of_b) {
    fmt::print("  {:<12} {:<{}}  {}\n", what, of_a, width, of_b);
  };
  row("", a.name, b.name);
  row("scenario", summary_or(a, "scenario", "-"), summary_or(b, "scenario", "-"));
  row("profile", summary_or(a, "profile", "-"), summary_or(b, "profile", "-"));
  row("ticks", last_tick(a), last_tick(b));
  row("tets", tets(a), tets(b));
  row("peak force", peak_force(a), peak_force(b));
  row("state hash", last_state_hash(a), last_state_hash(b));
}

void print_plots(const RunRecord& run) {
  for (const char* name : {"body.png", "force.svg"}) {
    const auto path = std::filesystem::path(run.name) / name;
    if (std::filesystem::exists(path)) fmt::print("  picture      {}\n", path.string());
  }
}

/// Ticks of a run that the other one lacks.
std::optional<std::string> describe_missing(const RunRecord& run, const RunRecord& other) {
  std::vector<uint32_t> missing;
  for (const auto& [tick, row] : run.hashes) {
    if (other.hashes.count(tick) == 0) missing.push_back(tick);
  }
  if (missing.empty()) return std::nullopt;
  return fmt::format("{} has no hashes of {} ticks that {} has, the first is {}", other.name, missing.size(),
                     run.name, missing[0]);
}

/// "tick 300, stage forces", and the stages after it that differ too.
std::optional<std::string> find_first_difference(const RunRecord& a, const RunRecord& b) {
  for (const auto& [tick, row] : a.hashes) {
    const auto other = b.hashes.find(tick);
    if (other == b.hashes.end()) continue;
    const auto [here, there] = std::mismatch(row.begin(), row.end(), other->second.begin());
    if (here == row.end()) continue;
    const auto stage = static_cast<std::size_t>(here - row.begin());
    return fmt::format("tick {}, stage {}: {} against {}", tick, a.stages[stage], *here, *there);
  }
  return std::nullopt;
}

std::size_t count_common(const RunRecord& a, const RunRecord& b) {
  return static_cast<std::size_t>(std::count_if(
      a.hashes.begin(), a.hashes.end(), [&](const auto& row) { return b.hashes.count(row.first) > 0; }));
}

/// Why they are not equal, a reason a line; empty when they are.
std::vector<std::string> find_objections(const RunRecord& a, const RunRecord& b) {
  std::vector<std::string> objections;
  for (const RunRecord* run : {&a, &b}) {
    if (!run->problem.empty()) objections.push_back(fmt::format("{} {}", run->source, run->problem));
  }
  if (a.stages != b.stages) {
    objections.push_back(
        fmt::format("the runs have different stages, so their hashes do not compare: {} against {}",
                    fmt::join(a.stages, " "), fmt::join(b.stages, " ")));
    return objections;
  }
  if (const auto difference = find_first_difference(a, b))
    objections.push_back("first difference: " + *difference);
  for (const auto& missing : {describe_missing(a, b), describe_missing(b, a)}) {
    if (missing) objections.push_back(*missing + "; record both with the same --hash-every and --ticks");
  }
  return objections;
}

}  // namespace

int compare_runs(const std::string& first, const std::string& second) {
  const RunRecord a = read_run(first);
  const RunRecord b = read_run(second);
  print_both(a, b);
  print_plots(a);
  print_plots(b);
  const auto objections = find_objections(a, b);
  if (objections.empty()) {
    fmt::print("equal: all {} stages at all {} hashed ticks\n", a.stages.size() - 1, a.hashes.size());
    return 0;
  }
  fmt::print("NOT equal ({} ticks in common)\n", count_common(a, b));
  for (const std::string& objection : objections) fmt::print("  {}\n", objection);
  return 1;
}

}  // namespace palpate::sim
