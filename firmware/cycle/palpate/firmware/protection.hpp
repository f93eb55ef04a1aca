// Between the cycle and the safety layer: currents in, and the motor codes that its verdict leaves.
#pragma once

#include "palpate/phantom/premium.hpp"
#include "palpate/safety/safety.hpp"

namespace palpate::firmware {

namespace protection {

inline constexpr safety::AmperesPerCode kAmperesPerCode =
    safety::amperes_per_code(phantom::premium::kDriveRatings.full_scale_milliamperes);
using CodesPerAmpere = Q<10, 21>;
inline constexpr CodesPerAmpere kCodesPerAmpere = CodesPerAmpere::ratio(
    int64_t{1000} * phantom::kFullScaleCodes, phantom::premium::kDriveRatings.full_scale_milliamperes);

/// What the codes of the last cycle made flow. 3 multiplies.
constexpr std::array<safety::Ampere, 3> currents(const std::array<uint16_t, 3>& codes) {
  return {safety::current_of_code(codes[0], kAmperesPerCode),
          safety::current_of_code(codes[1], kAmperesPerCode),
          safety::current_of_code(codes[2], kAmperesPerCode)};
}

/// The drive with the lowest of its own and the motors' limits: the warmest motor's holds for all, so that
/// the force loses size rather than direction. 3 multiplies.
constexpr phantom::Drive limited(const phantom::Drive& drive, const std::array<safety::Ampere, 3>& limits) {
  phantom::Drive lower = drive;
  const auto lower_to = [&lower](safety::Ampere amperes) {
    const auto codes = narrow<phantom::Codes>(amperes * kCodesPerAmpere);
    if (codes < lower.limit) lower.limit = codes;
  };
  lower_to(limits[0]);
  lower_to(limits[1]);
  lower_to(limits[2]);
  return lower;
}

}  // namespace protection

/// Nobody holds the device of a script, and its counts may jump: only what the board reports and
/// the counts' range are watched, and the whole force is there from the first cycle on.
inline safety::Safety scripted_safety() {
  safety::Safety safety = safety::make_safety(safety::kPremium15Parameters);
  safety.parameters.ignored =
      safety::kMonitored.without(safety::ConditionSet::of(safety::Condition::kEncoderRange));
  safety.state = safety::State::kActive;
  safety.ramp = {safety::kFullForce, safety.parameters.ramp.free_ticks};
  return safety;
}

}  // namespace palpate::firmware
