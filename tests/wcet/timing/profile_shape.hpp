// What of a profile the loops of a tick count: the quantities that a bound is a formula of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace palpate::wcet::timing {

struct Quantity {
  std::string name;
  uint32_t count = 0;
};

struct ProfileShape {
  std::string key;   // the type's name, as in image names: CuboidPaper
  std::string name;  // cuboid-paper
  uint32_t substeps = 0;
  uint32_t max_level = 0;
  std::vector<Quantity> quantities;  // the same, in the same order, for every profile
};

/// Of all profiles that targets have. Throws BadInput for another key.
const ProfileShape& profile_shape(const std::string& key);

}  // namespace palpate::wcet::timing
