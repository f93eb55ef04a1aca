// Models that are written and read, and whether two of them are the same. A new member of any of these
// structs makes the comparison fail to compile: it has to be compared too, and so to be in a container.
#pragma once

#include <gtest/gtest.h>

#include "support/containers.hpp"
#include "support/sample_model.hpp"

namespace palpate::test {

inline File model_file(const CycleModel& model, const std::string& name = "sample") {
  MemorySink sink;
  EXPECT_EQ(firmware::write_model(sink, model, bytes_of(name)), WriteStatus::kDone);
  return sink.file;
}

inline Finding read_model(const File& file, CycleModel& model, uint8_t deepest = kDeepestLevel) {
  return firmware::read_model(bytes_of(file), deepest, model);
}
inline Finding refusal_of(const File& file, uint8_t deepest = kDeepestLevel) {
  CycleModel model{};
  return read_model(file, model, deepest);
}

inline void expect_same(const Block& a, const Block& b) {
  const auto& [cubes_a, region_a] = a;
  const auto& [cubes_b, region_b] = b;
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(cubes_a[axis], cubes_b[axis]);
  for (std::size_t cube = 0; cube < kMaxCubes; ++cube) EXPECT_EQ(region_a[cube], region_b[cube]);
}

inline void expect_same(const Material& a, const Material& b) {
  const auto& [shear_a, bulk_a] = a;
  const auto& [shear_b, bulk_b] = b;
  EXPECT_EQ(shear_a, shear_b);
  EXPECT_EQ(bulk_a, bulk_b);
}

inline void expect_same(const Dynamics& a, const Dynamics& b) {
  const auto& [substeps_a, mass_damping_a, stiffness_damping_a, mantissa_a, exponent_a] = a;
  const auto& [substeps_b, mass_damping_b, stiffness_damping_b, mantissa_b, exponent_b] = b;
  EXPECT_EQ(substeps_a, substeps_b);
  EXPECT_EQ(mass_damping_a, mass_damping_b);
  EXPECT_EQ(stiffness_damping_a, stiffness_damping_b);
  EXPECT_EQ(mantissa_a, mantissa_b);
  EXPECT_EQ(exponent_a, exponent_b);
}

inline void expect_same(const RotationRules& a, const RotationRules& b) {
  const auto& [criterion_a, level_a, split_a, join_a] = a;
  const auto& [criterion_b, level_b, split_b, join_b] = b;
  EXPECT_EQ(criterion_a, criterion_b);
  EXPECT_EQ(level_a, level_b);
  EXPECT_EQ(split_a, split_b);
  EXPECT_EQ(join_a, join_b);
}

inline void expect_same(const StretchRules& a, const StretchRules& b) {
  const auto& [criterion_a, split_a, merge_a, levels_a] = a;
  const auto& [criterion_b, split_b, merge_b, levels_b] = b;
  EXPECT_EQ(criterion_a, criterion_b);
  EXPECT_EQ(split_a, split_b);
  EXPECT_EQ(merge_a, merge_b);
  for (std::size_t i = 0; i < kRegions; ++i) {
    const auto& [least_a, most_a] = levels_a[i];
    const auto& [least_b, most_b] = levels_b[i];
    EXPECT_EQ(least_a, least_b);
    EXPECT_EQ(most_a, most_b);
  }
}

inline void expect_same(const LatticeBox& a, const LatticeBox& b) {
  const auto& [min_a, max_a] = a;
  const auto& [min_b, max_b] = b;
  EXPECT_EQ(min_a, min_b);
  EXPECT_EQ(max_a, max_b);
}

inline void expect_same(const ContactRules& a, const ContactRules& b) {
  const auto& [radius_a, stiffness_a, damping_a, friction_a, limit_a, slew_a, passivity_a] = a;
  const auto& [radius_b, stiffness_b, damping_b, friction_b, limit_b, slew_b, passivity_b] = b;
  const auto& [ceiling_a, most_damping_a] = passivity_a;
  const auto& [ceiling_b, most_damping_b] = passivity_b;
  EXPECT_EQ(radius_a, radius_b);
  EXPECT_EQ(stiffness_a, stiffness_b);
  EXPECT_EQ(damping_a, damping_b);
  EXPECT_EQ(friction_a, friction_b);
  EXPECT_EQ(limit_a, limit_b);
  EXPECT_EQ(slew_a, slew_b);
  EXPECT_EQ(ceiling_a, ceiling_b);
  EXPECT_EQ(most_damping_a, most_damping_b);
}

inline void expect_same(const Model& a, const Model& b) {
  const auto& [block_a, level_a, materials_a, density_a, dynamics_a, remesh_a, held_a, reach_a, contact_a] =
      a;
  const auto& [block_b, level_b, materials_b, density_b, dynamics_b, remesh_b, held_b, reach_b, contact_b] =
      b;
  const auto& [rotation_a, stretch_a] = remesh_a;
  const auto& [rotation_b, stretch_b] = remesh_b;
  expect_same(block_a, block_b);
  EXPECT_EQ(level_a, level_b);
  for (std::size_t i = 0; i < kRegions; ++i) expect_same(materials_a[i], materials_b[i]);
  EXPECT_EQ(density_a, density_b);
  expect_same(dynamics_a, dynamics_b);
  expect_same(rotation_a, rotation_b);
  expect_same(stretch_a, stretch_b);
  for (std::size_t i = 0; i < kHolds; ++i) expect_same(held_a[i], held_b[i]);
  EXPECT_EQ(reach_a, reach_b);
  expect_same(contact_a, contact_b);
}

inline void expect_same(const firmware::Scene& a, const firmware::Scene& b) {
  const auto& [edges_a, origin_a, rotation_a, mantissa_a, exponent_a] = a;
  const auto& [edges_b, origin_b, rotation_b, mantissa_b, exponent_b] = b;
  EXPECT_EQ(edges_a, edges_b);
  EXPECT_EQ(origin_a, origin_b);
  EXPECT_EQ(rotation_a, rotation_b);
  EXPECT_EQ(mantissa_a, mantissa_b);
  EXPECT_EQ(exponent_a, exponent_b);
}

inline void expect_same(const CycleModel& a, const CycleModel& b) {
  const auto& [body_a, scene_a] = a;
  const auto& [body_b, scene_b] = b;
  expect_same(body_a, body_b);
  expect_same(scene_a, scene_b);
}

}  // namespace palpate::test
