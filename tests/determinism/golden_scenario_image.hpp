// The golden scenario's integers, for the profile that PALPATE_PROFILE names.
#pragma once

#include "palpate/firmware/scenario_image.hpp"
#include "palpate/tick/profiles.hpp"

namespace palpate::golden {

using Profile = palpate::PALPATE_PROFILE;

/// The bar of 1 x 1 x 3 cubes of 64 mm, E = 500 Pa, nu = 0.49, rho = 20 kg/m3, its low end held. The upper
/// cube has half the stiffness and half the density. Groups split at 1.5 degrees and are joined at 0.85 of
/// that; leaves split where an edge is 6 percent longer and are merged at half of that. What depends on the
/// mesh:
struct Discretization {
  uint8_t level;  // at start
  uint8_t least_level;
  uint8_t most_level;
  uint8_t substeps;
  int8_t impulse_exponent;
};

template <class>
inline constexpr Discretization kDiscretization = {4, 3, 6, 4, 20};  // 288 leaves at start, 1152 would fit
template <>
inline constexpr Discretization kDiscretization<Small> = {3, 2, 4, 2,
                                                          22};  // 144 leaves at start, 288 would fit

}  // namespace palpate::golden
