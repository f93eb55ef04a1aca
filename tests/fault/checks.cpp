#include "checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/firmware/condition.hpp"
#include "units.hpp"

namespace palpate::fault {
namespace {

using safety::Condition;
using safety::ConditionSet;

std::string names(ConditionSet conditions) {
  std::string text;
  for (uint32_t i = 0; i < safety::kConditionCount; ++i) {
    const auto condition = static_cast<Condition>(i);
    if (conditions.has(condition)) text += std::string(" ") + safety::condition_name(condition);
  }
  return text;
}

/// What the motors would get of the whole force, unlimited, in codes from zero.
std::array<double, 3> full_codes(const Cycle& cycle) {
  const auto torques = phantom::premium::joint_torques(cycle.posture, cycle.force);
  std::array<double, 3> codes{};
  for (std::size_t joint = 0; joint < 3; ++joint) {
    codes[joint] = sim::to_double(phantom::premium::kDrive.codes_per_torque[joint]) *
                   sim::to_double(torques[static_cast<Eigen::Index>(joint)]);
  }
  return codes;
}

}  // namespace

PoolsInUse pools_in_use(const Cycle& cycle) {
  const Forest<Small>& forest = cycle.core.forest;
  return {forest.leaf_count, forest.pairs.used(), forest.nodes.used(), cycle.core.front.groups.used(),
          cycle.core.tethers.count};
}

void Checks::note_new_start() {
  const uint32_t every = look_every_;
  *this = Checks();
  look_every_ = every;
}

std::string Checks::see(const Loop& loop) {
  causes_.see(loop, looks_at_mesh(loop));
  std::string failure = check_conditions(loop);
  if (failure.empty()) failure = check_torque(loop);
  if (failure.empty()) failure = check_codes(loop);
  if (failure.empty()) failure = check_heat_limits(loop.cycle);
  if (failure.empty()) failure = check_body(loop);
  if (failure.empty()) failure = check_watchdog(loop);
  raised_ = loop.cycle.safety.raised;
  return failure.empty() ? failure
                         : fmt::format("tick {}, {}: {}", loop.tick(), state_name(loop.state()), failure);
}

/// Each cause is found in time, and nothing is found without a cause.
std::string Checks::check_conditions(const Loop& loop) {
  const ConditionSet raised = loop.cycle.safety.raised;
  const ConditionSet missed = causes_.due().without(raised);
  if (!missed.is_empty()) return "not raised in time:" + names(missed);
  const ConditionSet kept = raised_ & safety::kUntilNewStart;
  const ConditionSet invented = raised.without(causes_.possible() | kept);
  if (!invented.is_empty()) return "raised without a cause:" + names(invented);
  if (!kept.without(raised).is_empty()) return "cleared without a new start:" + names(kept);
  note_detection(raised);
  return {};
}

void Checks::note_detection(ConditionSet raised) {
  for (uint32_t i = 0; i < safety::kConditionCount; ++i) {
    const auto condition = static_cast<Condition>(i);
    if (!raised.has(condition) || raised_.has(condition)) continue;
    const uint32_t ticks = causes_.ticks_of(condition);
    detected_in_[i] = std::max(detected_in_[i], ticks);
    if ((safety::kFaults | safety::kDrops).has(condition)) zero_torque_in_ = std::max(zero_torque_in_, ticks);
  }
}

/// Exactly zero where it must be, and then never above the ramp's line.
std::string Checks::check_torque(const Loop& loop) {
  const safety::Safety& safety = loop.cycle.safety;
  const bool is_fault = safety.raised.overlaps(safety::kFaults) || loop.cycle.fault != firmware::Fault::kNone;
  if (is_fault && safety.state != safety::State::kFault)
    return "a fault is raised, and the state is not Fault";
  const bool must_be_zero =
      is_fault || !is_torque_allowed(safety.state) || safety.raised.overlaps(safety::kDrops);
  if (must_be_zero) {
    line_ = 0;
    free_ticks_ = 0;
    if (loop.has_torque()) return "torque, where there must be none";
    return loop.cycle.fault != firmware::Fault::kNone || safety.ramp.gain == safety::kNoForce
               ? ""
               : "gain without torque";
  }
  note_free_tick(loop.cycle);
  if (free_ticks_ == safety.parameters.ramp.free_ticks) {
    line_ = std::min<int64_t>(line_ + safety.parameters.ramp.step_per_tick.raw(), safety::kFullForce.raw());
  }
  const int64_t gain = safety.ramp.gain.raw();
  if (gain > line_) return fmt::format("a gain of {} is above the ramp's line, {}", gain, line_);
  if (safety.state == safety::State::kActive && gain != safety::kFullForce.raw())
    return "active below the whole force";
  if (!loop.given.amplifiers_enabled) return "amplifiers off, where torque is allowed";
  return {};
}

/// Before the line rises the hand must be free for some ticks in a row; after that no more.
void Checks::note_free_tick(const Cycle& cycle) {
  const safety::RampParameters& ramp = cycle.safety.parameters.ramp;
  if (free_ticks_ == ramp.free_ticks) return;
  const Eigen::Vector3d newtons(sim::to_doubles(cycle.force).data());
  free_ticks_ = newtons.norm() < sim::to_double(ramp.contact_newtons) + 1e-7 ? free_ticks_ + 1 : 0;
}

std::string Checks::check_codes(const Loop& loop) const {
  const double gain = sim::to_double(loop.cycle.safety.ramp.gain);
  const std::array<double, 3> full = full_codes(loop.cycle);
  for (std::size_t joint = 0; joint < 3; ++joint) {
    const double code = loop.given.motor_codes[joint] - 2048.0;
    const double amperes = std::abs(code) * 5.5 / 2047.0;
    const bool is_within_gain = std::abs(code) <= gain * std::abs(full[joint]) + 1.0;
    const bool is_same_way = std::abs(code) <= 1.0 || code * full[joint] > 0.0;
    if (!is_within_gain || !is_same_way) {
      return fmt::format("motor {} has code {} from zero, of {:.1f} at a gain of {:.4f}", joint + 1, code,
                         full[joint], gain);
    }
    if (amperes > 1.24 + 5.5 / 2047.0) return fmt::format("motor {} has {:.3f} A", joint + 1, amperes);
  }
  return {};
}

/// The limit of a warm motor falls, down to what it stands for ever, and rises no faster than its line.
std::string Checks::check_heat_limits(const Cycle& cycle) {
  const safety::ThermalLimits& thermal = cycle.safety.parameters.thermal;
  constexpr double kLsb = 1e-8;
  if (cycle.fault != firmware::Fault::kNone) return {};
  for (std::size_t i = 0; i < 3; ++i) {
    const safety::WarmMotor& motor = cycle.safety.motors.motors[i];
    const double before = sim::to_double(limits_[i]);
    const double now = sim::to_double(motor.current_limit);
    const double least = sim::to_double(thermal.continuous_amperes);
    const bool is_warm = safety::celsius(motor.temperatures.winding) > thermal.warm;
    const double most =
        is_warm ? std::max(least, 0.999 * before) : before + sim::to_double(thermal.rise_amperes_per_tick);
    if (now > most + kLsb || now < least)
      return fmt::format("motor {}'s limit goes from {} to {} A", i + 1, before, now);
    limits_[i] = motor.current_limit;
  }
  return {};
}

std::string Checks::check_body(const Loop& loop) {
  const Cycle& cycle = loop.cycle;
  const plant::PlantTruth truth = loop.plant.truth();
  if (!truth.arm.q.allFinite() || truth.arm.q.cwiseAbs().maxCoeff() > 4.0) return "the arm is nowhere";
  const Forest<Small>& forest = cycle.core.forest;
  for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
    const Vector3<Position>& x = forest.node.position[forest.nodes.live(i)];
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (abs(x[axis]) > kPositionLimit) return "a node is beyond its limit";
    }
  }
  const ClampCounters& clamps = cycle.core.clamps;
  const bool is_clamped =
      clamps.speed != clamps_.speed || clamps.position != clamps_.position || clamps.strain != clamps_.strain;
  clamps_ = clamps;
  if (is_clamped && !may_clamp_) return "a speed, position or strain was clamped";
  if (may_be_broken_ || !looks_at_mesh(loop)) return {};
  const firmware::Integrity integrity = check_integrity(cycle);
  if (integrity.is_whole()) return {};
  return fmt::format("the state is not whole: mesh {}, front {}, tethers {}",
                     static_cast<int>(integrity.mesh), static_cast<int>(integrity.front),
                     integrity.tethers_hold);
}

/// Cycles that are late, and edges that are lost, let the amplifiers' watchdog bite.
std::string Checks::check_watchdog(const Loop& loop) const {
  constexpr uint32_t kWatchdogTicks = 4;
  if (loop.now.is_late && loop.ticks_unfed == 0) return "a late cycle has fed the watchdogs";
  const auto is_driven = loop.plant.truth().is_driven;
  const bool is_any = is_driven[0] || is_driven[1] || is_driven[2];
  const bool may_drive = loop.given.amplifiers_enabled && loop.ticks_unfed < kWatchdogTicks;
  return is_any == may_drive
             ? ""
             : fmt::format("the amplifiers drive: {}, fed {} ticks ago", is_any, loop.ticks_unfed);
}

}  // namespace palpate::fault
