#include "reference/experiments.hpp"

#include <algorithm>
#include <cmath>

namespace palpate::reference {
namespace {

constexpr double kOnFace = 1e-9;  // m

/// A rigid motion x -> turn x + shift.
struct Motion {
  Matrix turn;
  Vector shift;
};

Matrix turned_about(const Vector& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// The bar's cross-sections on their way: twisted about the centre line, which is an arc.
class Arc {
 public:
  Arc(double length, const EndTurn& turn, BendFrame frame) : length_(length), turn_(turn), frame_(frame) {}

  /// The motion of the cross-section at z of the rest shape.
  [[nodiscard]] Motion section(double z) const {
    Motion section = bent_section(z);
    if (frame_ == BendFrame::kHeldEnd) {
      const Motion out = to_held_end();
      section = Motion{out.turn * section.turn, out.turn * section.shift + out.shift};
    }
    // Turns about a point of the axis, so that the shift stays.
    section.turn *= turned_about(Vector::UnitZ(), turn_.twist_rad * (z / length_ + 0.5));
    return section;
  }

  /// From the frame of the middle to the one in which the section at -length / 2 does not move.
  [[nodiscard]] Motion to_held_end() const {
    const Motion held = bent_section(-length_ / 2);
    const Matrix back = held.turn.transpose();
    return Motion{back, -back * held.shift};
  }

 private:
  [[nodiscard]] Motion bent_section(double z) const {
    if (turn_.bend_rad == 0.0) return Motion{Matrix::Identity(), Vector::Zero()};
    const double radius = length_ / turn_.bend_rad;
    const double a = z / radius;
    const Matrix turn = turned_about(Vector::UnitY(), a);
    const Vector centre(radius * (1.0 - std::cos(a)), 0.0, radius * std::sin(a));
    return Motion{turn, centre - turn * Vector(0, 0, z)};
  }

  double length_;
  EndTurn turn_;
  BendFrame frame_;
};

EndTurn part_of(const EndTurn& turn, double load) {
  return EndTurn{turn.bend_rad * load, turn.twist_rad * load};
}

std::vector<bool> nodes_on_ends(const Mesh& mesh, bool both_ends) {
  const double half = upper_corner(mesh)[2];
  std::vector<bool> on(mesh.rest.size());
  for (uint32_t i = 0; i < on.size(); ++i) {
    const double z = mesh.rest[i][2];
    on[i] = std::abs(z + half) < kOnFace || (both_ends && std::abs(z - half) < kOnFace);
  }
  return on;
}

}  // namespace

StaticProblem turned_end_problem(const Mesh& mesh, const Material& material, const EndTurn& turn,
                                 BendFrame frame, int load_steps) {
  StaticProblem problem;
  problem.mesh = mesh;
  problem.materials = {material};
  problem.prescribed = nodes_on_ends(mesh, true);
  problem.load_steps = load_steps;
  const double length = 2.0 * upper_corner(mesh)[2];
  problem.place = [rest = mesh.rest, prescribed = problem.prescribed, length, turn, frame, load_steps](
                      double load, Positions& x) {
    const Arc arc(length, part_of(turn, load), frame);
    const Arc before(length, part_of(turn, load - 1.0 / load_steps), frame);
    for (uint32_t i = 0; i < x.size(); ++i) {
      const Motion now = arc.section(rest[i][2]);
      const Motion then = before.section(rest[i][2]);
      const Vector offset = prescribed[i] ? Vector(Vector::Zero())
                                          : Vector(then.turn.transpose() * (x[i] - then.shift) - rest[i]);
      x[i] = now.turn * (rest[i] + offset) + now.shift;
    }
  };
  return problem;
}

StaticProblem bend_problem(const Mesh& mesh, const Material& material, double angle_rad, BendFrame frame,
                           int load_steps) {
  return turned_end_problem(mesh, material, EndTurn{angle_rad, 0.0}, frame, load_steps);
}

StaticProblem twist_problem(const Mesh& mesh, const Material& material, double angle_rad) {
  return turned_end_problem(mesh, material, EndTurn{0.0, angle_rad}, BendFrame::kHeldEnd);
}

Positions in_held_end_frame(Positions x, double length_m, double bend_rad) {
  const Motion motion = Arc(length_m, EndTurn{bend_rad, 0.0}, BendFrame::kMiddle).to_held_end();
  for (Vector& p : x) p = motion.turn * p + motion.shift;
  return x;
}

StaticProblem driven_node_problem(const Mesh& mesh, const Material& material, bool both_ends, uint32_t node,
                                  const Vector& displacement) {
  StaticProblem problem;
  problem.mesh = mesh;
  problem.materials = {material};
  problem.prescribed = nodes_on_ends(mesh, both_ends);
  problem.prescribed[node] = true;
  problem.place = [at_rest = mesh.rest[node], node, displacement](double load, Positions& x) {
    x[node] = at_rest + load * displacement;
  };
  return problem;
}

StaticProblem corner_problem(const Mesh& mesh, const Material& material, double displacement_m) {
  return driven_node_problem(mesh, material, false, node_nearest(mesh, upper_corner(mesh)),
                             Vector(0, displacement_m, 0));
}

StaticProblem indentation_problem(const Mesh& mesh, const Material& material, double depth_m) {
  const Vector middle(upper_corner(mesh)[0], 0, 0);
  return driven_node_problem(mesh, material, true, node_nearest(mesh, middle), Vector(-depth_m, 0, 0));
}

uint32_t node_nearest(const Mesh& mesh, const Vector& point) {
  const auto nearer = [&](const Vector& a, const Vector& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  };
  return static_cast<uint32_t>(std::min_element(mesh.rest.begin(), mesh.rest.end(), nearer) -
                               mesh.rest.begin());
}

Vector upper_corner(const Mesh& mesh) {
  Vector corner = mesh.rest.front();
  for (const Vector& x : mesh.rest) corner = corner.cwiseMax(x);
  return corner;
}

Distance distance_of(const Positions& a, const Positions& b, const std::vector<bool>& prescribed) {
  Distance distance{0.0, 0.0, 1e300};
  double count = 0.0;
  for (uint32_t i = 0; i < a.size(); ++i) {
    if (prescribed[i]) continue;
    const double d = 1e3 * (a[i] - b[i]).norm();
    distance.mean_mm += d;
    distance.max_mm = std::max(distance.max_mm, d);
    distance.min_mm = std::min(distance.min_mm, d);
    count += 1.0;
  }
  distance.mean_mm /= count;
  return distance;
}

double volume_change(const Mesh& mesh, const Positions& x) {
  double rest = 0.0;
  double now = 0.0;
  for (const Element& element : elements_of(mesh)) {
    rest += element.volume;
    now += element.volume * deformation_gradient(element, x).determinant();
  }
  return now / rest - 1.0;
}

}  // namespace palpate::reference
