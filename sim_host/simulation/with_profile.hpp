// From a profile's name to its type.
#pragma once

#include "compiled_stages.hpp"
#include "model_parameters.hpp"

namespace palpate::sim {

/// Calls use(Profile{}) with the profile of this name. Throws BadInput for an unknown one.
template <class Use>
auto with_profile(const std::string& name, Use&& use) {
  if (name == CuboidPaper::kName) return use(CuboidPaper{});
  if (name == CuboidDense::kName) return use(CuboidDense{});
  if (name == Organ::kName) return use(Organ{});
  if (name == Small::kName) return use(Small{});
  if (name == Tiny::kName) return use(Tiny{});
  if (name == Workstation::kName) return use(Workstation{});
  throw BadInput("no profile is called '" + name +
                 "'; choose cuboid-paper, cuboid-dense, organ, small, tiny or workstation");
}

}  // namespace palpate::sim
