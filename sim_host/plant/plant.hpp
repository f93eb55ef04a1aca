// A PHANToM Premium 1.5 with its amplifiers, motors and encoders, and a hand on it: motor codes in, encoder
// counts out, a tick of 1 ms at a time. Only the caller's ticks pass time. The same parameters and inputs
// give the same bits in each run on one machine.
//
// A tick: the input holds from its start to its end, the output is read at its end. So what a controller
// computes from one output acts from the next tick's start on: a controller that answers each output before
// the next step has no delay in ticks but the hold.
#pragma once

#include <optional>
#include <utility>

#include "plant/amplifier.hpp"
#include "plant/arm_dynamics.hpp"
#include "plant/hand.hpp"
#include "plant/motor_thermal.hpp"

namespace palpate::plant {

using PlantInput = AmplifierInput;

struct PlantOutput {
  uint32_t tick;                          ///< ticks that have passed
  std::array<int16_t, 3> encoder_counts;  ///< the 16-bit counters, joint order, see encoders.hpp
  std::array<uint16_t, 3> gimbal_adc;     ///< 12 bits; a placeholder: the gimbal rests at 2048
  uint16_t buttons;                       ///< one bit each, as hal/ports' read_buttons
  bool amplifiers_cut;                    ///< enabled, but their watchdog has cut them
};

/// What no controller sees. SI and deg C, in the device's frame.
struct PlantTruth {
  ArmState arm;
  Eigen::Vector3d tip, tip_velocity;
  Eigen::Vector3d hand_force;  ///< on the tip, its mass included
  Eigen::Vector3d currents;
  Eigen::Vector3d torques;  ///< of the motors, at the joints
  std::array<MotorTemperatures, 3> temperatures;
  std::array<bool, 3> is_too_hot;  ///< a winding above its limit
  std::array<bool, 3> is_driven;   ///< the amplifier is on
};

inline constexpr double kTickSeconds = 1e-3;

struct PlantParameters {
  ArmParameters arm;
  AmplifierParameters amplifiers;
  WindingParameters winding;
  ThermalParameters thermal;
  int substeps = 10;                                          ///< a tick: 10 kHz
  Eigen::Vector3d start_q = Eigen::Vector3d::Zero();          ///< rad
  Eigen::Vector3d encoder_reset_q = Eigen::Vector3d::Zero();  ///< where the counters were zeroed, rad
};

class Plant {
 public:
  /// Without a hand the tip is free. Throws std::invalid_argument when there is no substep.
  explicit Plant(const PlantParameters& parameters, std::optional<Hand> hand = std::nullopt);

  PlantOutput step(const PlantInput& input);

  /// From now on another hand holds the handle, or none does.
  void hand_over(std::optional<Hand> hand) { hand_ = std::move(hand); }

  /// The last output again; before the first step, what a controller reads at power on.
  [[nodiscard]] PlantOutput output() const;
  [[nodiscard]] PlantTruth truth() const;
  [[nodiscard]] double seconds() const { return tick_ * kTickSeconds; }

  /// What whoever runs it should say, once: unverified and assumed figures that it uses.
  [[nodiscard]] std::vector<Figure> doubtful_figures() const;

 private:
  void advance_substep(double time);
  [[nodiscard]] TipLoad load(double time) const;

  PlantParameters parameters_;
  ArmDynamics dynamics_;
  Amplifiers amplifiers_;
  std::optional<Hand> hand_;
  uint32_t tick_ = 0;
  ArmState arm_;
  Eigen::Vector3d currents_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d torques_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d square_current_sums_ = Eigen::Vector3d::Zero();  // of the substeps of a tick
  std::array<MotorTemperatures, 3> temperatures_;
};

}  // namespace palpate::plant
