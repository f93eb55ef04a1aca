#include <fmt/format.h>

#include <algorithm>

#include "page_parts.hpp"
#include "timing_report.hpp"

namespace palpate::wcet::timing {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang=en><head><meta charset=utf-8><title>Palpate: worst-case timing</title><style>
body { font: 15px/1.45 system-ui, sans-serif; color: #1c2430; max-width: 66rem; margin: 2rem auto; padding: 0 1rem }
h1 { font-size: 1.6rem } h2 { font-size: 1.25rem; margin-top: 2.5rem; border-top: 1px solid #d5dae2; padding-top: 1rem }
h3 { font-size: 1rem; margin: 1.2rem 0 .3rem }
table { border-collapse: collapse; margin: .4rem 0; font-size: 13.5px }
th, td { text-align: left; white-space: nowrap; padding: .18rem 1.1rem .18rem 0; border-bottom: 1px solid #eceff3; vertical-align: middle }
th { color: #5a6575; font-weight: 600 } .n { text-align: right; font-variant-numeric: tabular-nums }
.bar { width: 11rem; height: .75rem; background: #eef1f5; border-radius: 2px } .bar div { height: 100%; border-radius: 2px }
.met { color: #2d7a4b } .not { color: #b3402e } summary { cursor: pointer; color: #3b6fb6; margin: .4rem 0 }
p.note { color: #5a6575; font-size: 13.5px } .scale { position: relative; width: 18rem; height: 1rem; background: #eef1f5 }
.scale div { position: absolute; top: 0; height: 100% } .scale .tick { width: 2px; background: #1c2430 }
</style></head><body>
)";

std::string design_cell(const ProfileTiming& timing) {
  const std::optional<Cycles>& design = timing.row.design.cycles;
  if (!design) return "none";
  const bool is_met = timing.figures.cycles <= *design;
  return fmt::format("{} <span class={}>{}</span>", grouped(*design), is_met ? "met" : "not",
                     is_met ? "met" : "not met");
}

std::string table_of_profiles(const std::vector<ProfileTiming>& timings) {
  PageTable table({{"profile", false},
                   {"core", false},
                   {"bound, instructions"},
                   {"most observed"},
                   {"bound, cycles"},
                   {"design, cycles"},
                   {"stack, bytes"},
                   {"RAM, bytes"},
                   {"tick code, bytes"}});
  for (const ProfileTiming& timing : timings) {
    const CommittedFigures now = timing.now();
    const std::string measured =
        timing.measured ? fmt::format("{} ({:.2f} x)", grouped(timing.measured->max_observed_instructions),
                                      *timing.ratio())
                        : "not measured";
    table.add({{timing.name, false},
               {timing.row.core, false},
               {grouped(now.instructions)},
               {measured},
               {grouped(now.cycles)},
               {design_cell(timing)},
               {grouped(now.stack_bytes)},
               {grouped(now.ram_bytes)},
               {grouped(now.tick_code_bytes)}});
  }
  return table.html();
}

// A bar of the bound's time, and a mark where the tick ends.
std::string period_bar(double bound_us, double longest_us) {
  constexpr double kPeriodUs = 1000;
  return fmt::format(
      "<div class=scale><div style=\"width:{:.2f}%;background:{}\"></div>"
      "<div class=tick style=\"left:{:.2f}%\"></div></div>",
      100 * bound_us / longest_us, bound_us <= kPeriodUs ? "#4d9a6a" : "#c8553d",
      100 * kPeriodUs / longest_us);
}

std::string table_of_boards(const std::vector<ProfileTiming>& timings) {
  double longest_us = 1100;
  for (const ProfileTiming& timing : timings) {
    for (const BoardTiming& board : timing.boards) longest_us = std::max(longest_us, board.microseconds());
  }
  PageTable table({{"profile", false},
                   {"board", false},
                   {"MHz"},
                   {"cycles"},
                   {"of them registers"},
                   {"&micro;s"},
                   {"slack, &micro;s"},
                   {"the mark is 1 ms", false}});
  for (const ProfileTiming& timing : timings) {
    for (const BoardTiming& board : timing.boards) {
      table.add({{timing.name, false},
                 {escaped(board.board.name), false},
                 {fmt::format("{:.0f}", board.board.clock_mhz)},
                 {grouped(board.cycles)},
                 {grouped(board.device_cycles)},
                 {fmt::format("{:.0f}", board.microseconds())},
                 {fmt::format("{:.0f}", board.slack_us())},
                 {period_bar(board.microseconds(), longest_us), false}});
    }
  }
  return table.html();
}

std::string list_of(const std::vector<Finding>& findings) {
  std::string html;
  for (const Finding& finding : findings)
    html += fmt::format("<li class={}>{}</li>\n", finding.is_failure ? "not" : "note", escaped(finding.text));
  return html.empty() ? "<p>Everything that must hold does.</p>" : "<ul>" + html + "</ul>";
}

std::string section_of(const ProfileTiming& timing) {
  const std::optional<Cycles>& static_predictor = timing.figures.predicted_cycles;
  const std::string predicted =
      static_predictor
          ? fmt::format(", {} if backward branches are predicted as taken", grouped(*static_predictor))
          : "";
  std::string html =
      fmt::format("<h2>{} on {}</h2><p>At most {} cycles{}: {}.</p>", timing.name, timing.row.core,
                  grouped(timing.figures.cycles), predicted, escaped(timing.figures.model));
  html += tables_of_path(timing.figures);
  if (timing.formula) {
    html +=
        "<h3>Formula</h3>" + table_of_formula(*timing.formula, static_cast<double>(timing.figures.cycles)) +
        fmt::format(
            "<p class=note>With all quantities at 3/4 and 5/4 it is within {:.2f} % of the bound that the "
            "analyser gives then.</p>",
            100 * timing.formula_error);
  }
  return html + tables_of_memory(timing.figures);
}

}  // namespace

std::string make_page(const std::vector<ProfileTiming>& timings, const std::vector<Finding>& findings) {
  std::string html = kHead;
  html +=
      "<h1>Worst-case timing</h1><p>Bounds hold for every state and input of a tick, from the interrupt's "
      "entry to "
      "its exit; what was observed is the most that a search saw in QEMU. Bytes and cycles are of the linked "
      "images.</p>";
  html += table_of_profiles(timings) + table_of_boards(timings);
  html += fmt::format("<p class=note>{}</p><h3>What is required</h3>{}", kCaveat, list_of(findings));
  for (const ProfileTiming& timing : timings) html += section_of(timing);
  return html + "</body></html>\n";
}

}  // namespace palpate::wcet::timing
