#include "bent_bar.hpp"

#include <stdexcept>

namespace palpate::bench {
namespace {

constexpr int kPullTicks = 200;

/// The corner of the free end in the body's file frame.
std::array<double, 3> corner_mm(const sim::ModelParameters& parameters) {
  const double edge_mm = parameters.edge_m * 1e3;
  return {edge_mm, edge_mm, 3.0 * edge_mm};
}

}  // namespace

sim::ModelParameters bar_parameters(int substeps) {
  sim::ModelParameters parameters;
  parameters.level = 6;
  parameters.regions[0].density_kg_m3 = 1000.0;
  parameters.substeps = substeps;
  return parameters;
}

Vector3<Position> pulled_tool(const sim::ModelParameters& parameters) {
  std::array<double, 3> mm = corner_mm(parameters);
  mm[0] += 50.0;
  return sim::from_mm(mm, parameters);
}

TickInput pulling_input(const sim::ModelParameters& parameters) {
  return TickInput{pulled_tool(parameters), true, {RigidMotion::identity(), RigidMotion::identity()}};
}

std::unique_ptr<State<Profile>> make_bent_bar(int substeps) {
  const sim::ModelParameters parameters = bar_parameters(substeps);
  auto state = std::make_unique<State<Profile>>();
  if (start(*state, sim::compile_model(parameters)) != Status::kDone) {
    throw std::runtime_error("the bar does not fit its profile");
  }
  TickInput input = pulling_input(parameters);
  TickOutput output{};
  NoProbe probe;
  for (int i = 0; i <= kPullTicks; ++i) {
    std::array<double, 3> mm = corner_mm(parameters);
    mm[0] += 50.0 * i / kPullTicks;
    input.tool = sim::from_mm(mm, parameters);
    tick(*state, input, output, probe);
  }
  return state;
}

NsPerTet::NsPerTet(benchmark::State& state, uint32_t tets_an_iteration)
    : state_(state), tets_an_iteration_(tets_an_iteration), begin_(std::clock()) {}

NsPerTet::~NsPerTet() {
  const double elapsed_ns = 1e9 * static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC;
  const double tets = static_cast<double>(state_.iterations()) * tets_an_iteration_;
  state_.counters["ns_per_tet"] = elapsed_ns / tets;
}

}  // namespace palpate::bench
