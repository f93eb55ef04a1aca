#include "plant/plant.hpp"

#include <stdexcept>
#include <utility>

#include "plant/encoders.hpp"

namespace palpate::plant {
namespace {

constexpr uint16_t kGimbalMiddle = 2048;

/// Motor turns in its positive direction for a turn of the joint: s_i eta_i.
double motor_ratio(std::size_t axis) {
  const phantom::DriveRatings& ratings = phantom::premium::kDriveRatings;
  return ratings.direction[axis] * ratings.capstan_ratio_milli[axis] / 1000.0;
}

}  // namespace

Plant::Plant(const PlantParameters& parameters, std::optional<Hand> hand)
    : parameters_(parameters),
      dynamics_(parameters.arm),
      amplifiers_(parameters.amplifiers),
      hand_(std::move(hand)),
      arm_{parameters.start_q, Eigen::Vector3d::Zero()} {
  if (parameters.substeps < 1) throw std::invalid_argument("a tick has at least one substep");
  temperatures_.fill({parameters.thermal.ambient, parameters.thermal.ambient});
}

TipLoad Plant::load(double time) const { return hand_ ? hand_->load(time) : TipLoad{}; }

void Plant::advance_substep(double time) {
  const double substep = kTickSeconds / parameters_.substeps;
  const WindingParameters& winding = parameters_.winding;
  for (Eigen::Index joint = 0; joint < 3; ++joint) {
    const auto axis = static_cast<std::size_t>(joint);
    const double motor_speed = motor_ratio(axis) * arm_.rates[joint];
    const WindingDrive drive{amplifiers_.is_on(axis), amplifiers_.target_current(axis),
                             winding.torque_constant * motor_speed,
                             winding.resistance(temperatures_[axis].winding)};
    const WindingStep moved = advance_winding(winding, drive, currents_[joint], substep);
    currents_[joint] = moved.current;
    square_current_sums_[joint] += moved.mean_square;
    torques_[joint] = motor_ratio(axis) * winding.torque_constant * moved.mean;
  }
  arm_ = dynamics_.advance(arm_, torques_, load(time), substep);
}

PlantOutput Plant::step(const PlantInput& input) {
  amplifiers_.receive(input);
  if (hand_) hand_->begin_tick(kTickSeconds);
  square_current_sums_.setZero();
  const double start = seconds();
  for (int i = 0; i < parameters_.substeps; ++i) {
    advance_substep(start + i * kTickSeconds / parameters_.substeps);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double mean_square = square_current_sums_[static_cast<Eigen::Index>(axis)] / parameters_.substeps;
    temperatures_[axis] = advance_temperatures(parameters_.thermal, parameters_.winding, temperatures_[axis],
                                               mean_square, kTickSeconds);
  }
  ++tick_;
  return output();
}

PlantOutput Plant::output() const {
  const Eigen::Vector3d counts = encoder_counts(premium::kEncoders, arm_.q, parameters_.encoder_reset_q);
  return {tick_,
          read_counters(counts),
          {kGimbalMiddle, kGimbalMiddle, kGimbalMiddle},
          hand_ ? hand_->buttons(seconds()) : uint16_t{0},
          amplifiers_.is_cut()};
}

PlantTruth Plant::truth() const {
  PlantTruth truth{arm_,
                   premium::tool_position(arm_.q),
                   premium::jacobian(arm_.q) * arm_.rates,
                   dynamics_.tip_force(arm_, torques_, load(seconds())),
                   currents_,
                   torques_,
                   temperatures_,
                   {},
                   {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    truth.is_too_hot[axis] = temperatures_[axis].winding > parameters_.thermal.winding_limit;
    truth.is_driven[axis] = amplifiers_.is_on(axis);
  }
  return truth;
}

std::vector<Figure> Plant::doubtful_figures() const {
  std::vector<FigureInUse> used = {
      {kViscousFriction, parameters_.arm.friction.viscous},
      {kCoulombFriction, parameters_.arm.friction.coulomb},
      {kFullScaleCurrent, parameters_.amplifiers.full_scale},
      {kCurrentLimit, parameters_.amplifiers.current_limit},
      {kWatchdogTicks, static_cast<double>(parameters_.amplifiers.watchdog_ticks)},
      {kSupplyVoltage, parameters_.winding.supply_voltage}};
  if (hand_) {
    used.push_back({kHandMass, hand_->parameters().mass});
    used.push_back({kHandStiffness, hand_->parameters().stiffness});
    used.push_back({kHandDamping, hand_->parameters().damping});
  }
  return doubtful(used);
}

}  // namespace palpate::plant
