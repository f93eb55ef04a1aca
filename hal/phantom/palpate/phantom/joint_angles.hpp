// Encoder counts to joint angles.
#pragma once

#include "palpate/numeric/trigonometry.hpp"

namespace palpate::phantom {

/// Counts of the three decoders: x4 quadrature, joint 1 first, as the decoder gives them.
using Counts = std::array<int32_t, 3>;

/// q1 turret; q2 and q3 the absolute angles of the two links (a parallelogram drives the second).
struct JointAngles {
  Angle q1, q2, q3;
};

/// Raw units of Angle (2^-32 turn) for one count: below 262144, so at least 16384 counts a joint turn.
using AnglePerCount = Q<18, 13>;

struct Calibration {
  std::array<AnglePerCount, 3> angle_per_count;  ///< its sign is the encoder's direction
  JointAngles at_zero_counts;                    ///< the pose of the calibration
};

/// What a joint's encoder resolves, as integers: the host reads the same figures.
struct EncoderRatings {
  std::array<int32_t, 3> counts_per_joint_turn_milli;  ///< thousandths: 1000 x counts/rev x capstan ratio
  std::array<int32_t, 3> direction;                    ///< +1: counts and angle grow together; -1: reversed
};

/// For compile-time constants.
constexpr Calibration make_calibration(const EncoderRatings& ratings, const JointAngles& at_zero_counts) {
  constexpr int64_t kTurnTimes1000 = (int64_t{1} << 32) * 1000;
  Calibration calibration{{}, at_zero_counts};
  for (std::size_t joint = 0; joint < 3; ++joint) {
    calibration.angle_per_count[joint] = AnglePerCount::ratio(kTurnTimes1000 * ratings.direction[joint],
                                                              ratings.counts_per_joint_turn_milli[joint]);
  }
  return calibration;
}

/// Whether a 16-bit counter holds all three. No joint of these devices leaves that range: outside it, the
/// decoder or the calibration is wrong.
constexpr bool counts_in_range(const Counts& counts) {
  const auto fits = [](int32_t count) { return count >= -32768 && count <= 32767; };
  return fits(counts[0]) && fits(counts[1]) && fits(counts[2]);
}

/// Clamped to what a 16-bit counter holds.
constexpr Counts in_range(const Counts& counts) {
  const auto clamped = [](int32_t count) { return count < -32768 ? -32768 : count > 32767 ? 32767 : count; };
  return {clamped(counts[0]), clamped(counts[1]), clamped(counts[2])};
}

/// From a pose in which the encoders showed `in_pose`: a calibration there needs no reset of the decoders.
/// 16-bit counters differ by less than 2^17.
constexpr Counts counts_since(const Counts& in_pose, const Counts& counts) {
  return {counts[0] - in_pose[0], counts[1] - in_pose[1], counts[2] - in_pose[2]};
}

/// at_zero + counts x angle_per_count, counts clamped to 16 bits. Within 2.5 LSB of Angle (3.7e-9 rad) for
/// any count, of which 2 are the rounding of angle_per_count times 32768. 1 multiply.
constexpr Angle joint_angle(AnglePerCount angle_per_count, Angle at_zero_counts, int32_t counts) {
  using WholeCounts = Q<31, 0>;
  const auto clamped =
      clamp(WholeCounts::from_raw(counts), WholeCounts::from_raw(-32768), WholeCounts::from_raw(32767));
  const int64_t turned = shift_right_rounded((angle_per_count * clamped).raw(), AnglePerCount::kFractionBits);
  return at_zero_counts + Angle::from_raw(static_cast<int32_t>(static_cast<uint32_t>(turned)));
}

/// q_i = q0_i + counts_i 2 pi / (counts per joint turn)_i. 3 multiplies.
constexpr JointAngles joint_angles(const Calibration& calibration, const Counts& counts) {
  const auto& [scale, zero] = calibration;
  return {joint_angle(scale[0], zero.q1, counts[0]), joint_angle(scale[1], zero.q2, counts[1]),
          joint_angle(scale[2], zero.q3, counts[2])};
}

}  // namespace palpate::phantom
