// Linear elastic material of a region, in units of 6 times the model's E_ref. The sixth comes from the volume
// of the shapes (h^3 / 6, / 12, / 24), so that element forces need shifts only.
#pragma once

#include "palpate/mesh/block.hpp"
#include "palpate/numeric/q.hpp"

namespace palpate {

/// mu / (6 E_ref), E <= E_ref: 0 .. 1/12.
using ShearCoefficient = Q<-3, 34>;
/// lambda / (12 E_ref): 0 .. 2.77 at nu = 0.495.
using BulkCoefficient = Q<2, 29>;

struct Material {
  ShearCoefficient shear;
  BulkCoefficient bulk;
};

using Materials = std::array<Material, kRegions>;

}  // namespace palpate
