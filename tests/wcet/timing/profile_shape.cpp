#include "profile_shape.hpp"

#include <palpate/mesh/block.hpp>
#include <palpate/tick/profiles.hpp>

#include "refusal.hpp"

namespace palpate::wcet::timing {
namespace {

// Substeps and levels are no quantities: they multiply the others.
template <class Profile>
ProfileShape shape_of(const char* key) {
  return {key,
          Profile::kName,
          Profile::kSubsteps,
          Profile::kMaxLevel,
          {{"leaves", Profile::kLeaves},
           // Of a group all nodes but the first one.
           {"pairs of node and group", Profile::kLeaves + 2u * Profile::kGroups},
           {"nodes", Profile::kNodes},
           {"groups", Profile::kGroups},
           {"faces of the surface", 2u * (Profile::kLeaves + kMaxCubes)},
           {"tethers", Profile::kTethers},
           {"contact candidates", Profile::kContactCandidates},
           {"patches", Profile::kPatches},
           {"rotation changes", Profile::kRotationChanges},
           {"tetrahedra split or merged", Profile::kTetsSplit}}};
}

}  // namespace

const ProfileShape& profile_shape(const std::string& key) {
  static const std::vector<ProfileShape> shapes{
      shape_of<CuboidDense>("CuboidDense"), shape_of<CuboidPaper>("CuboidPaper"), shape_of<Organ>("Organ"),
      shape_of<Small>("Small"), shape_of<Tiny>("Tiny")};
  for (const ProfileShape& shape : shapes) {
    if (shape.key == key) return shape;
  }
  throw BadInput("no target has a profile " + key + "; CuboidDense, CuboidPaper, Organ, Small, Tiny");
}

}  // namespace palpate::wcet::timing
