// Linear elastic material of a region, in units of 6 times the model's E_ref. The sixth comes from the volume
// of the shapes (h^3 / 6, / 12, / 24), so that element forces need shifts only.
#pragma once

#include "palpate/mesh/block.hpp"
#include "palpate/numeric/q.hpp"

namespace palpate {

/// mu / (6 E_ref), E <= E_ref: 0 .. 1/12.
using ShearCoefficient = Q<0, 31>;
/// lambda / (6 E_ref): 0 .. 5.55 at nu = 0.495.
using BulkCoefficient = Q<3, 28>;

struct Material {
  ShearCoefficient shear;
  BulkCoefficient bulk;
};

using Materials = std::array<Material, kRegions>;

}  // namespace palpate
