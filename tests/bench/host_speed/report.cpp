#include "report.hpp"

#include <fmt/format.h>

namespace palpate::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kNoPeer = "Bullet was not there when this was built: install libbullet-dev";

Json figure_json(const Figure& figure) {
  return Json{{"median", figure.median}, {"low_quartile", figure.low}, {"high_quartile", figure.high}};
}

template <class Value, class Convert>
Json json_or_null(const std::optional<Value>& value, Convert&& convert) {
  return value ? Json(convert(*value)) : Json(nullptr);
}

const char* name_of(Work work) { return work == Work::kForces ? "forces" : "tick"; }

Json row_json(const Row& row) {
  return Json{{"work", name_of(row.work)},
              {"who", row.who},
              {"integrator", row.integrator},
              {"density_kg_m3", row.density_kg_m3},
              {"substeps", row.substeps},
              {"tets", row.tets},
              {"rotations", row.rotations},
              {"us", figure_json(row.us)},
              {"ns_per_tet", figure_json(row.ns_per_tet())},
              {"force_error", row.force_error},
              {"distance_mm", json_or_null(row.distance_mm, [](double mm) { return mm; })}};
}

Json goal_json(const Goal& goal) {
  return Json{{"what", goal.what},
              {"wanted", goal.wanted},
              {"ratio", json_or_null(goal.ratio, figure_json)},
              {"is_met", json_or_null(goal.ratio, [&goal](const Figure&) { return goal.is_met(); })}};
}

Json cost_json(const Cost& cost) {
  return Json{{"tets", cost.tets},
              {"nodes", cost.nodes},
              {"adaptive_rotations", cost.adaptive_rotations},
              {"full_tick_us", figure_json(cost.full_tick)},
              {"adaptive_tick_us", figure_json(cost.adaptive_tick)},
              {"full_forces_us", figure_json(cost.full_forces)},
              {"peer_forces_us", json_or_null(cost.peer_forces, figure_json)},
              {"peer_step_us", json_or_null(cost.peer_step, figure_json)}};
}

std::string row_text(const Row& row) {
  const Figure ns = row.ns_per_tet();
  const bool is_tick = row.work == Work::kTick;
  return fmt::format("  {:<26} {:>9.0f} {:>8} {:>5} {:>8.1f} {:>7.1f}  {:<18} {:>8.2f} % {:>6}  {}\n",
                     row.who, row.rotations, is_tick ? fmt::format("{}", row.substeps) : "-",
                     is_tick ? fmt::format("{:.0f}", row.density_kg_m3) : "-", row.us.median, ns.median,
                     fmt::format("({:.1f} .. {:.1f})", ns.low, ns.high), 100.0 * row.force_error,
                     row.distance_mm ? fmt::format("{:.2f}", *row.distance_mm) : "-", row.integrator);
}

std::string rows_text(const Report& report, Work work, const char* title) {
  std::string text = fmt::format("\n{:<28} {:>9} {:>8} {:>5} {:>8} {:>7}  {:<18} {:>10} {:>6}  {}\n", title,
                                 "rotations", "substeps", "rho", "us", "ns/tet", "(quartiles)", "force err.",
                                 "off mm", work == Work::kTick ? "integrator" : "");
  for (const Row& row : report.rows) {
    if (row.work == work) text += row_text(row);
  }
  return text;
}

std::string goal_text(const Goal& goal) {
  const std::string wanted = fmt::format("  {:<72} goal {:>4.0f}  ", goal.what, goal.wanted);
  if (!goal.ratio) return wanted + "not measured\n";
  return wanted + fmt::format("{:>6.2f} ({:.2f} .. {:.2f})  {}\n", goal.ratio->median, goal.ratio->low,
                              goal.ratio->high, goal.is_met() ? "met" : "not met");
}

/// The medians of a cost, in the order of kCostColumns.
std::vector<std::optional<double>> cost_medians(const Cost& cost) {
  const auto median = [](const Figure& figure) { return figure.median; };
  const auto of_peer = [&median](const std::optional<Figure>& figure) {
    return figure ? std::optional(median(*figure)) : std::nullopt;
  };
  return {median(cost.full_tick), median(cost.adaptive_tick), median(cost.full_forces),
          of_peer(cost.peer_step), of_peer(cost.peer_forces)};
}

