// What a run of the host-speed program found, as a table, JSON, CSV and a chart.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "contest.hpp"
#include "output/chart.hpp"

namespace palpate::bench {

enum class Work : uint8_t { kForces, kTick };

/// A line of the table.
struct Row {
  std::string who;
  Work work;
  std::string integrator;  // empty: none takes part
  double density_kg_m3;
  uint32_t substeps;
  uint32_t tets;
  double rotations;  // extracted in an evaluation; the mean of the timed ticks
  Figure us{};       // of one evaluation or one tick
  /// | f - exact | / | exact | over all nodes, exact: full corotation in doubles with nodes at the same
  /// places
  double force_error = 0.0;
  /// Of the node that is farthest from its place in the core's body with full corotation, after all ticks.
  std::optional<double> distance_mm;

  [[nodiscard]] Figure ns_per_tet() const;
};

struct Goal {
  std::string what;
  double wanted;
  std::optional<Figure> ratio;  // nothing: not measured, for want of a peer

  [[nodiscard]] bool is_met() const { return ratio && ratio->median >= wanted; }
};

/// A tick and an evaluation at one size of mesh, us.
struct Cost {
  uint32_t tets;
  uint32_t nodes;
  double adaptive_rotations;
  Figure full_tick, adaptive_tick, full_forces;
  std::optional<Figure> peer_forces, peer_step;
};

struct Report {
  std::string processor, compiler, flags;
  std::optional<std::string> peer;
  uint32_t rounds;
  bool same_bits;  // of the core compiled for this processor
  std::vector<Row> rows;
  std::vector<Goal> goals;
  std::vector<Cost> costs;
};

std::string report_text(const Report& report);
nlohmann::ordered_json report_json(const Report& report);
std::string cost_csv(const Report& report);
sim::Chart cost_chart(const Report& report, const std::string& file);

}  // namespace palpate::bench
