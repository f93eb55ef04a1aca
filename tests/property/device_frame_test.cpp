// Between the device's frame and the body's: against doubles, there and back, and what it keeps.
#include <gtest/gtest.h>

#include "model_parameters.hpp"
#include "palpate/firmware/scene.hpp"
#include "support/fixed.hpp"
#include "support/random.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using phantom::Metre;
using phantom::Newton;

constexpr double kPositionLsb = 1.0 / (1 << Position::kFractionBits);
constexpr double kNewtonLsb = 1.0 / (1 << Newton::kFractionBits);
/// Of the exact position: the turn in metres, its product with edges a metre, and their own rounding.
constexpr double kPositionError = 8.0 * kPositionLsb;

Vector3d vector_of(const std::array<double, 3>& a) { return Vector3d(a.data()); }

struct Mapping {
  sim::ModelParameters parameters;
  sim::SceneParameters in_si;
  firmware::Scene scene;
  Matrix3d rotation;  // R

  [[nodiscard]] Vector3d edges_of(const Vector3d& device_m) const {
    const Vector3d from_centre = device_m - vector_of(in_si.body_centre_in_device_m);
    return rotation * from_centre * in_si.motion_scale / parameters.edge_m;
  }
  [[nodiscard]] double newtons_per_unit() const {
    return sim::newtons_per_unit(parameters) * in_si.force_scale;
  }
};

/// Roll, pitch and yaw about the body's axes, written down on their own.
Matrix3d rotation_of(const std::array<double, 3>& degrees) {
  const auto turn = [&](std::size_t i, const Vector3d& axis) {
    return Eigen::AngleAxisd(degrees[i] * 3.14159265358979323846 / 180.0, axis).toRotationMatrix();
  };
  return turn(2, Vector3d::UnitZ()) * turn(1, Vector3d::UnitY()) * turn(0, Vector3d::UnitX());
}

Mapping random_mapping(Random& random) {
  Mapping mapping{};
  mapping.parameters.edge_m = 0.072 + 0.056 * random.centred();
  const double most_scale = std::min(8.0, mapping.parameters.edge_m / 0.016);
  mapping.in_si.motion_scale = 0.1 * std::pow(most_scale / 0.1, 0.5 + 0.5 * random.centred());
  mapping.in_si.force_scale = std::pow(10.0, random.centred());
  for (double& degrees : mapping.in_si.device_rotation_deg) degrees = 180.0 * random.centred();
  const double reach_m = 4.0 * mapping.parameters.edge_m / mapping.in_si.motion_scale / std::sqrt(3.0);
  for (double& x : mapping.in_si.body_centre_in_device_m) x = std::min(0.3, reach_m) * random.centred();
  mapping.scene = compile_scene(mapping.in_si, mapping.parameters);
  mapping.rotation = rotation_of(mapping.in_si.device_rotation_deg);
  return mapping;
}

/// Where the arm gets, and the tool within 8 edges of the device's origin.
Vector3d random_place(Random& random, const Mapping& mapping) {
  const double reach_m = 7.9 * mapping.parameters.edge_m / mapping.in_si.motion_scale / std::sqrt(3.0);
  return std::min(0.5, reach_m) * random.vector();
}

std::array<double, 3> vector_in(Random& random, double most) {
  const Vector3d v = most * random.vector();
  return {v[0], v[1], v[2]};
}

/// As the mapping was before it could turn.
TEST(DeviceFrame, IdentityKeepsEveryBit) {
  Random random(401);
  for (uint32_t round = 0; round < in_soak(1000000u, 20000u); ++round) {
    sim::ModelParameters parameters;
    parameters.edge_m = 0.072 + 0.056 * random.centred();
    sim::SceneParameters in_si;
    in_si.body_centre_in_device_m = vector_in(random, 4.0 * parameters.edge_m);
    const firmware::Scene scene = compile_scene(in_si, parameters);
    ASSERT_EQ(scene.device_rotation, firmware::kNotTurned);
    const auto device = fixed_vector<Metre>(0.999 * random.vector());
    const auto reaction = fixed_vector<Force>(63.9 * random.vector());
    const Vector3<Position> tool = in_body_frame(scene, device);
    const Vector3<Newton> force = on_handle(scene, reaction);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto edges = narrow_saturated<Position>(device[axis] * scene.edges_per_metre);
      const Position origin = scene.device_origin[static_cast<std::size_t>(axis)];
      ASSERT_EQ(tool[axis], clamp(edges, -Position::ratio(8, 1), Position::ratio(8, 1)) + origin);
      const int64_t product = (reaction[axis] * scene.newton_mantissa).raw();
      const int64_t newtons = shift_right_rounded(
          product, Force::kFractionBits + 31 - Newton::kFractionBits - scene.newton_exponent);
      ASSERT_EQ(force[axis], narrow_saturated<Newton>(Acc<Newton::kFractionBits>::from_raw(newtons)));
    }
  }
}

