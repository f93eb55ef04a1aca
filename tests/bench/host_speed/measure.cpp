#include "measure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "field.hpp"

namespace palpate::bench {
namespace {

using Entrant = Field::Entrant;

constexpr double kAdaptiveDeg = 4.1;
constexpr double kHeavy = 1000.0;  // kg/m3: tissue, stable in one substep
constexpr double kLight = 10.0;    // the paper's
constexpr const char* kNative = "Palpate, the same, native";

std::string name_of(double theta_deg) {
  return theta_deg == BarSetup::kFullCorotation ? "Palpate, full corotation"
                                                : fmt::format("Palpate, theta {:.3g} deg", theta_deg);
}

Field::Bar twisted(const BarSetup& setup, MakeBar make = make_bar) {
  auto bar = std::make_shared<TwistedBar>(setup, make);
  bar->twist();
  return bar;
}

/// Of one density.
struct Bars {
  std::vector<Field::Bar> grouped;  // a threshold each
  Field::Bar full, native;
};

Bars twist_all(const std::vector<double>& thetas_deg, double density_kg_m3, int substeps) {
  BarSetup setup;
  setup.substeps = substeps;
  setup.density_kg_m3 = density_kg_m3;
  Bars bars;
  bars.full = twisted(setup);
  bars.native = twisted(setup, make_native_bar);
  for (const double theta_deg : thetas_deg) {
    setup.theta_deg = theta_deg;
    bars.grouped.push_back(twisted(setup));
  }
  return bars;
}

struct Entrants {
  std::vector<Entrant> grouped;
  std::vector<Entrant> full;  // by each build of the core
  std::optional<Entrant> peer;
};

Entrants add_forces(Field& field, const Bars& bars) {
  Entrants entrants;
  for (const Field::Bar& bar : bars.grouped) {
    entrants.grouped.push_back(field.add_forces(name_of(bar->setup().theta_deg), bar));
  }
  entrants.full = {field.add_forces(name_of(bars.full->setup().theta_deg), bars.full),
                   field.add_forces(kNative, bars.native)};
  if (const auto peer = peer_name()) {
    entrants.peer = field.add_peer_forces(*peer, bars.full, bars.full->bar().motion().force_position);
    // What its rotations cost depends on how far they are from none.
    reference::Positions hardly_moved = bars.full->bar().mesh().rest;
    for (reference::Vector& x : hardly_moved) x[2] *= 1.001;
    field.add_peer_forces(*peer + ", not twisted", bars.full, hardly_moved);
  }
  return entrants;
}

Entrants add_ticks(Field& field, const Bars& bars) {
  Entrants entrants;
  for (const Field::Bar& bar : bars.grouped) {
    entrants.grouped.push_back(field.add_ticks(name_of(bar->setup().theta_deg), bar, bars.full));
  }
  entrants.full = {field.add_ticks(name_of(bars.full->setup().theta_deg), bars.full, bars.full),
                   field.add_ticks(kNative, bars.native, bars.full)};
  if (const auto peer = peer_name()) {
    entrants.peer = field.add_peer_ticks(*peer, bars.full, PeerMode::kImplicit);
  }
  return entrants;
}

/// How many times faster than the peer the faster of the core's builds is.
std::optional<Figure> ratio_to_peer(const Field& field, const Entrants& entrants) {
  if (!entrants.peer) return std::nullopt;
  Figure best{};
  for (const Entrant entrant : entrants.full) {
    const Figure ratio = field.speed_ratio(entrant, *entrants.peer);
    if (ratio.median > best.median) best = ratio;
  }
  return best;
}

bool same_bits(const Bars& bars) { return bars.full->bar().hash() == bars.native->bar().hash(); }

Cost cost_of(int level, uint32_t rounds) {
  BarSetup setup;
  setup.level = level;
  const Field::Bar full = twisted(setup);
  setup.theta_deg = kAdaptiveDeg;
  const Field::Bar adaptive = twisted(setup);
  Field field;
  const Entrant full_tick = field.add_ticks("full", full, full);
  const Entrant adaptive_tick = field.add_ticks("adaptive", adaptive, full);
  const Entrant full_forces = field.add_forces("full", full);
  std::optional<Entrant> peer_forces, peer_step;
  if (const auto peer = peer_name()) {
    peer_forces = field.add_peer_forces(*peer, full, full->bar().motion().force_position);
    peer_step = field.add_peer_ticks(*peer, full, PeerMode::kImplicit);
  }
  field.race(rounds);
  const auto us = [&field](std::optional<Entrant> entrant) {
    return entrant ? std::optional(field.row(*entrant).us) : std::nullopt;
  };
  return Cost{field.row(full_tick).tets,
              static_cast<uint32_t>(full->bar().mesh().rest.size()),
              field.row(adaptive_tick).rotations,
              field.row(full_tick).us,
              field.row(adaptive_tick).us,
              field.row(full_forces).us,
              us(peer_forces),
              us(peer_step)};
}

}  // namespace

void measure_bar(uint32_t rounds, const Show& show, Report& report) {
  show("looking for the threshold of 300 rotations");
  const std::vector<double> thetas_deg = {theta_for(18), kAdaptiveDeg, theta_for(300)};
  constexpr std::size_t kAdaptive = 1;
  show("twisting the bars of 1152 tets");
  const Bars heavy = twist_all(thetas_deg, kHeavy, 1);
  const Bars light = twist_all(thetas_deg, kLight, 4);
  Field field;
  const Entrants forces = add_forces(field, heavy);
  const Entrants ticks = add_ticks(field, heavy);
  if (const auto peer = peer_name()) {
    field.add_peer_ticks(*peer, heavy.full, PeerMode::kImplicitMultipliers);
    // At rho = 10 a step of 1 ms is too long for it.
    field.add_peer_ticks(*peer, heavy.full, PeerMode::kExplicit);
  }
  add_ticks(field, light);
  show("timing them against each other");
  field.race(rounds);

  report.rows = field.rows();
  report.same_bits = same_bits(heavy) && same_bits(light);
  report.goals = {{"forces with one exact rotation a tet, than Bullet's", 4.0, ratio_to_peer(field, forces)},
                  {"tick with full corotation at rho 1000, than Bullet's implicit step", 25.0,
                   ratio_to_peer(field, ticks)},
                  {"tick at theta 4.1 deg, than with full corotation", 2.0,
                   field.speed_ratio(ticks.grouped.at(kAdaptive), ticks.full.front())}};
}

void measure_sizes(uint32_t rounds, const Show& show, Report& report) {
  constexpr int kCoarsest = 4;
  constexpr int kFinest = 9;
  for (int level = kCoarsest; level <= kFinest; ++level) {
    show(fmt::format("timing level {}, until level {}", level, kFinest));
    report.costs.push_back(cost_of(level, rounds));
  }
}

}  // namespace palpate::bench
