// The paper's method, static and in doubles: leaves take the rotation of their group, P = R (2 mu e + lambda
// tr(e) I), e = sym(R^T F) - I, and the equilibrium is found for the rotations that belong to it.
#pragma once

#include <Eigen/SparseCholesky>

#include "reference/experiments.hpp"
#include "reference/front.hpp"
#include "reference/stiffness.hpp"

namespace palpate::reference {

/// Where a group's rotation comes from: the polar rotation of the F of its own four nodes, or of the volume
/// mean of its leaves' F.
enum class RotationSource { kOwnNodes, kMeanGradient };

class AdaptiveCorotation {
 public:
  /// Solves full corotation, which everything is compared with. `problem` is on tree.mesh; the tree must
  /// outlive this.
  AdaptiveCorotation(const BisectionTree& tree, const StaticProblem& problem, RotationSource source);

  /// Equilibrium with the groups of `front`, to 1e-9 m, from the last one found. The iteration is x += K^-1
  /// f(x), K the exact tangent of full corotation, with Anderson's acceleration (Walker and Ni 2011). False
  /// if it does not converge, also not from full corotation.
  bool settle(const Front& front);

  [[nodiscard]] const BisectionTree& tree() const { return *tree_; }
  [[nodiscard]] const std::vector<Element>& leaves() const { return leaves_; }
  [[nodiscard]] const Material& material() const { return material_; }
  [[nodiscard]] const FreeNodes& free_nodes() const { return free_; }
  [[nodiscard]] const StaticSolution& full() const { return full_; }
  /// Of the last equilibrium: positions; F of leaf i; forces on all nodes, N; the rotation of a group.
  [[nodiscard]] const Positions& position() const { return x_; }
  [[nodiscard]] const Matrix& gradient(uint32_t leaf) const { return gradient_[leaf]; }
  [[nodiscard]] const std::vector<Vector>& force() const { return force_; }
  [[nodiscard]] const Matrix& rotation(uint32_t group) const { return rotation_[group]; }
  /// The rotation that any tet of the tree would have as a group.
  [[nodiscard]] Matrix rotation_as_group(uint32_t tet) const;

  /// Of the last equilibrium from full corotation, over the free nodes.
  [[nodiscard]] Distance error() const { return distance_of(x_, full_.x, prescribed_); }
  /// K^-1 f for forces on the free coordinates: the response of full corotation, to first order, m.
  [[nodiscard]] Eigen::VectorXd response(const Eigen::VectorXd& force) const { return factors_.solve(force); }
  /// Back to full corotation's equilibrium.
  void reset();

 private:
  bool iterate(const std::vector<uint32_t>& groups);
  void evaluate(const std::vector<uint32_t>& groups);
  [[nodiscard]] Eigen::VectorXd free_part(const std::vector<Vector>& values) const;
  void update_gradients();

  const BisectionTree* tree_;
  RotationSource source_;
  Material material_;
  std::vector<bool> prescribed_;
  FreeNodes free_;
  std::vector<Element> leaves_;
  std::vector<Element> tets_;  // of the tree, for rotations from own nodes
  StaticSolution full_;
  Eigen::SimplicialLDLT<SparseMatrix> factors_;
  Positions x_;
  std::vector<Vector> force_;
  std::vector<Matrix> gradient_, rotation_;
};

}  // namespace palpate::reference