struct CostColumn {
  const char* csv;
  const char* title;
};
constexpr std::array<CostColumn, 5> kCostColumns = {{{"full_tick_us", "tick, full corotation"},
                                                     {"adaptive_tick_us", "tick, theta 4.1 deg"},
                                                     {"full_forces_us", "forces, full corotation"},
                                                     {"bullet_step_us", "Bullet, implicit step"},
                                                     {"bullet_forces_us", "Bullet, forces"}}};

std::string costs_text(const Report& report) {
  std::string text = fmt::format("\n{:<28}", "us by size, rho 1000");
  for (const CostColumn& column : kCostColumns) text += fmt::format(" {:>24}", column.title);
  text += "\n";
  for (const Cost& cost : report.costs) {
    text += fmt::format("  {:<26}", fmt::format("{} tets, {} nodes", cost.tets, cost.nodes));
    for (const auto& us : cost_medians(cost))
      text += fmt::format(" {:>24}", us ? fmt::format("{:.1f}", *us) : "-");
    text += "\n";
  }
  return text;
}

}  // namespace

Figure Row::ns_per_tet() const {
  const double scale = 1e3 / tets;
  return Figure{us.median * scale, us.low * scale, us.high * scale};
}

std::string report_text(const Report& report) {
  std::string text = fmt::format(
      "{}, {}, {}; {}\nprocessor time: medians (quartiles) of {} rounds, all in turn\n", report.processor,
      report.compiler, report.flags, report.peer.value_or(kNoPeer), report.rounds);
  text += rows_text(report, Work::kForces, "forces, with rotations");
  text += rows_text(report, Work::kTick, "a tick of 1 ms");
  text += costs_text(report);
  text += "\nhow many times faster\n";
  for (const Goal& goal : report.goals) text += goal_text(goal);
  text += fmt::format("\nthe core with -O3 -march=native makes {} bits\n",
                      report.same_bits ? "the same" : "OTHER");
  return text;
}

nlohmann::ordered_json report_json(const Report& report) {
  Json json{{"processor", report.processor},
            {"compiler", report.compiler},
            {"flags", report.flags},
            {"peer", json_or_null(report.peer, [](const std::string& name) { return name; })},
            {"rounds", report.rounds},
            {"same_bits", report.same_bits},
            {"rows", Json::array()},
            {"goals", Json::array()},
            {"costs", Json::array()}};
  for (const Row& row : report.rows) json["rows"].push_back(row_json(row));
  for (const Goal& goal : report.goals) json["goals"].push_back(goal_json(goal));
  for (const Cost& cost : report.costs) json["costs"].push_back(cost_json(cost));
  return json;
}

std::string cost_csv(const Report& report) {
  std::string text = "tets,nodes,adaptive_rotations";
  for (const CostColumn& column : kCostColumns) text += fmt::format(",{}", column.csv);
  text += "\n";
  for (const Cost& cost : report.costs) {
    text += fmt::format("{},{},{:.1f}", cost.tets, cost.nodes, cost.adaptive_rotations);
    for (const auto& us : cost_medians(cost)) text += us ? fmt::format(",{:.2f}", *us) : ",";
    text += "\n";
  }
  return text;
}

sim::Chart cost_chart(const Report& report, const std::string& file) {
  // Sizes double: a step of the axis each.
  sim::Chart chart{file, {"tets"}, {"processor time, µs", true}, {}};
  for (const Cost& cost : report.costs) chart.x.names.push_back(fmt::format("{}", cost.tets));
  for (std::size_t column = 0; column < kCostColumns.size(); ++column) {
    sim::ChartPoints points;
    for (std::size_t i = 0; i < report.costs.size(); ++i) {
      const auto us = cost_medians(report.costs[i])[column];
      if (us) points.push_back({static_cast<double>(i), *us});
    }
    if (points.empty()) continue;
    chart.series.push_back({kCostColumns.at(column).title, points, sim::SeriesStyle::kLineAndPoints});
  }
  return chart;
}

}  // namespace palpate::bench
