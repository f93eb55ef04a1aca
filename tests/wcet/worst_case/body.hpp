// The model of a scene. Its physics are those of the golden scenarios, its capacities the profile's.
#pragma once

#include "determinism/golden_body.hpp"
#include "scene.hpp"

namespace palpate::worst_case {

/// Cubes of this region may not be refined, where a scene has such.
inline constexpr uint8_t kBarred = 1;

/// As heavy as tissue; the lightest node of the deepest level moves less than 8 edges a substep for a unit
/// force. Made by the compiler, as ratios are 64-bit divisions.
inline constexpr golden::Discretization kDiscretization{
    0, 0, Profile::kMaxLevel, Profile::kSubsteps, 1000, Q<0, 31>::ratio(3, 4), 18};
inline constexpr firmware::CycleModel kModel{golden::make_body(kDiscretization), golden::make_scene()};

constexpr ContactRules make_contact_rules() {
  ContactRules rules{};
  rules.radius = kLeastRadius;
  rules.stiffness = Coupling::ratio(100, 1);
  rules.damping = Coupling::ratio(1, 1);
  rules.friction = Fraction::ratio(1, 2);
  rules.force_limit = kContactForceLimit;
  rules.slew = Force::ratio(1, 100);
  rules.passivity = {1u << 20, Coupling::ratio(100, 1)};
  return rules;
}
inline constexpr ContactRules kContactRules = make_contact_rules();

inline Block block_of(const Scene& scene, Draw& draw) {
  Block block{};
  for (uint32_t axis = 0; axis < 3; ++axis) block.cubes[axis] = scene.cubes[axis];
  for (uint32_t i = 0; i < kMaxCubes; ++i) {
    const uint32_t x = i % scene.cubes[0];
    const uint32_t y = i / scene.cubes[0] % scene.cubes[1];
    const uint32_t z = i / scene.cubes[0] / scene.cubes[1];
    const bool is_there = !scene.is_apart || (x + y + z) % 2 == 0;
    block.region[i] = is_there ? static_cast<uint8_t>(draw.one_in(4) ? kBarred : 0) : Block::kAbsent;
  }
  block.region[0] = 0;
  return block;
}

inline firmware::CycleModel model_of(const Scene& scene, Draw& draw) {
  firmware::CycleModel model = kModel;
  Model& body = model.body;
  body.level = scene.level;
  body.block = block_of(scene, draw);
  body.remesh.stretch.criterion = StretchCriterion::kSixEdges;
  if (scene.has_bars) body.remesh.stretch.levels[kBarred].most = scene.level;
  body.contact = kContactRules;
  body.grasp_reach = Position::from_raw(0);
  const LatticeBox nothing{{1, 1, 1}, {0, 0, 0}};
  body.held = {nothing, nothing};
  return model;
}

}  // namespace palpate::worst_case
