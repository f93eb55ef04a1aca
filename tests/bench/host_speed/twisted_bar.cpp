#include "twisted_bar.hpp"

#include <algorithm>
#include <cmath>

#include "plant/smooth_step.hpp"
#include "simulation/arc.hpp"
#include "units.hpp"

namespace palpate::bench {
namespace {

constexpr uint32_t kTwistTicks = 1000;
constexpr uint32_t kCalmTicks = 500;
constexpr double kTwistDeg = 90.0;
constexpr double kStretch = 0.2;
constexpr double kSwingDeg = 1.0;
constexpr double kSwingsPerTick = 0.002;

sim::ModelParameters parameters_of(const BarSetup& setup) {
  sim::ModelParameters parameters;
  parameters.level = setup.level;
  parameters.regions[0].density_kg_m3 = setup.density_kg_m3;
  parameters.substeps = setup.substeps;
  parameters.held = sim::HeldEnds::kBoth;
  if (setup.theta_deg == BarSetup::kFullCorotation) {
    parameters.remesh.rotation = RotationCriterion::kFull;
  } else {
    parameters.remesh.rotation_split_deg = setup.theta_deg;
  }
  return parameters;
}

double part_of_way(uint32_t tick) {
  return plant::smooth_step(std::min(1.0, static_cast<double>(tick) / kTwistTicks));
}

double twist_deg(uint32_t tick) {
  constexpr double kCircle = 360.0 * sim::kRadians;
  if (tick < kTwistTicks) return kTwistDeg * part_of_way(tick);
  return kTwistDeg + kSwingDeg * std::sin(kCircle * kSwingsPerTick * (tick - kTwistTicks));
}

}  // namespace

RigidMotion end_motion_at(uint32_t tick) {
  sim::Scenario scenario;
  scenario.bend.angle_deg = 0.0;
  scenario.bend.twist_deg = twist_deg(tick);
  RigidMotion motion = sim::end_motion(scenario, 1.0);
  motion.translation[2] += sim::to_fixed<Position>(kStretch * part_of_way(tick) * scenario.model.cubes[2]);
  return motion;
}

TwistedBar::TwistedBar(const BarSetup& setup, MakeBar make)
    : setup_(setup), parameters_(parameters_of(setup)) {
  const Units units{parameters_.edge_m, sim::kTickS / parameters_.substeps,
                    sim::newtons_per_unit(parameters_)};
  bar_ = make(sim::compile_model(parameters_), units);
}

void TwistedBar::tick() {
  ++ticks_;
  bar_->tick(end_motion_at(ticks_));
  rotations_ += bar_->rotations();
}

void TwistedBar::twist() {
  while (ticks_ < kTwistTicks + kCalmTicks) tick();
  twisted_at_ = ticks_;
  rotations_ = 0;
}

double distance_mm(const reference::Positions& a, const reference::Positions& b) {
  double farthest_m = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) farthest_m = std::max(farthest_m, (a[i] - b[i]).norm());
  return farthest_m * 1e3;
}

double TwistedBar::mean_rotations() const {
  const uint32_t counted = ticks_ - twisted_at_;
  return counted == 0 ? bar_->rotations() : static_cast<double>(rotations_) / counted;
}

double theta_for(uint32_t rotations) {
  constexpr int kSteps = 16;
  const auto rotations_at = [](double theta_deg) {
    TwistedBar bar(BarSetup{6, 1, 1000.0, theta_deg});
    bar.twist();
    return bar.bar().rotations();
  };
  const auto misses = [rotations](uint32_t count) {
    return count > rotations ? count - rotations : rotations - count;
  };
  double low_deg = 0.05;
  double high_deg = 60.0;
  double best_deg = high_deg;
  uint32_t best = rotations_at(high_deg);
  for (int i = 0; i < kSteps && best != rotations; ++i) {
    const double middle_deg = std::sqrt(low_deg * high_deg);
    const uint32_t count = rotations_at(middle_deg);
    if (misses(count) < misses(best)) {
      best = count;
      best_deg = middle_deg;
    }
    (count > rotations ? low_deg : high_deg) = middle_deg;
  }
  return best_deg;
}

}  // namespace palpate::bench
