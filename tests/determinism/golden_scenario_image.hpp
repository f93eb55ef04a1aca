// The golden scenario's integers, for the profile that PALPATE_PROFILE names.
#pragma once

#include "palpate/firmware/scenario_image.hpp"
#include "palpate/tick/profiles.hpp"

namespace palpate::golden {

using Profile = palpate::PALPATE_PROFILE;

/// The bar of 1 x 1 x 3 cubes of 64 mm, E = 500 Pa, nu = 0.49, rho = 20 kg/m3, its low end held. The upper
/// cube has half the stiffness and half the density. What depends on the mesh:
struct Discretization {
  uint8_t level;
  uint8_t substeps;
  int8_t impulse_exponent;
};

template <class>
inline constexpr Discretization kDiscretization = {6, 4, 20};  // 1152 leaves
template <>
inline constexpr Discretization kDiscretization<Small> = {4, 2, 22};  // 288 leaves

}  // namespace palpate::golden
