#include "reference/adaptive_corotation.hpp"

#include "reference/anderson.hpp"
#include "reference/polar_rotation.hpp"

namespace palpate::reference {
namespace {

constexpr int kMostIterations = 400;
constexpr std::size_t kAndersonDepth = 12;
constexpr double kToleranceM = 2e-10;  // of the largest component of K^-1 f
constexpr double kLongestStepM = 0.01;

std::vector<Element> elements_of_tree(const BisectionTree& tree) {
  Mesh mesh;
  mesh.rest = tree.mesh.rest;
  for (const TreeTet& tet : tree.tet) {
    mesh.tet.push_back(tet.node);
    mesh.region.push_back(0);
  }
  return elements_of(mesh);
}

}  // namespace

AdaptiveCorotation::AdaptiveCorotation(const BisectionTree& tree, const StaticProblem& problem,
                                       RotationSource source)
    : tree_(&tree),
      source_(source),
      material_(problem.materials[0]),
      prescribed_(problem.prescribed),
      free_(problem.prescribed),
      leaves_(elements_of(tree.mesh)),
      tets_(elements_of_tree(tree)),
      full_(solve_static(problem)),
      factors_(assemble_stiffness(leaves_, problem.materials, full_.x, free_, Tangent::kExact)),
      gradient_(leaves_.size()),
      rotation_(tree.tet.size(), Matrix::Identity()) {
  reset();
}

void AdaptiveCorotation::reset() {
  x_ = full_.x;
  force_ = full_.force;
  update_gradients();
  for (uint32_t t = 0; t < rotation_.size(); ++t) rotation_[t] = rotation_as_group(t);
}

void AdaptiveCorotation::update_gradients() {
  for (uint32_t i = 0; i < leaves_.size(); ++i) gradient_[i] = deformation_gradient(leaves_[i], x_);
}

Matrix AdaptiveCorotation::rotation_as_group(uint32_t tet) const {
  if (source_ == RotationSource::kOwnNodes) {
    return polar_rotation(deformation_gradient(tets_[tet], x_), rotation_[tet]);
  }
  const TreeTet& group = tree_->tet[tet];
  Matrix sum = Matrix::Zero();
  for (uint32_t i = group.first_leaf; i < group.end_leaf; ++i) sum += leaves_[i].volume * gradient_[i];
  return polar_rotation(sum / group.volume, rotation_[tet]);
}

void AdaptiveCorotation::evaluate(const std::vector<uint32_t>& groups) {
  update_gradients();
  std::fill(force_.begin(), force_.end(), Vector::Zero());
  for (const uint32_t group : groups) {
    rotation_[group] = rotation_as_group(group);
    for (uint32_t i = tree_->tet[group].first_leaf; i < tree_->tet[group].end_leaf; ++i) {
      const ElementForces part = forces_of(leaves_[i], gradient_[i], rotation_[group], material_);
      for (uint32_t k = 0; k < 4; ++k) force_[leaves_[i].node[k]] += part[k];
    }
  }
}

Eigen::VectorXd AdaptiveCorotation::free_part(const std::vector<Vector>& values) const {
  Eigen::VectorXd part(free_.coordinates());
  for (uint32_t node = 0; node < values.size(); ++node) {
    if (free_.is_free(node)) part.segment<3>(free_.first_coordinate(node)) = values[node];
  }
  return part;
}

bool AdaptiveCorotation::iterate(const std::vector<uint32_t>& groups) {
  Anderson acceleration(kAndersonDepth);
  for (int i = 0; i < kMostIterations; ++i) {
    evaluate(groups);
    const Eigen::VectorXd g = response(free_part(force_));
    const double largest = g.cwiseAbs().maxCoeff();
    if (largest < kToleranceM) return true;
    if (!(largest < 1.0)) return false;
    Eigen::VectorXd step = acceleration.step(free_part(x_), g);
    step *= std::min(1.0, kLongestStepM / step.cwiseAbs().maxCoeff());
    for (uint32_t node = 0; node < x_.size(); ++node) {
      if (free_.is_free(node)) x_[node] += step.segment<3>(free_.first_coordinate(node));
    }
  }
  return false;
}

bool AdaptiveCorotation::settle(const Front& front) {
  const std::vector<uint32_t> groups = front.tets();
  if (iterate(groups)) return true;
  reset();
  return iterate(groups);
}

}  // namespace palpate::reference
