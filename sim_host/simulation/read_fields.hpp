// The fields of a body of the core. Strain and stress are the core's own, its clamps included.
#pragma once

#include "palpate/tick/state.hpp"
#include "simulation/body_fields.hpp"
#include "units.hpp"

namespace palpate::sim {

template <class Scalar>
Eigen::Matrix3d to_doubles(const Matrix3<Scalar>& m) {
  Eigen::Matrix3d doubles;
  for (Eigen::Index i = 0; i < 9; ++i) doubles(i % 3, i / 3) = to_double(m(i % 3, i / 3));
  return doubles;
}

template <class Scalar>
std::array<double, 3> to_doubles(const Vector3<Scalar>& v, double scale) {
  const auto doubles = to_doubles(v);
  return {doubles[0] * scale, doubles[1] * scale, doubles[2] * scale};
}

template <class Profile>
void read_strain(const State<Profile>& state, const Leaf& leaf, const ModelParameters& model,
                 BodyFields& fields) {
  const auto& position = state.forest.node.position;
  const EdgeVectors edges =
      edge_vectors(type_of_level(leaf.level()), position[leaf.node[0]], position[leaf.node[1]],
                   position[leaf.node[2]], position[leaf.node[3]]);
  uint32_t clamped = 0;
  const DeformationGradient f = deformation_gradient(edges, leaf.axes(), leaf.level(), clamped);
  const Matrix3<Strain> a = corotated_gradient(rotation_matrix(state.groups.used[leaf.group]), f, clamped);
  const Matrix3<Stress> sigma = corotated_stress(a, state.model.materials[leaf.region()], clamped);
  constexpr double kModuliInStressUnit = 6.0;
  fields.volume_ratio.push_back(to_doubles(f).determinant());
  fields.von_mises_pa.push_back(von_mises(to_doubles(sigma)) * kModuliInStressUnit *
                                reference_modulus_pa(model));
}

template <class Profile>
BodyFields read_fields(const State<Profile>& state, const ModelParameters& model) {
  const auto& forest = state.forest;
  const double edge_mm = model.edge_m * 1e3;
  const double substeps_a_second = state.model.dynamics.substeps * 1e3;
  BodyFields fields;
  std::array<uint32_t, Profile::kNodes> place{};
  for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
    const uint16_t node = forest.nodes.live(i);
    place[node] = i;
    fields.rest_mm.push_back(to_mm(rest_position(forest.node.rest[node]), model));
    fields.now_mm.push_back(to_mm(forest.node.position[node], model));
    fields.velocity_mm_s.push_back(to_doubles(forest.node.velocity[node], edge_mm * substeps_a_second));
    fields.force_n.push_back(to_doubles(forest.node.force[node], newtons_per_unit(model)));
  }
  for (uint32_t i = 0; i < forest.leaf_count; ++i) {
    const Leaf& leaf = forest.leaf[i];
    const auto& node = leaf.node;
    fields.tets.push_back(
        oriented({place[node[0]], place[node[1]], place[node[2]], place[node[3]]}, fields.rest_mm));
    fields.level.push_back(leaf.level());
    fields.region.push_back(leaf.region());
    fields.rotation_tet.push_back(leaf.group);
    read_strain(state, leaf, model, fields);
  }
  return fields;
}

}  // namespace palpate::sim
