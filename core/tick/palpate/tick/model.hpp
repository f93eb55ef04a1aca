// A model: everything about an organ and its scene that stays as it is while the cycle runs, in internal
// units (cube edge, substep, E_ref edge^2). Plain integers, made on the host from SI values and checked
// there; the firmware only loads it.
#pragma once

#include "palpate/elastic/material.hpp"
#include "palpate/remesh/rules.hpp"
#include "palpate/solve/integrate.hpp"
#include "palpate/touch/contact_rules.hpp"

namespace palpate {

struct Model {
  Block block;
  uint8_t level;  // of the uniform mesh at start
  Materials materials;
  std::array<uint16_t, kRegions> region_density;  // in 1/kDensityOne of the largest
  Dynamics dynamics;
  RemeshRules remesh;
  HeldRegions held;      // both empty: a free body
  Position grasp_reach;  // 0 .. 4 edges
  ContactRules contact;
};

}  // namespace palpate
