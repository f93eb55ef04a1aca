// What a worst case is made of: a body, a state of it, and what is done to it. A seed stands for all of that.
#pragma once

#include "draw.hpp"
#include "palpate/remesh/rules.hpp"
#include "palpate/tick/profiles.hpp"
#include "palpate/tick/schedule.hpp"

namespace palpate::worst_case {

using Profile = palpate::PALPATE_PROFILE;

/// Which groups are split until all are in use.
enum class Front : uint8_t {
  kAny,
  kFlat,    // the coarsest first, so that most have their sibling beside them
  kUneven,  // the smallest first, so that a few have many leaves
};

/// What the tool does.
enum class Tool : uint8_t {
  kAppears,  // beside a heap of leaves whose boxes hold it
  kPresses,  // where it has touched before, among more faces than there is room for
  kHolds,    // has a node
};

struct Scene {
  uint32_t seed;
  Slot slot;  // of the worst tick
  std::array<uint8_t, 3> cubes;
  bool is_apart;         // no two cubes have a face in common
  uint8_t level;         // of all leaves, before the mesh grows
  bool grows;            // until its pools are full, or
  uint16_t most_leaves;  // there are so many or a few more
  bool is_deep;          // it grows where it is finest already
  bool keeps_type1;      // it grows elsewhere than at leaves of the type with the costliest force
  bool has_bars;         // some cubes may not be refined
  bool is_held;          // all nodes that need not be free for tethers
  bool is_heaped;        // nodes lie on a line beside the tool; else near their rest positions
  bool is_crowded;       // more leaves' boxes hold the tool than a tick examines
  uint16_t most_groups;  // the rotation front is split until there are so many
  Front front;
  bool blends;  // groups that a tick neither splits nor joins are on their way to another rotation
  Tool tool;
  bool wishes_any;  // changes of the mesh for which steps, tethers or patches are missing
};

/// The roots of its cubes must find groups and leaves.
inline void draw_cubes(Draw& draw, Scene& scene) {
  constexpr uint32_t kMostCubes = Profile::kGroups / kRootsPerCube;
  for (;;) {
    uint32_t count = 1;
    for (uint8_t& along : scene.cubes) {
      along = static_cast<uint8_t>(1 + draw.below(kMaxCubesPerAxis));
      count *= along;
    }
    scene.is_apart = draw.one_in(2);
    const uint32_t present = scene.is_apart ? (count + 1) / 2 : count;
    if (present <= kMostCubes && present * kRootsPerCube * 2 <= Profile::kLeaves) break;
  }
}

inline Scene draw_scene(uint32_t seed) {
  Draw draw(seed);
  Scene scene{};
  scene.seed = seed;
  draw_cubes(draw, scene);
  scene.level = static_cast<uint8_t>(draw.below(2));
  scene.grows = true;
  scene.most_leaves = Profile::kLeaves;
  scene.is_deep = draw.one_in(2);
  scene.keeps_type1 = draw.one_in(2);
  scene.has_bars = draw.one_in(2);
  scene.is_held = !draw.one_in(4);
  scene.is_heaped = true;
  scene.most_groups = Profile::kGroups;
  scene.front = static_cast<Front>(draw.below(3));
  scene.blends = !draw.one_in(4);
  scene.tool = draw.one_in(4) ? Tool::kAppears : Tool::kPresses;
  return scene;
}

}  // namespace palpate::worst_case
