// Anderson's acceleration of a fixed-point iteration x += g(x): the next x is the combination of the last
// ones whose g is smallest in the least-squares sense. Source: Walker and Ni, Anderson acceleration for
// fixed-point iterations, SIAM J. Numer. Anal. 49 (2011).
#pragma once

#include <Eigen/Dense>
#include <deque>

namespace palpate::reference {

class Anderson {
 public:
  explicit Anderson(std::size_t depth) : depth_(depth) {}

  /// The step from x, given g = g(x).
  Eigen::VectorXd step(const Eigen::VectorXd& x, const Eigen::VectorXd& g) {
    remember(x, g);
    if (dx_.empty()) return g;
    const auto columns = static_cast<Eigen::Index>(dx_.size());
    Eigen::MatrixXd changes(g.size(), columns);
    for (Eigen::Index k = 0; k < columns; ++k) changes.col(k) = dg_[static_cast<std::size_t>(k)];
    const Eigen::VectorXd weight = changes.householderQr().solve(g);
    Eigen::VectorXd step = g;
    for (Eigen::Index k = 0; k < columns; ++k) {
      step -= weight[k] * (dx_[static_cast<std::size_t>(k)] + dg_[static_cast<std::size_t>(k)]);
    }
    return step;
  }

 private:
  void remember(const Eigen::VectorXd& x, const Eigen::VectorXd& g) {
    if (x_.size() > 0) {
      dx_.push_back(x - x_);
      dg_.push_back(g - g_);
    }
    if (dx_.size() > depth_) {
      dx_.pop_front();
      dg_.pop_front();
    }
    x_ = x;
    g_ = g;
  }

  std::size_t depth_;
  std::deque<Eigen::VectorXd> dx_, dg_;
  Eigen::VectorXd x_, g_;
};

}  // namespace palpate::reference