TEST(DeviceFrame, IsRollPitchAndYaw) {
  // A device that stands turned by 90 degrees to the left: what it calls forwards (x) is the body's y.
  sim::SceneParameters in_si;
  in_si.device_rotation_deg = {0.0, 0.0, 90.0};
  in_si.body_centre_in_device_m = {0.0, 0.0, 0.0};
  const firmware::Scene scene = compile_scene(in_si, {});
  const Vector3<Position> x = in_body_frame(scene, fixed_vector<Metre>(Vector3d(0.064, 0.0, 0.0)));
  EXPECT_NEAR((doubles(x) - Vector3d::UnitY()).norm(), 0.0, 2 * kPositionLsb);
  Random random(402);
  for (int round = 0; round < 200; ++round) {
    const Mapping mapping = random_mapping(random);
    for (int i = 0; i < 9; ++i) {
      const RotationEntry entry = mapping.scene.device_rotation[static_cast<std::size_t>(i)];
      ASSERT_NEAR(sim::to_double(entry), mapping.rotation(i / 3, i % 3), std::ldexp(0.51, -30));
    }
  }
}

TEST(DeviceFrame, PositionsFollowDoublesAndComeBack) {
  Random random(403);
  double largest = 0.0;
  double largest_m = 0.0;
  for (uint32_t round = 0; round < in_soak(1000000u, 20000u); ++round) {
    const Mapping mapping = random_mapping(random);
    const auto device = fixed_vector<Metre>(random_place(random, mapping));
    const Vector3d tool = doubles(in_body_frame(mapping.scene, device));
    largest = std::max(largest, (tool - mapping.edges_of(doubles(device))).cwiseAbs().maxCoeff());
    const auto back =
        in_device_m(mapping.in_si, {tool[0] * mapping.parameters.edge_m, tool[1] * mapping.parameters.edge_m,
                                    tool[2] * mapping.parameters.edge_m});
    const double edge_of_handle_m = mapping.parameters.edge_m / mapping.in_si.motion_scale;
    const double error_m = (vector_of(back) - doubles(device)).norm();
    ASSERT_LE(error_m, std::sqrt(3.0) * kPositionError * edge_of_handle_m);
    largest_m = std::max(largest_m, error_m);
  }
  std::printf("positions are within %.1f LSB; there and back within %.1f nm\n", largest / kPositionLsb,
              largest_m * 1e9);
  EXPECT_LE(largest, kPositionError);
}

TEST(DeviceFrame, ForcesFollowDoublesAndComeBack) {
  Random random(404);
  double largest = 0.0;
  for (uint32_t round = 0; round < in_soak(1000000u, 20000u); ++round) {
    const Mapping mapping = random_mapping(random);
    const double unit_n = mapping.newtons_per_unit();
    const auto force = fixed_vector<Force>(random.vector() * std::min(1.0, 9.0 / unit_n));
    const Vector3d handle = doubles(on_handle(mapping.scene, force));
    const Vector3d exact = mapping.rotation.transpose() * doubles(force) * unit_n;
    // Of the turned force 1.5 LSB, which are as much larger as the unit, and of the newtons half a one.
    const double error_n = (handle - exact).cwiseAbs().maxCoeff();
    ASSERT_LE(error_n, 1.5 * kForceLsb * unit_n + 1.0 * kNewtonLsb);
    const Vector3d back = mapping.rotation * handle / unit_n;
    ASSERT_LE((back - doubles(force)).norm(), std::sqrt(3.0) * (1.5 * kForceLsb + kNewtonLsb / unit_n));
    largest = std::max(largest, error_n / (kForceLsb * unit_n + kNewtonLsb));
  }
  std::printf("forces are within %.2f LSB of both formats\n", largest);
}

