// The core's tick in double precision: the same stages in the same order, exact polar rotations, no rounding
// and no clamps. Stepped beside the core it shows what fixed point costs. With another elastic model it is
// what the paper compares with.
#pragma once

#include <array>
#include <vector>

#include "reference/elastic_model.hpp"

namespace palpate::reference {

struct RigidMotion {
  Matrix rotation = Matrix::Identity();
  Vector translation = Vector::Zero();  // m
};

struct BodyParameters {
  std::vector<Material> materials;
  uint32_t substeps = 1;           // a tick of 1 ms
  double mass_damping_per_s = 0;   // alpha_M
  double stiffness_damping_s = 0;  // beta_K
  double grasp_reach_m = 0;
  ElasticModel model = ElasticModel::kCorotation;
};

struct BodyInput {
  Vector tool = Vector::Zero();  // m, in the body's frame
  bool close_grasp = false;
  std::array<RigidMotion, 2> hold_motion;  // where the held regions are at the end of this tick
};

class ReferenceBody {
 public:
  static constexpr double kTickSeconds = 1e-3;
  static constexpr uint32_t kNobody = 0xffffffff;

  /// held: for each node 0 (free), or 1 or 2 (moved by hold_motion[0] or [1]).
  ReferenceBody(const Mesh& mesh, const BodyParameters& parameters, std::vector<uint8_t> held);

  /// 1 ms. Returns the reaction: the elastic force on the grasped node in the last substep, N; zero without a
  /// grasp.
  Vector tick(const BodyInput& input);

  [[nodiscard]] const Positions& position() const { return position_; }
  [[nodiscard]] const std::vector<Vector>& velocity() const { return velocity_; }  // m/s
  [[nodiscard]] uint32_t grasped() const { return grasped_; }
  void set_state(const Positions& position, const std::vector<Vector>& velocity);

 private:
  void update_grasp(const BodyInput& input);
  void update_rotations();
  void evaluate_forces();
  [[nodiscard]] ElementForces forces_of_element(uint32_t i) const;
  void integrate(const BodyInput& input, uint32_t remaining);

  std::vector<Element> elements_;
  BodyParameters parameters_;
  std::vector<uint8_t> held_;
  std::vector<double> mass_;
  Positions rest_, position_, force_position_;
  std::vector<Vector> velocity_, force_;
  std::vector<Matrix> rotation_;
  std::vector<Matrix> seen_;  // deformation gradients of the last evaluation, which the next rotations are of
  uint32_t grasped_ = kNobody;
  Vector grasp_offset_ = Vector::Zero();
  bool was_closed_ = false;
};

}  // namespace palpate::reference
