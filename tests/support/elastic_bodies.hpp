// Deformed bodies with any mesh and any rotation front, for tests of elasticity alone.
#pragma once

#include "palpate/elastic/group_forces.hpp"
#include "reference/mesh_from_forest.hpp"
#include "support/fixed.hpp"
#include "support/fronts.hpp"
#include "support/misfits.hpp"

namespace palpate::test {

template <class Profile>
struct ElasticBody {
  MeshWithFront<Profile> mesh;
  std::unique_ptr<Groups<Profile>> groups = std::make_unique<Groups<Profile>>();
  std::unique_ptr<GroupFrame<Profile>> frame = std::make_unique<GroupFrame<Profile>>();
  Materials materials{};

  [[nodiscard]] Forest<Profile>& forest() { return *mesh.forest; }
  [[nodiscard]] RotationFront<Profile>& front() { return *mesh.front; }
  [[nodiscard]] NodeState<Profile::kNodes>& node() { return mesh.forest->node; }

  template <Observe Mode = Observe::kYes>
  uint32_t evaluate() {
    if constexpr (Mode == Observe::kYes) renew_all_misfits(forest(), front(), *groups);
    return evaluate_at<Mode>(node().position);
  }
  template <Observe Mode = Observe::kYes>
  uint32_t evaluate_at(const std::array<Vector3<Position>, Profile::kNodes>& positions) {
    GroupForces<Profile> forces(forest(), front(), *groups, materials, *frame);
    return forces.template evaluate<Mode>(positions);
  }
  template <class Visit>
  void for_nodes(Visit visit) {
    for (uint32_t i = 0; i < forest().nodes.used(); ++i) visit(forest().nodes.live(i));
  }
  template <class Visit>
  void for_groups(Visit visit) {
    for (uint32_t i = 0; i < front().groups.used(); ++i) visit(front().groups.live(i));
  }
  /// Every node at map(rest position).
  template <class Map>
  void place(Map map) {
    for_nodes([&](uint16_t n) {
      node().position[n] = fixed_vector<Position>(map(doubles(rest_position(node().rest[n]))));
    });
  }
};

/// In units of E_ref, rounded as the core has it.
inline Material material_with(double youngs_ratio, double poisson_ratio) {
  const reference::Material exact = reference::material_of(youngs_ratio, poisson_ratio, 1.0);
  return Material{sim::to_fixed<ShearCoefficient>(exact.mu / 6.0),
                  sim::to_fixed<BulkCoefficient>(exact.lambda / 6.0)};
}

inline reference::Material exactly(const Material& fixed) {
  return {6.0 * sim::to_double(fixed.shear), 6.0 * sim::to_double(fixed.bulk), 1.0};
}

/// A notched block of two materials, changed at random, undeformed.
template <class Profile>
ElasticBody<Profile> random_body(Random& random, uint32_t changes = 300) {
  ElasticBody<Profile> body;
  body.mesh = mesh_with_front<Profile>(notched_block(), 1, 0);
  change_often(*body.mesh.forest, *body.mesh.front, changes, random);
  body.materials.fill(material_with(1.0, 0.49));
  body.materials[1] = material_with(0.3, 0.3);
  start_groups(body.front(), *body.groups);
  return body;
}

/// Bent and stretched smoothly, every group's rotation some degrees from the body's.
template <class Profile>
void deform_at_random(ElasticBody<Profile>& body, Random& random, double strength) {
  const Eigen::Matrix3d r = random.rotation();
  const Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity() + 0.4 * strength * random.matrix();
  const Eigen::Vector3d wave = 2.0 * random.vector();
  const Eigen::Vector3d amplitude = 0.1 * strength * random.vector();
  const Eigen::Vector3d shift = 0.5 * random.vector();
  body.place([&](const Eigen::Vector3d& x0) {
    return Eigen::Vector3d(r * (stretch * x0 + amplitude * std::sin(wave.dot(x0))) + shift +
                           0.01 * strength * random.vector());
  });
  body.for_groups([&](uint16_t g) {
    const Eigen::Matrix3d off =
        Eigen::AngleAxisd(0.3 * strength * random.unit(), random.direction()).toRotationMatrix();
    body.groups->used[g] = body.groups->extracted[g] = fixed_quaternion(r * off);
  });
}

}  // namespace palpate::test
