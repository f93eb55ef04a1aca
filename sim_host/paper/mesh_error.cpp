#include "paper/mesh_error.hpp"

#include <algorithm>
#include <stdexcept>

namespace palpate::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

Vector3d at(const std::vector<std::array<double, 3>>& points, uint32_t i) {
  return Vector3d(points[i].data());
}

/// The displacement of a body at any place of its rest shape.
class Displacement {
 public:
  explicit Displacement(const BodyFields& body) : body_(body) {
    for (const auto& tet : body.tets) {
      Eigen::Matrix3d edges;
      for (int i = 0; i < 3; ++i)
        edges.col(i) = at(body.rest_mm, tet[static_cast<std::size_t>(i) + 1]) - at(body.rest_mm, tet[0]);
      inverse_.push_back(edges.inverse());
    }
  }

  [[nodiscard]] Vector3d at_rest_place(const Vector3d& place) const {
    constexpr double kOutside = -1e-9;
    for (std::size_t t = 0; t < body_.tets.size(); ++t) {
      const Vector3d last = inverse_[t] * (place - at(body_.rest_mm, body_.tets[t][0]));
      const Vector4d weight(1.0 - last.sum(), last[0], last[1], last[2]);
      if (weight.minCoeff() >= kOutside) return mean(body_.tets[t], weight);
    }
    throw std::logic_error("a mesh does not cover the body");
  }

 private:
  [[nodiscard]] Vector3d mean(const std::array<uint32_t, 4>& tet, const Vector4d& weight) const {
    Vector3d sum = Vector3d::Zero();
    for (uint32_t i = 0; i < 4; ++i)
      sum += weight[i] * (at(body_.now_mm, tet[i]) - at(body_.rest_mm, tet[i]));
    return sum;
  }

  const BodyFields& body_;
  std::vector<Eigen::Matrix3d> inverse_;
};

}  // namespace

MeshError error_of(const BodyFields& coarse, const BodyFields& fine, const std::vector<bool>& is_free) {
  const Displacement displacement(coarse);
  MeshError error{0.0, 0.0};
  double count = 0.0;
  for (uint32_t i = 0; i < fine.rest_mm.size(); ++i) {
    if (!is_free[i]) continue;
    const Vector3d own = at(fine.now_mm, i) - at(fine.rest_mm, i);
    const double distance = (displacement.at_rest_place(at(fine.rest_mm, i)) - own).norm();
    error.mean_mm += distance;
    error.max_mm = std::max(error.max_mm, distance);
    count += 1.0;
  }
  error.mean_mm /= std::max(count, 1.0);
  return error;
}

}  // namespace palpate::sim
