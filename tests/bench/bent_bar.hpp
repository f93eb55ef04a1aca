// The bar of all benchmarks: 1152 leaves (three cubes at level 6), a node of its free end pulled aside by 50
// mm, so that the tets are rotated and strained as in use.
#pragma once

#include <benchmark/benchmark.h>

#include <ctime>
#include <memory>

#include "model_parameters.hpp"
#include "palpate/tick/profiles.hpp"
#include "palpate/tick/tick.hpp"

namespace palpate::bench {

using Profile = CuboidPaper;

/// The bar with so many substeps; its density makes one substep stable too.
sim::ModelParameters bar_parameters(int substeps);

/// Where the tool holds the bent bar.
Vector3<Position> pulled_tool(const sim::ModelParameters& parameters);
TickInput pulling_input(const sim::ModelParameters& parameters);

/// Started, grasped and pulled.
std::unique_ptr<State<Profile>> make_bent_bar(int substeps);

/// Made right before a benchmark's loop, adds the counter ns_per_tet at its end: the time of an iteration
/// over the tets that it goes through. The library's own rates would read in seconds.
class NsPerTet {
 public:
  NsPerTet(benchmark::State& state, uint32_t tets_an_iteration);
  ~NsPerTet();
  NsPerTet(const NsPerTet&) = delete;
  NsPerTet& operator=(const NsPerTet&) = delete;
  NsPerTet(NsPerTet&&) = delete;
  NsPerTet& operator=(NsPerTet&&) = delete;

 private:
  benchmark::State& state_;
  uint32_t tets_an_iteration_;
  std::clock_t begin_;
};

}  // namespace palpate::bench
