// Joint torques to the codes of three 12-bit current amplifiers.
#pragma once

#include "palpate/phantom/units.hpp"

namespace palpate::phantom {

inline constexpr int32_t kZeroCode = 2048;        ///< no current
inline constexpr int32_t kFullScaleCodes = 2047;  ///< codes from there to the amplifier's full scale
inline constexpr int32_t kHighestCode = 4095;

/// Motors, capstans and amplifiers, as integers: the host reads the same figures.
struct DriveRatings {
  std::array<int32_t, 3> capstan_ratio_milli;             ///< eta_i in thousandths
  std::array<int32_t, 3> direction;                       ///< s_i: +1 or -1
  int32_t torque_constant_micronewton_metres_per_ampere;  ///< Kt
  int32_t current_limit_milliamperes;                     ///< I_lim
  int32_t full_scale_milliamperes;                        ///< I_fs, of the board
};

using Codes = Q<20, 11>;                ///< a current in amplifier codes, before rounding
using CodesPerNewtonMetre = Q<14, 17>;  ///< below 16384

/// What motor_codes needs of the ratings.
struct Drive {
  std::array<CodesPerNewtonMetre, 3> codes_per_torque;  ///< s_i 2047 / (eta_i Kt I_fs)
  Codes limit;                                          ///< 2047 I_lim / I_fs, at most 2047
};

/// For compile-time constants.
constexpr Drive make_drive(const DriveRatings& ratings) {
  constexpr int64_t kUnits = int64_t{1000} * 1000 * 1000000;
  Drive drive{{},
              Codes::ratio(kFullScaleCodes * int64_t{ratings.current_limit_milliamperes},
                           ratings.full_scale_milliamperes)};
  if (drive.limit > Codes::ratio(kFullScaleCodes, 1)) drive.limit = Codes::ratio(kFullScaleCodes, 1);
  for (std::size_t joint = 0; joint < 3; ++joint) {
    const int64_t divisor = int64_t{ratings.capstan_ratio_milli[joint]} *
                            ratings.torque_constant_micronewton_metres_per_ampere *
                            ratings.full_scale_milliamperes;
    const int64_t full_scale = int64_t{kFullScaleCodes} * ratings.direction[joint] * kUnits;
    drive.codes_per_torque[joint] = CodesPerNewtonMetre::ratio(full_scale, divisor);
  }
  return drive;
}

struct MotorCodes {
  std::array<uint16_t, 3> codes;
  std::array<bool, 3> limited;  ///< the torque asked for more than the current limit
};

/// I_i = s_i tau_i / (eta_i Kt), clamped to +-I_lim; code_i = 2048 + round(2047 I_i / I_fs), ties up, in
/// 0..4095. No torque is exactly 2048. The rounding may pass I_lim by half a code. Any torque that
/// NewtonMetre holds. Within 0.5 + 2^-11 code of the exact quotient. 3 multiplies.
constexpr MotorCodes motor_codes(const Drive& drive, NewtonMetre tau1, NewtonMetre tau2, NewtonMetre tau3) {
  MotorCodes result{};
  const auto set = [&drive, &result](std::size_t joint, NewtonMetre torque) {
    const Codes asked = narrow<Codes>(drive.codes_per_torque[joint] * torque);
    const Codes given = clamp(asked, -drive.limit, drive.limit);
    const int32_t code = kZeroCode + narrow<Q<31, 0>>(widen<Codes::kFractionBits>(given)).raw();
    const int32_t at_least_zero = code < 0 ? 0 : code;
    result.codes[joint] = static_cast<uint16_t>(at_least_zero > kHighestCode ? kHighestCode : at_least_zero);
    result.limited[joint] = asked != given;
  };
  set(0, tau1);
  set(1, tau2);
  set(2, tau3);
  return result;
}

inline MotorCodes motor_codes(const Drive& drive, const Vector3<NewtonMetre>& torques) {
  return motor_codes(drive, torques.x(), torques.y(), torques.z());
}

}  // namespace palpate::phantom
