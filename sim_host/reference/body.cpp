#include "reference/body.hpp"

#include <utility>

#include "reference/polar_rotation.hpp"

namespace palpate::reference {

ReferenceBody::ReferenceBody(const Mesh& mesh, const BodyParameters& parameters, std::vector<uint8_t> held)
    : elements_(elements_of(mesh)),
      parameters_(parameters),
      held_(std::move(held)),
      mass_(lumped_masses(mesh, parameters.materials)),
      rest_(mesh.rest),
      position_(mesh.rest),
      force_position_(mesh.rest),
      velocity_(mesh.rest.size(), Vector::Zero()),
      force_(mesh.rest.size(), Vector::Zero()),
      rotation_(mesh.tet.size(), Matrix::Identity()),
      seen_(mesh.tet.size(), Matrix::Identity()) {}

Vector ReferenceBody::tick(const BodyInput& input) {
  update_grasp(input);
  update_rotations();
  for (uint32_t remaining = parameters_.substeps; remaining > 0; --remaining) {
    evaluate_forces();
    integrate(input, remaining);
  }
  return grasped_ == kNobody ? Vector(Vector::Zero()) : force_[grasped_];
}

void ReferenceBody::set_state(const Positions& position, const std::vector<Vector>& velocity) {
  position_ = position;
  velocity_ = velocity;
  for (uint32_t i = 0; i < position.size(); ++i) {
    force_position_[i] = position[i] + parameters_.stiffness_damping_s * velocity[i];
  }
  for (uint32_t i = 0; i < elements_.size(); ++i)
    seen_[i] = deformation_gradient(elements_[i], force_position_);
}

void ReferenceBody::update_grasp(const BodyInput& input) {
  const bool closes = input.close_grasp && !was_closed_;
  was_closed_ = input.close_grasp;
  if (!input.close_grasp) grasped_ = kNobody;
  if (!closes) return;
  double least = parameters_.grasp_reach_m;
  for (uint32_t node = 0; node < position_.size(); ++node) {
    const double distance = (position_[node] - input.tool).norm();
    const bool closer = distance < least || (distance == least && grasped_ == kNobody);
    if (!closer) continue;
    least = distance;
    grasped_ = node;
  }
  if (grasped_ != kNobody) grasp_offset_ = position_[grasped_] - input.tool;
}

void ReferenceBody::update_rotations() {
  if (parameters_.model != ElasticModel::kCorotation) return;
  for (uint32_t i = 0; i < elements_.size(); ++i) {
    rotation_[i] = polar_rotation(seen_[i], rotation_[i]);
  }
}

ElementForces ReferenceBody::forces_of_element(uint32_t i) const {
  const Element& element = elements_[i];
  const Material& material = parameters_.materials[element.region];
  const Matrix& f = seen_[i];
  if (parameters_.model == ElasticModel::kCorotation) return forces_of(element, f, rotation_[i], material);
  const Matrix p = stress_of(parameters_.model, f, material);
  ElementForces force;
  for (uint32_t k = 0; k < 4; ++k) force[k] = -element.volume * (p * element.gradient[k]);
  return force;
}

void ReferenceBody::evaluate_forces() {
  for (Vector& force : force_) force.setZero();
  for (uint32_t i = 0; i < elements_.size(); ++i) {
    seen_[i] = deformation_gradient(elements_[i], force_position_);
    const ElementForces part = forces_of_element(i);
    for (uint32_t k = 0; k < 4; ++k) force_[elements_[i].node[k]] += part[k];
  }
}

void ReferenceBody::integrate(const BodyInput& input, uint32_t remaining) {
  const double dt = kTickSeconds / parameters_.substeps;
  const double fraction = 1.0 / remaining;
  for (uint32_t node = 0; node < position_.size(); ++node) {
    Vector& x = position_[node];
    Vector& v = velocity_[node];
    if (node != grasped_ && held_[node] == 0) {
      v += dt * (force_[node] / mass_[node] - parameters_.mass_damping_per_s * v);
      x += dt * v;
    } else {
      const RigidMotion& motion = input.hold_motion[held_[node] == 2 ? 1 : 0];
      const Vector target = node == grasped_ ? Vector(input.tool + grasp_offset_)
                                             : Vector(motion.rotation * rest_[node] + motion.translation);
      v = (target - x) * (fraction / dt);
      x += dt * v;
    }
    force_position_[node] = x + parameters_.stiffness_damping_s * v;
  }
}

}  // namespace palpate::reference
