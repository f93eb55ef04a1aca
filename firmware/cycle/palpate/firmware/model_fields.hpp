// The fields of a model's chunks, each with its name and its range, once for reading and writing
// (palpate/container/field_reader.hpp, field_writer.hpp). The order is that of the bytes: a change of it, of
// a field or of a format is a new version of the chunk. docs/container-format.md has them as tables.
#pragma once

#include "palpate/container/field_reader.hpp"
#include "palpate/container/field_writer.hpp"
#include "palpate/firmware/scenario_image.hpp"

namespace palpate::firmware::model_fields {

/// Q<0, 31> from 1/2 to its end.
inline constexpr Q<0, 31> kHalf = Q<0, 31>::ratio(1, 2);
/// Of a node's mass, so that every impulse is a shift (solve/dynamics.hpp).
inline constexpr int8_t kLeastImpulseExponent = 3;
inline constexpr int8_t kMostImpulseExponent = 34;

/// BLCK, 68 bytes.
template <class Fields, class AModel>
void shape(Fields& fields, AModel& model, uint8_t deepest) {
  for (const uint32_t axis : bounded<3>(3, [] {})) {
    fields.number("cubes", model.block.cubes[axis], 1, kMaxCubesPerAxis);
  }
  fields.number("level", model.level, 0, deepest);
  for (const uint32_t cube : bounded<kMaxCubes>(kMaxCubes, [] {})) {
    fields.number("region of a cube", model.block.region[cube]);
  }
}

/// REGN, 12 bytes a region.
template <class Fields, class AModel>
void regions(Fields& fields, AModel& model) {
  constexpr auto kNoShear = ShearCoefficient::from_raw(0);
  for (const uint32_t i : bounded<kRegions>(kRegions, [] {})) {
    auto& material = model.materials[i];
    auto& levels = model.remesh.stretch.levels[i];
    fields.fixed("shear", material.shear, kNoShear, ShearCoefficient::ratio(1, 12));
    fields.fixed("bulk", material.bulk, BulkCoefficient::from_raw(0), BulkCoefficient::ratio(555, 100));
    fields.number("density", model.region_density[i], 0, kDensityOne);
    fields.number("least level", levels.least, 0, kDeepestLevel);
    fields.number("most level", levels.most, 0, kDeepestLevel);
  }
}

/// DYNM, 16 bytes.
template <class Fields, class ADynamics>
void dynamics(Fields& fields, ADynamics& dynamics) {
  fields.number("substeps", dynamics.substeps, 1, kMaxSubsteps);
  fields.number("impulse exponent", dynamics.impulse_exponent, kLeastImpulseExponent, kMostImpulseExponent);
  fields.zeros(2);
  fields.fixed("mass damping", dynamics.mass_damping, Q<-5, 36>::from_raw(0));
  fields.fixed("stiffness damping", dynamics.stiffness_damping, Q<0, 31>::from_raw(0));
  fields.fixed("impulse mantissa", dynamics.impulse_mantissa, kHalf);
}

/// RMSH, 20 bytes.
template <class Fields, class Rules>
void remesh(Fields& fields, Rules& rules) {
  constexpr auto kZero = Q<4, 27>::from_raw(0);
  fields.choice("rotation criterion", rules.rotation.criterion, RotationCriterion::kMisfit);
  fields.number("rotation start level", rules.rotation.start_level, 0, kDeepestLevel);
  fields.choice("stretch criterion", rules.stretch.criterion, StretchCriterion::kStrainJump);
  fields.zeros(1);
  fields.number("rotation split above", rules.rotation.split_above);
  fields.number("rotation join below", rules.rotation.join_below);
  fields.fixed("stretch split above", rules.stretch.split_above, kZero);
  fields.fixed("stretch merge below", rules.stretch.merge_below, kZero);
}

template <class Fields, class Point>
void point(Fields& fields, const char* name, Point& point) {
  fields.number(name, point.x);
  fields.number(name, point.y);
  fields.number(name, point.z);
}

/// HOLD, 28 bytes.
template <class Fields, class AModel>
void held(Fields& fields, AModel& model) {
  for (const uint32_t i : bounded<kHolds>(kHolds, [] {})) {
    auto& box = model.held[i];
    point(fields, "held box, low corner", box.min);
    point(fields, "held box, high corner", box.max);
  }
  fields.fixed("grasp reach", model.grasp_reach, Position::from_raw(0), Position::ratio(4, 1));
}

/// CNTC, 32 bytes. All zero: no contact.
template <class Fields, class Rules>
void contact(Fields& fields, Rules& rules) {
  constexpr auto kNone = Coupling::from_raw(0);
  constexpr auto kNoForce = Force::from_raw(0);
  fields.fixed("tool radius", rules.radius, Position::from_raw(0), kMostRadius);
  fields.fixed("stiffness", rules.stiffness, kNone);
  fields.fixed("damping", rules.damping, kNone);
  fields.fixed("friction", rules.friction, Fraction::from_raw(0));
  fields.fixed("force limit", rules.force_limit, kNoForce, kContactForceLimit);
  fields.fixed("slew", rules.slew, kNoForce, kMostContactSlew);
  fields.number("passivity ceiling", rules.passivity.ceiling);
  fields.fixed("passivity damping", rules.passivity.most_damping, kNone);
}

/// SCEN, version 2, 60 bytes.
template <class Fields, class AScene>
void scene(Fields& fields, AScene& scene) {
  fields.fixed("edges per metre", scene.edges_per_metre, kLeastEdgesPerMetre, kMostEdgesPerMetre);
  fields.fixed_array("device origin", scene.device_origin, Position::ratio(-4, 1), Position::ratio(4, 1));
  fields.fixed_array("device rotation", scene.device_rotation, -kWholeEntry, kWholeEntry);
  fields.fixed("newton mantissa", scene.newton_mantissa, kHalf);
  fields.number("newton exponent", scene.newton_exponent, -16, 28);
  fields.zeros(3);
}

}  // namespace palpate::firmware::model_fields
