// Bullet's deformable body. Of its forces, btDeformableLinearElasticityForce is the one with Palpate's law,
// sigma = 2 mu e + lambda tr(e) I in the frame of a tet's own rotation, and the one that its implicit steps
// can use; btDeformableCorotatedForce has another volume term and no derivative.
#ifndef __clang__
// Bullet's arrays begin as copies of what was never set.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableLinearElasticityForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>

#include "peer.hpp"

namespace palpate::bench {
namespace {

btVector3 to_bullet(const reference::Vector& v) {
  return {static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2])};
}

reference::Vector from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// With corners in the order in which Bullet's volumes are positive.
std::array<int, 4> oriented(const reference::Mesh& mesh, const std::array<uint32_t, 4>& tet) {
  std::array<int, 4> corners = {static_cast<int>(tet[0]), static_cast<int>(tet[1]), static_cast<int>(tet[2]),
                                static_cast<int>(tet[3])};
  reference::Matrix edges;
  for (int i = 0; i < 3; ++i)
    edges.col(i) = mesh.rest[tet[static_cast<std::size_t>(i) + 1]] - mesh.rest[tet[0]];
  if (edges.determinant() < 0) std::swap(corners[2], corners[3]);
  return corners;
}

class BulletPeer final : public Peer {
 public:
  explicit BulletPeer(const PeerSetup& setup)
      : step_s_(static_cast<btScalar>(setup.step_s)),
        dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &constraint_solver_, &configuration_, &solver_),
        body_(&world_.getWorldInfo(), static_cast<int>(setup.mesh.rest.size()), nullptr, nullptr) {
    constraint_solver_.setDeformableSolver(&solver_);
    world_.setGravity(btVector3(0, 0, 0));
    world_.setImplicit(setup.mode != PeerMode::kExplicit);
    world_.setUseProjection(setup.mode != PeerMode::kImplicitMultipliers);
    add_mesh(setup);
    force_.setYoungsModulus(static_cast<btScalar>(setup.youngs_modulus_pa));
    force_.setPoissonRatio(static_cast<btScalar>(setup.poisson_ratio));
    force_.setDamping(static_cast<btScalar>(setup.mass_damping_per_s),
                      static_cast<btScalar>(setup.stiffness_damping_s));
    world_.addSoftBody(&body_);
    world_.addForce(&body_, &force_);
    for (int i = 0; i < body_.m_nodes.size(); ++i) body_.m_nodes[i].index = i;
    force_at_nodes_.resize(body_.m_nodes.size(), btVector3(0, 0, 0));
  }
  BulletPeer(const BulletPeer&) = delete;
  BulletPeer(BulletPeer&&) = delete;
  BulletPeer& operator=(const BulletPeer&) = delete;
  BulletPeer& operator=(BulletPeer&&) = delete;
  ~BulletPeer() override {
    world_.removeForce(&body_, &force_);
    world_.removeSoftBody(&body_);
  }

  void set_motion(const reference::Positions& position,
                  const std::vector<reference::Vector>& velocity) override {
    for (int i = 0; i < body_.m_nodes.size(); ++i) {
      btSoftBody::Node& node = body_.m_nodes[i];
      node.m_x = node.m_q = to_bullet(position[static_cast<std::size_t>(i)]);
      node.m_v = node.m_vn = to_bullet(velocity[static_cast<std::size_t>(i)]);
    }
  }

  void evaluate_forces() override {
    body_.updateDeformation();
    for (int i = 0; i < force_at_nodes_.size(); ++i) force_at_nodes_[i].setZero();
    force_.addScaledElasticForce(1, force_at_nodes_);
  }

  [[nodiscard]] std::vector<reference::Vector> forces() const override {
    std::vector<reference::Vector> forces;
    forces.reserve(static_cast<std::size_t>(force_at_nodes_.size()));
    for (int i = 0; i < force_at_nodes_.size(); ++i) forces.push_back(from_bullet(force_at_nodes_[i]));
    return forces;
  }

  void lead(uint32_t node, const reference::Vector& to) override {
    btSoftBody::Node& led = body_.m_nodes[static_cast<int>(node)];
    led.m_v = led.m_vn = (to_bullet(to) - led.m_x) / step_s_;
  }

  void step() override { world_.stepSimulation(step_s_, 0); }

  [[nodiscard]] reference::Positions positions() const override {
    reference::Positions positions;
    for (int i = 0; i < body_.m_nodes.size(); ++i) positions.push_back(from_bullet(body_.m_nodes[i].m_x));
    return positions;
  }

 private:
  /// A moved node has no mass: what Bullet calls static.
  void add_mesh(const PeerSetup& setup) {
    const reference::Mesh& mesh = setup.mesh;
    const auto material =
        reference::material_of(setup.youngs_modulus_pa, setup.poisson_ratio, setup.density_kg_m3);
    const std::vector<double> mass = reference::lumped_masses(mesh, {material});
    for (std::size_t i = 0; i < mesh.rest.size(); ++i) {
      btSoftBody::Node& node = body_.m_nodes[static_cast<int>(i)];
      node.m_x = node.m_q = to_bullet(mesh.rest[i]);
      body_.setMass(static_cast<int>(i), setup.is_moved[i] ? 0 : static_cast<btScalar>(mass[i]));
    }
    for (const auto& tet : mesh.tet) {
      const std::array<int, 4> corners = oriented(mesh, tet);
      body_.appendTetra(corners[0], corners[1], corners[2], corners[3]);
    }
    body_.initializeDmInverse();
    body_.m_tetraScratches.resize(body_.m_tetras.size());
    body_.m_tetraScratchesTn.resize(body_.m_tetras.size());
    body_.m_cfg.collisions = 0;  // it touches nothing
    body_.setActivationState(DISABLE_DEACTIVATION);
  }

  btScalar step_s_;
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btDeformableBodySolver solver_;
  btDeformableMultiBodyConstraintSolver constraint_solver_;
  btDeformableMultiBodyDynamicsWorld world_;
  btSoftBody body_;
  btDeformableLinearElasticityForce force_;
  btAlignedObjectArray<btVector3> force_at_nodes_;
};

}  // namespace

std::optional<std::string> peer_name() {
  constexpr int kHundreds = 100;
  return "Bullet " + std::to_string(btGetVersion() / kHundreds) + "." +
         std::to_string(btGetVersion() % kHundreds);
}

std::unique_ptr<Peer> make_peer(const PeerSetup& setup) { return std::make_unique<BulletPeer>(setup); }

}  // namespace palpate::bench