TEST(DeviceFrame, LengthsAreKept) {
  Random random(405);
  double largest = 0.0;
  double largest_force = 0.0;
  for (uint32_t round = 0; round < in_soak(1000000u, 20000u); ++round) {
    const Mapping mapping = random_mapping(random);
    const auto a = fixed_vector<Metre>(random_place(random, mapping));
    const auto b = fixed_vector<Metre>(random_place(random, mapping));
    const Vector3<Position> way = in_body_frame(mapping.scene, a) - in_body_frame(mapping.scene, b);
    const double exact =
        (doubles(a) - doubles(b)).norm() * mapping.in_si.motion_scale / mapping.parameters.edge_m;
    largest = std::max(largest, std::abs(doubles(way).norm() - exact));
    const auto force = fixed_vector<Force>(random.vector());
    const auto turned = firmware::to_device_axes(mapping.scene.device_rotation, force);
    largest_force = std::max(largest_force, std::abs(doubles(turned).norm() - doubles(force).norm()));
  }
  std::printf("ways are as long to %.1f LSB, turned forces to %.1f LSB\n", largest / kPositionLsb,
              largest_force / kForceLsb);
  EXPECT_LE(largest, 2.0 * kPositionError);
  EXPECT_LE(largest_force, 2.0 * kForceLsb);
}

/// The hand's work is the tool's times force scale over motion scale, so what is passive at the tool is
/// passive at the handle.
TEST(DeviceFrame, WorkIsScaledByAConstant) {
  Random random(406);
  double largest = 0.0;
  for (uint32_t round = 0; round < in_soak(1000000u, 20000u); ++round) {
    const Mapping mapping = random_mapping(random);
    const double unit_n = mapping.newtons_per_unit();
    const auto force = fixed_vector<Force>(random.vector() * std::min(1.0, 9.0 / unit_n));
    const auto a = fixed_vector<Metre>(random_place(random, mapping));
    const auto b = fixed_vector<Metre>(random_place(random, mapping));
    const Vector3d handle_n = doubles(on_handle(mapping.scene, force));
    const double of_hand_j = handle_n.dot(doubles(a) - doubles(b));
    const Vector3<Position> way = in_body_frame(mapping.scene, a) - in_body_frame(mapping.scene, b);
    const double unit_j = sim::newtons_per_unit(mapping.parameters) * mapping.parameters.edge_m;
    const double of_tool_j = doubles(force).dot(doubles(way)) * unit_j;
    const double error_j = std::abs(of_hand_j - mapping.in_si.work_scale() * of_tool_j);
    // What 2 LSB of a force and 16 of a way do, along the other one.
    const double edge_of_handle_m = mapping.parameters.edge_m / mapping.in_si.motion_scale;
    const double room_j = 3.0 * ((2.0 * kForceLsb * unit_n + kNewtonLsb) * (doubles(a) - doubles(b)).norm() +
                                 2.0 * kPositionError * edge_of_handle_m * handle_n.norm());
    ASSERT_LE(error_j, room_j);
    largest = std::max(largest, error_j / room_j);
  }
  std::printf("work is off by up to %.2f of what the roundings may do\n", largest);
}

/// Where a turned place is beyond the format, it stays at its end rather than coming out at the other side.
TEST(DeviceFrame, FarPlacesSaturate) {
  sim::SceneParameters in_si;
  in_si.device_rotation_deg = {0.0, 0.0, 45.0};
  in_si.motion_scale = 4.0;
  in_si.body_centre_in_device_m = {0.0, 0.0, 0.0};
  const firmware::Scene scene = compile_scene(in_si, {});
  const Vector3<Metre> corner(Metre::max(), Metre::min(), Metre::max());
  const Vector3<Position> x = in_body_frame(scene, corner);
  EXPECT_EQ(x[0], Position::ratio(8, 1));
  EXPECT_EQ(x[2], Position::ratio(8, 1));
  const Vector3<Newton> force = on_handle(scene, Vector3<Force>(Force::max(), Force::min(), Force::min()));
  EXPECT_EQ(force[1], Newton::min());
  EXPECT_EQ(force[2], Newton::min());
}

TEST(DeviceFrame, HasItsDomain) {
  const auto refusal = [](const sim::SceneParameters& in_si, double edge_m) {
    sim::ModelParameters parameters;
    parameters.edge_m = edge_m;
    try {
      check_domain(in_si, parameters);
    } catch (const sim::BadInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  sim::SceneParameters in_si;
  in_si.motion_scale = 4.1;
  EXPECT_EQ(refusal(in_si, 0.064), "motion_scale is 4.1, but must be 0.1 to 4");
  in_si.motion_scale = 2.0;
  EXPECT_EQ(refusal(in_si, 0.064),
            "body_centre_in_device_m, turned and scaled, along the body's x is 0.36, but must be -0.256 to "
            "0.256");
  in_si.motion_scale = 1.0;
  in_si.device_rotation_deg = {0.0, 0.0, 181.0};
  EXPECT_EQ(refusal(in_si, 0.064), "device_rotation_deg is 181, but must be -180 to 180");
}

}  // namespace
}  // namespace palpate::test
