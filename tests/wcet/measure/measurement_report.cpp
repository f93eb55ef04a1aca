#include <fmt/format.h>

#include <algorithm>

#include "measurement.hpp"
#include "report_rows.hpp"

namespace palpate::wcet {
namespace {

using nlohmann::json;

constexpr size_t kLoosest = 30;
constexpr size_t kGaps = 40;

/// 0 where nothing was seen.
double ratio_of(double bound, uint64_t seen) { return seen == 0 ? 0 : bound / static_cast<double>(seen); }

void print_stages(const Measurement& measurement) {
  fmt::print("\n{:>12} {:>12} {:>6} {:>12}  {}\n", "worst path", "most a tick", "ratio", "in longest",
             "stage");
  for (const FunctionSeen& function : measurement.functions) {
    const std::optional<std::string> stage = stage_name(function.name);
    if (!stage) continue;
    fmt::print(
        "{:>12.0f} {:>12} {:>6.2f} {:>12}  {}\n", function.on_worst_path, function.seen.most_in_invocation,
        ratio_of(function.on_worst_path, function.seen.most_in_invocation), function.seen.in_longest, *stage);
  }
}

// Where the worst path has most that the longest invocation had not.
void print_loosest(const Measurement& measurement) {
  std::vector<const FunctionSeen*> order;
  for (const FunctionSeen& function : measurement.functions) order.push_back(&function);
  const auto gap = [](const FunctionSeen* of) {
    return of->on_worst_path - static_cast<double>(of->seen.in_longest);
  };
  std::stable_sort(order.begin(), order.end(), [&](const auto* a, const auto* b) { return gap(a) > gap(b); });
  order.resize(std::min(order.size(), kLoosest));
  fmt::print("\n{:>12} {:>12} {:>12} {:>10} {:>10}  {}\n", "worst path", "in longest", "most a tick", "bound",
             "most seen", "function, a tick and a call");
  for (const FunctionSeen* function : order) {
    fmt::print("{:>12.0f} {:>12} {:>12} {:>10} {:>10}  {}\n", function->on_worst_path,
               function->seen.in_longest, function->seen.most_in_invocation, function->bound.value_or(0),
               function->seen.most, short_name(function->name));
  }
}

void print_gaps(const Measurement& measurement) {
  fmt::print(
      "\n{:>10} {:>12} {:>12} {:>6}  blocks that the worst path runs more often than the longest "
      "invocation did\n",
      "gap", "worst path", "in longest", "each");
  for (size_t i = 0; i < std::min(kGaps, measurement.gaps.size()); ++i) {
    const BlockSeen& block = measurement.gaps[i];
    fmt::print("{:>10.0f} {:>12.0f} {:>12} {:>6}  {} {:#x} {}\n", block.gap(), block.on_worst_path,
               block.in_longest, block.instructions, short_name(block.place.function), block.place.address,
               block.place.line);
  }
}

void print_loops(const Measurement& measurement) {
  fmt::print("\n{:>8} {:>8} {:>10}  {}\n", "bound", "rounds", "entries",
             "loops that never came to their bound");
  for (const LoopSeen& loop : measurement.loops) {
    if (loop.seen.most_rounds >= loop.bound) continue;
    fmt::print("{:>8} {:>8} {:>10}  {} {:#x} {}\n", loop.bound, loop.seen.most_rounds, loop.seen.entries,
               short_name(loop.function), loop.body.address, loop.body.line);
  }
}

void print_uncovered(const Measurement& measurement) {
  fmt::print("\n{:>12}  blocks that never ran\n", "instructions");
  for (const UncoveredBlock& block : measurement.uncovered) {
    fmt::print("{:>12}  {} {:#x} {}\n", block.instructions, short_name(block.place.function),
               block.place.address, block.place.line);
  }
}

json place_json(const Place& place) {
  return {{"function", place.function}, {"address", place.address}, {"line", place.line}};
}

json loops_json(const Measurement& measurement) {
  json rows = json::array();
  for (const LoopSeen& loop : measurement.loops) {
    rows.push_back({{"id", loop.id},
                    {"bound", loop.bound},
                    {"most_seen", loop.seen.most_rounds},
                    {"entries", loop.seen.entries},
                    {"bodies", loop.seen.bodies},
                    {"is_over", loop.is_over()},
                    {"within", loop.function},
                    {"where", place_json(loop.body)}});
  }
  return rows;
}

json functions_json(const Measurement& measurement) {
  json rows = json::array();
  for (const FunctionSeen& function : measurement.functions) {
    json row{{"name", function.name},
             {"on_worst_path", function.on_worst_path},
             {"calls", function.seen.calls},
             {"most_in_call", function.seen.most},
             {"most_in_invocation", function.seen.most_in_invocation},
             {"in_longest_invocation", function.seen.in_longest}};
    if (const auto stage = stage_name(function.name)) row["stage"] = *stage;
    if (function.bound) row["bound"] = *function.bound;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

void print(const Measurement& measurement) {
  fmt::print("{}: at most {} instructions, at most {} seen (invocation {} of {}), {:.3f} times that\n",
             measurement.root, measurement.bound, measurement.longest, measurement.longest_at,
             measurement.invocations, measurement.ratio());
  fmt::print("{} of {} blocks ran, {:.1f} %\n", measurement.blocks - measurement.uncovered.size(),
             measurement.blocks, measurement.coverage_percent());
  print_stages(measurement);
  print_loosest(measurement);
  print_gaps(measurement);
  print_loops(measurement);
  print_uncovered(measurement);
}

json to_json(const Program& program, const Measurement& measurement) {
  json uncovered = json::array();
  for (const UncoveredBlock& block : measurement.uncovered) {
    json row = place_json(block.place);
    row["instructions"] = block.instructions;
    uncovered.push_back(row);
  }
  json outside = json::array();
  for (const auto& [from, to] : measurement.outside) {
    outside.push_back({{"from", place_json(program.place(from))}, {"to", place_json(program.place(to))}});
  }
  return {{"root", measurement.root},
          {"bound_instructions", measurement.bound},
          {"max_observed_instructions", measurement.longest},
          {"ratio", measurement.ratio()},
          {"invocations", measurement.invocations},
          {"longest_invocation", measurement.longest_at},
          {"blocks", measurement.blocks},
          {"blocks_covered", measurement.blocks - measurement.uncovered.size()},
          {"coverage_percent", measurement.coverage_percent()},
          {"uncovered", uncovered},
          {"edges_outside_graph", outside},
          {"loops", loops_json(measurement)},
          {"functions", functions_json(measurement)}};
}

}  // namespace palpate::wcet
