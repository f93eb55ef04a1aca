#include "reference/static_solver.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "reference/stiffness.hpp"

namespace palpate::reference {
namespace {

constexpr int kMostNewtonSteps = 60;
constexpr double kShortestStep = 1e-6;

using Factors = Eigen::SimplicialLDLT<SparseMatrix>;

template <uint32_t Nodes>
class LoadStep {
 public:
  LoadStep(const StaticProblem& problem, const std::vector<ElementOf<Nodes>>& elements, const FreeNodes& free)
      : problem_(problem), elements_(elements), free_(free) {}

  /// Iterates until the residual is below the tolerance. Returns the iterations, or -1.
  int solve(Positions& x, double& residual) const {
    for (int i = 0; i < kMostNewtonSteps; ++i) {
      const Eigen::VectorXd force = free_forces(x);
      residual = force.cwiseAbs().maxCoeff();
      if (residual < problem_.tolerance_n) return i;
      const Eigen::VectorXd step = newton_step(x, force);
      if (!search(x, force, step, residual)) return -1;
    }
    return -1;
  }

 private:
  [[nodiscard]] Eigen::VectorXd free_forces(const Positions& x) const {
    const std::vector<Vector> forces = static_forces(elements_, problem_.materials, x, problem_.model);
    Eigen::VectorXd free(free_.coordinates());
    for (uint32_t node = 0; node < x.size(); ++node) {
      if (free_.is_free(node)) free.segment<3>(free_.first_coordinate(node)) = forces[node];
    }
    return free;
  }

  [[nodiscard]] SparseMatrix stiffness(const Positions& x, Tangent kind) const {
    return assemble_stiffness(elements_, problem_.materials, x, free_, kind, problem_.model);
  }

  /// With the exact tangent where it is positive definite, else with its positive part.
  [[nodiscard]] Eigen::VectorXd newton_step(const Positions& x, const Eigen::VectorXd& force) const {
    Factors exact(stiffness(x, Tangent::kExact));
    if (exact.info() == Eigen::Success && exact.vectorD().minCoeff() > 0) return exact.solve(force);
    Factors positive(stiffness(x, Tangent::kPositive));
    return positive.solve(force);
  }

  [[nodiscard]] double energy(const Positions& x) const {
    return static_energy(elements_, problem_.materials, x, problem_.model);
  }

  [[nodiscard]] Positions moved(const Positions& x, const Eigen::VectorXd& step, double length) const {
    Positions next = x;
    for (uint32_t node = 0; node < x.size(); ++node) {
      if (free_.is_free(node)) next[node] += length * step.segment<3>(free_.first_coordinate(node));
    }
    return next;
  }

  /// Halves the step until the energy falls; near the solution, where its change drowns in rounding, until
  /// the residual falls.
  bool search(Positions& x, const Eigen::VectorXd& force, const Eigen::VectorXd& step,
              double residual) const {
    const double before = energy(x);
    for (double length = 1.0; length > kShortestStep; length /= 2) {
      const Positions next = moved(x, step, length);
      const double promised = length * force.dot(step);
      const bool lower = energy(next) < before - 1e-4 * promised;
      if (lower || free_forces(next).cwiseAbs().maxCoeff() < 0.5 * residual) {
        x = next;
        return true;
      }
    }
    return false;
  }

  const StaticProblem& problem_;
  const std::vector<ElementOf<Nodes>>& elements_;
  const FreeNodes& free_;
};

}  // namespace

template <uint32_t Nodes>
std::vector<Vector> static_forces(const std::vector<ElementOf<Nodes>>& elements,
                                  const std::vector<Material>& materials, const Positions& x,
                                  ElasticModel model) {
  std::vector<Vector> forces(x.size(), Vector::Zero());
  for (const ElementOf<Nodes>& element : elements) {
    const Matrix p = stress_of(model, deformation_gradient(element, x), materials[element.region]);
    for (uint32_t i = 0; i < Nodes; ++i)
      forces[element.node[i]] -= element.volume * (p * element.gradient[i]);
  }
  return forces;
}

template <uint32_t Nodes>
double static_energy(const std::vector<ElementOf<Nodes>>& elements, const std::vector<Material>& materials,
                     const Positions& x, ElasticModel model) {
  double energy = 0.0;
  for (const ElementOf<Nodes>& element : elements) {
    energy += element.volume * energy_of(model, deformation_gradient(element, x), materials[element.region]);
  }
  return energy;
}

template <uint32_t Nodes>
StaticSolution solve_static(const StaticProblem& problem, const std::vector<ElementOf<Nodes>>& elements) {
  const FreeNodes free(problem.prescribed);
  const LoadStep<Nodes> step(problem, elements, free);
  StaticSolution solution{problem.mesh.rest, {}, 0.0, 0, true};
  for (int i = 1; i <= problem.load_steps && solution.converged; ++i) {
    problem.place(static_cast<double>(i) / problem.load_steps, solution.x);
    const int iterations = step.solve(solution.x, solution.residual_n);
    solution.converged = iterations >= 0;
    solution.iterations += std::max(iterations, 0);
  }
  solution.force = static_forces(elements, problem.materials, solution.x, problem.model);
  return solution;
}

StaticSolution solve_static(const StaticProblem& problem) {
  return solve_static(problem, elements_of(problem.mesh));
}

template std::vector<Vector> static_forces(const std::vector<ElementOf<4>>&, const std::vector<Material>&,
                                           const Positions&, ElasticModel);
template std::vector<Vector> static_forces(const std::vector<ElementOf<10>>&, const std::vector<Material>&,
                                           const Positions&, ElasticModel);
template double static_energy(const std::vector<ElementOf<4>>&, const std::vector<Material>&,
                              const Positions&, ElasticModel);
template double static_energy(const std::vector<ElementOf<10>>&, const std::vector<Material>&,
                              const Positions&, ElasticModel);
template StaticSolution solve_static(const StaticProblem&, const std::vector<ElementOf<4>>&);
template StaticSolution solve_static(const StaticProblem&, const std::vector<ElementOf<10>>&);

}  // namespace palpate::reference
