// Experiment 2 with the double-precision reference: the models that the paper compares with.
#pragma once

#include "output/chart.hpp"
#include "reference/elastic_model.hpp"
#include "scenario/scenario.hpp"
#include "simulation/body_fields.hpp"

namespace palpate::sim {

struct ModelTrace {
  std::vector<std::array<double, 3>> force_n;  // a tick
  ChartPoints end_mm;                          // as of a Trace
  BodyFields farthest;                         // at the last peak of the node's displacement; no stress
};

/// A cuboid-sine at a fixed level, stepped as explicitly as the core does it: the same substeps and damping.
/// Linear and St. Venant-Kirchhoff elasticity have no rotations, so nothing lags in them.
ModelTrace trace_model(const Scenario& scenario, reference::ElasticModel model);

}  // namespace palpate::sim
