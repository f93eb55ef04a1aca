// How warm a motor is: winding and housing as two masses, heated by the current that was commanded.
//
//   Cw Tw' = I^2 R (1 + alpha (Tw - 25)) - (Tw - Th) / Rwh
//   Ch Th' = (Tw - Th) / Rwh - (Th - Ta) / Rha
//
// One explicit Euler step a tick: with 1 ms and time constants of 12 s and 612 s within 1e-4 of the solution.
// It starts at ambient, so after a restart with warm motors it is too low: let them cool before.
#pragma once

#include "palpate/phantom/motor_code.hpp"
#include "palpate/safety/parameters.hpp"

namespace palpate::safety {

/// Temperatures with the small part that a tick adds: LSB 9e-13 K.
using HeatSum = Acc<40>;

struct MotorTemperatures {
  HeatSum winding, housing;
};

/// What a tick changes for each kelvin, and for each A^2.
struct ThermalModel {
  Q<-6, 37> kelvin_per_square_ampere;    ///< R dt / Cw
  Q<-7, 38> resistance_growth;           ///< alpha
  Q<-8, 39> winding_to_housing_winding;  ///< dt / (Rwh Cw)
  Q<-8, 39> winding_to_housing_housing;  ///< dt / (Rwh Ch)
  Q<-8, 39> housing_to_ambient;          ///< dt / (Rha Ch)
};

/// For compile-time constants.
constexpr ThermalModel make_thermal_model(const ThermalRatings& ratings, int32_t tick_us) {
  constexpr int64_t kMillion = 1000000;
  const auto per_kelvin = [tick_us](int32_t milli_kelvin_w, int32_t millijoules_per_kelvin) {
    return Q<-8, 39>::ratio(tick_us, int64_t{milli_kelvin_w} * millijoules_per_kelvin);
  };
  return {Q<-6, 37>::ratio(int64_t{ratings.resistance_milliohms} * tick_us,
                           ratings.winding_millijoules_per_kelvin * kMillion),
          Q<-7, 38>::ratio(ratings.copper_parts_per_million_kelvin, kMillion),
          per_kelvin(ratings.winding_to_housing_milli_kelvin_w, ratings.winding_millijoules_per_kelvin),
          per_kelvin(ratings.winding_to_housing_milli_kelvin_w, ratings.housing_millijoules_per_kelvin),
          per_kelvin(ratings.housing_to_ambient_milli_kelvin_w, ratings.housing_millijoules_per_kelvin)};
}
inline constexpr ThermalModel kRe25Heat = make_thermal_model(kRe25, 1000);

constexpr MotorTemperatures motor_at(Celsius ambient) {
  return {widen<HeatSum::kFractionBits>(ambient), widen<HeatSum::kFractionBits>(ambient)};
}

/// Rounded; beyond +-256 degC it saturates.
constexpr Celsius celsius(HeatSum temperature) { return narrow_saturated<Celsius>(temperature); }

namespace heat {

/// a - b: 255 degC at most, so that a product with a rate fits.
constexpr Celsius difference(Celsius a, Celsius b) {
  return narrow_saturated<Celsius>(widen<Celsius::kFractionBits>(a) - widen<Celsius::kFractionBits>(b));
}
constexpr HeatSum flow(Q<-8, 39> rate, Celsius kelvins) {
  return HeatSum::from_raw(shift_right_rounded((rate * kelvins).raw(), 39 + 23 - HeatSum::kFractionBits));
}
/// A motor that is already destroyed gets no warmer here.
constexpr HeatSum limited(HeatSum temperature) {
  constexpr HeatSum kHighest = widen<HeatSum::kFractionBits>(Celsius::ratio(255, 1));
  return temperature > kHighest ? kHighest : temperature;
}

}  // namespace heat

/// A tick at this current; |I| below 8 A. 6 multiplies.
constexpr void heat_up(MotorTemperatures& motor, const ThermalModel& model, Celsius ambient, Ampere current) {
  constexpr auto kReference = Celsius::ratio(25, 1);
  constexpr auto kOne = Q<2, 29>::ratio(1, 1);
  const Celsius winding = celsius(motor.winding);
  const Celsius housing = celsius(motor.housing);
  const auto square_amperes = narrow_saturated<Q<6, 25>>(current * current);
  const Celsius above_25 = heat::difference(winding, kReference);
  const auto resistance = narrow<Q<2, 29>>(model.resistance_growth * above_25) + kOne;
  const auto kelvin_per_square_ampere = narrow<Q<-5, 36>>(model.kelvin_per_square_ampere * resistance);
  const auto heating = HeatSum::from_raw(shift_right_rounded(
      (kelvin_per_square_ampere * square_amperes).raw(), 36 + 25 - HeatSum::kFractionBits));
  const Celsius out_of_winding = heat::difference(winding, housing);
  const Celsius out_of_housing = heat::difference(housing, ambient);
  motor.winding += heating - heat::flow(model.winding_to_housing_winding, out_of_winding);
  motor.housing += heat::flow(model.winding_to_housing_housing, out_of_winding) -
                   heat::flow(model.housing_to_ambient, out_of_housing);
  motor.winding = heat::limited(motor.winding);
  motor.housing = heat::limited(motor.housing);
}

using AmperesPerCode = Q<-8, 39>;  ///< below 0.0039

/// For compile-time constants.
constexpr AmperesPerCode amperes_per_code(int32_t full_scale_milliamperes) {
  return AmperesPerCode::ratio(full_scale_milliamperes, int64_t{1000} * phantom::kFullScaleCodes);
}

/// (code - 2048) amperes_per_code, what motor_codes rounded: at most half a code from what was asked for. 1
/// multiply.
constexpr Ampere current_of_code(uint16_t code, AmperesPerCode per_code) {
  using WholeCodes = Q<12, 19>;
  constexpr int32_t kOneCode = 1 << WholeCodes::kFractionBits;
  const auto from_zero = WholeCodes::from_raw((int32_t{code} - phantom::kZeroCode) * kOneCode);
  return narrow_saturated<Ampere>(from_zero * per_code);
}

}  // namespace palpate::safety
