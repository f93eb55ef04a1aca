// The whole device, from motor codes to encoder counts.
#include "plant/plant.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "arms.hpp"
#include "model/units.hpp"
#include "plant/encoders.hpp"

namespace palpate::plant {
namespace {

constexpr std::array<uint16_t, 3> kNoCurrent{2048, 2048, 2048};
constexpr std::array<bool, 3> kAllOn{true, true, true};

/// A controller's lines: the watchdog's toggles on each tick.
class Lines {
 public:
  PlantInput drive(const std::array<uint16_t, 3>& codes) {
    line_ = !line_;
    return {codes, kAllOn, line_};
  }
  [[nodiscard]] PlantInput with_stuck_watchdog(const std::array<uint16_t, 3>& codes) const {
    return {codes, kAllOn, line_};
  }

 private:
  bool line_ = false;
};

PlantParameters weightless() {
  PlantParameters parameters;
  parameters.arm = test::frictionless_arm();
  parameters.arm.gravity = 0.0;
  return parameters;
}

Hand hand_at(const Eigen::Vector3d& place, const HandParameters& parameters = {}) {
  return {parameters, Intention::scripted({{0.0, place}})};
}

TEST(Plant, ReadsZeroWithTheLinksOrthogonal) {
  const PlantOutput output = Plant(PlantParameters{}).output();
  EXPECT_EQ(output.tick, 0U);
  EXPECT_EQ(output.encoder_counts, (std::array<int16_t, 3>{0, 0, 0}));
  EXPECT_EQ(output.gimbal_adc, (std::array<uint16_t, 3>{2048, 2048, 2048}));
  EXPECT_EQ(output.buttons, 0);
}

TEST(Plant, FallsFreelyWithoutAmplifiers) {
  PlantParameters parameters;
  parameters.arm = test::frictionless_arm();
  parameters.start_q = {0.3, 0.5, 0.8};
  Plant plant(parameters);
  ArmState alone{parameters.start_q, Eigen::Vector3d::Zero()};
  const ArmDynamics dynamics(parameters.arm);
  for (uint32_t tick = 1; tick <= 50; ++tick) {
    const PlantOutput output = plant.step({{4095, 0, 4095}, {false, false, false}, tick % 2 == 1});
    EXPECT_EQ(output.tick, tick);
    for (int i = 0; i < 10; ++i) alone = dynamics.advance(alone, Eigen::Vector3d::Zero(), {}, 1e-4);
    ASSERT_EQ(plant.truth().arm.q, alone.q);
    ASSERT_EQ(output.encoder_counts, read_counters(encoder_counts(premium::kEncoders, alone.q)));
  }
  EXPECT_GT((alone.q - parameters.start_q).norm(), 0.01);
}

TEST(Plant, MovesWhereTheCodesPush) {
  // Joint 1 counts down as it turns left; positive code and angle agree on joint 1 and not on 2 and 3.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Plant plant(weightless());
    Lines lines;
    std::array<uint16_t, 3> codes = kNoCurrent;
    codes[axis] = 2048 + 200;
    PlantOutput output{};
    for (int tick = 0; tick < 20; ++tick) output = plant.step(lines.drive(codes));
    const double moved = plant.truth().arm.q[static_cast<Eigen::Index>(axis)];
    const bool is_positive = axis == 0;
    EXPECT_EQ(moved > 0.0, is_positive) << axis;
    EXPECT_GT(std::fabs(moved), 1e-3);
    EXPECT_EQ(output.encoder_counts[axis] < 0, is_positive) << axis;
  }
}

TEST(Plant, GivesTheForceThatTheFirmwareAsksFor) {
  // The firmware's own arithmetic turns a force into codes; a stiff hand holds the tip and feels the force.
  test::Random random(61);
  const std::array<double, 3> code_torque{13.3 * 0.0234 * 5.5 / 2047, 11.2 * 0.0234 * 5.5 / 2047,
                                          11.2 * 0.0234 * 5.5 / 2047};
  HandParameters stiff;
  stiff.stiffness = 2000.0;
  stiff.damping = 40.0;
  for (int i = 0; i < 8; ++i) {
    PlantParameters parameters = weightless();
    parameters.start_q = Eigen::Vector3d(0.0, 0.2, 0.3) + 0.2 * random.vector();
    const Eigen::Vector3d wanted = 0.6 * random.vector();
    Plant plant(parameters, hand_at(premium::tool_position(parameters.start_q), stiff));
    Lines lines;
    PlantOutput output = plant.output();
    for (int tick = 0; tick < 600; ++tick) {
      const auto& counts = output.encoder_counts;
      const auto angles =
          phantom::joint_angles(phantom::premium::kPremium15, {counts[0], counts[1], counts[2]});
      const Vector3<phantom::Newton> force(sim::to_fixed<phantom::Newton>(wanted[0]),
                                           sim::to_fixed<phantom::Newton>(wanted[1]),
                                           sim::to_fixed<phantom::Newton>(wanted[2]));
      const auto torques = phantom::premium::joint_torques(phantom::premium::posture(angles), force);
      const auto codes = phantom::motor_codes(phantom::premium::kDrive, torques);
      ASSERT_EQ(codes.limited, (std::array<bool, 3>{false, false, false}));
      output = plant.step(lines.drive(codes.codes));
    }
    const PlantTruth truth = plant.truth();
    ASSERT_LT(truth.tip_velocity.norm(), 1e-4);
    const Eigen::Vector3d error = premium::jacobian(truth.arm.q).transpose() * (wanted + truth.hand_force);
    for (Eigen::Index joint = 0; joint < 3; ++joint) {
      EXPECT_LT(std::fabs(error[joint]), 0.6 * code_torque[static_cast<std::size_t>(joint)]) << i;
    }
    EXPECT_LT((wanted + truth.hand_force).norm(), 5e-3);  // 3.3 mN a code
    EXPECT_GT(truth.hand_force.norm(), 0.1);
  }
}

TEST(Plant, FollowsAHandsStepAsTheClosedForm) {
  // Sideways at the zero pose the arm is a mass of M11 / l1^2: m x'' + b x' + k (x - step) = 0.
  constexpr double kStep = 1e-4;
  const HandParameters hand;
  Plant plant(weightless(),
              hand_at(premium::tool_position(Eigen::Vector3d::Zero()) + Eigen::Vector3d(0.0, kStep, 0.0)));
  const double arm_inertia = ArmDynamics(weightless().arm).mass_matrix(Eigen::Vector3d::Zero())(0, 0);
  const double mass = hand.mass + arm_inertia / (0.215 * 0.215);
  const double decay = hand.damping / (2.0 * mass);
  const double ringing = std::sqrt(hand.stiffness / mass - decay * decay);
  for (int tick = 1; tick <= 300; ++tick) {
    plant.step({kNoCurrent, kAllOn, false});
    const double t = tick * 1e-3;
    const double expected =
        kStep *
        (1.0 - std::exp(-decay * t) * (std::cos(ringing * t) + decay / ringing * std::sin(ringing * t)));
    ASSERT_NEAR(plant.truth().tip[1], expected, 1e-4 * kStep) << tick;
  }
}

TEST(Plant, ArrivesWhereTheHandGoes) {
  const Eigen::Vector3d from = premium::tool_position(Eigen::Vector3d::Zero());
  const Eigen::Vector3d to = from + Eigen::Vector3d(-0.01, 0.03, 0.02);
  Plant plant(weightless(), Hand(HandParameters{}, Intention::scripted({{0.1, from}, {0.6, to}})));
  for (int tick = 1; tick <= 2000; ++tick) {
    plant.step({kNoCurrent, kAllOn, false});
    if (tick == 100) {
      ASSERT_LT((plant.truth().tip - from).norm(), 1e-9);
    }
  }
  EXPECT_LT((plant.truth().tip - to).norm(), 1e-6);
  EXPECT_LT(plant.truth().hand_force.norm(), 1e-4);
}

TEST(Plant, TurnsNoFasterThanTheSupplyAllows) {
  // An endless turret runs until what the back EMF leaves of the supply drives just the friction:
  //   3 V = Kt eta q1' + R i,  Kt eta i = B q1'
  PlantParameters parameters = weightless();
  parameters.arm.stops.limits.q1 = test::kNoLimits.q1;
  parameters.arm.friction.viscous = 0.005;
  parameters.winding.supply_voltage = 3.0;
  Plant plant(parameters);
  Lines lines;
  for (int tick = 0; tick < 5000; ++tick) plant.step(lines.drive({4095, 2048, 2048}));
  const PlantTruth truth = plant.truth();
  const double resistance = parameters.winding.resistance(truth.temperatures[0].winding);
  const double expected = 3.0 / (0.0234 * 13.3 + resistance * 0.005 / (0.0234 * 13.3));
  EXPECT_NEAR(truth.arm.rates[0], expected, 1e-3 * expected);
}

TEST(Plant, LosesItsCurrentWhenTheWatchdogStops) {
  PlantParameters parameters = weightless();
  Plant plant(parameters, hand_at(premium::tool_position(parameters.start_q)));
  Lines lines;
  const std::array<uint16_t, 3> codes{2248, 2248, 2248};
  for (int tick = 0; tick < 100; ++tick) plant.step(lines.drive(codes));
  const double driven = 200 * 5.5 / 2047;
  for (uint32_t tick = 1; tick < parameters.amplifiers.watchdog_ticks; ++tick) {
    plant.step(lines.with_stuck_watchdog(codes));
    ASSERT_NEAR(plant.truth().currents[1], driven, 1e-6);
  }
  plant.step(lines.with_stuck_watchdog(codes));
  const PlantTruth off = plant.truth();
  EXPECT_EQ(off.is_driven, (std::array<bool, 3>{false, false, false}));
  // A millisecond is nine of the winding's time constants.
  EXPECT_LT(off.currents.cwiseAbs().maxCoeff(), 2e-4 * driven);
  EXPECT_LT(off.torques.cwiseAbs().maxCoeff(), 2e-4 * driven * 13.3 * 0.0234 * 1.6);
  for (int tick = 0; tick < 200; ++tick) plant.step(lines.with_stuck_watchdog(codes));
  EXPECT_LT(plant.truth().currents.cwiseAbs().maxCoeff(), 1e-12);
  plant.step(lines.drive(codes));
  EXPECT_NEAR(plant.truth().currents[1], driven, 1e-3 * driven);
}

TEST(Plant, TurnsOffTheAxisThatIsNotEnabled) {
  Plant plant(weightless(), hand_at(premium::tool_position(Eigen::Vector3d::Zero())));
  for (int tick = 0; tick < 20; ++tick) plant.step({{2248, 2248, 2248}, {true, false, true}, tick % 2 == 0});
  const PlantTruth truth = plant.truth();
  EXPECT_GT(truth.currents[0], 0.5);
  EXPECT_EQ(truth.currents[1], 0.0);
  EXPECT_GT(truth.currents[2], 0.5);
  EXPECT_EQ(truth.is_driven, (std::array<bool, 3>{true, false, true}));
}

TEST(Plant, WarmsItsMotorsAndSaysWhenOneIsTooHot) {
  // 5.5 A against a stop: 100 deg C after 4.6 s.
  PlantParameters parameters;
  parameters.start_q = {radians(89.0), 0.0, 0.0};
  Plant plant(parameters);
  Lines lines;
  int hot_at = 0;
  for (int tick = 1; tick <= 5000 && hot_at == 0; ++tick) {
    plant.step(lines.drive({4095, 2048, 2048}));
    if (plant.truth().is_too_hot[0]) hot_at = tick;
  }
  EXPECT_NEAR(hot_at, 4600, 60);
  EXPECT_FALSE(plant.truth().is_too_hot[1]);
  EXPECT_NEAR(plant.truth().temperatures[1].winding, 25.0, 1e-9);
}

TEST(Plant, TellsTheButtonsThatTheHandPresses) {
  const Eigen::Vector3d tip = premium::tool_position(Eigen::Vector3d::Zero());
  const Intention intention =
      Intention::scripted({{0.0, tip, true, 0}, {0.010, tip, true, 1}, {0.020, tip, false, 0}});
  Plant plant(PlantParameters{}, Hand(HandParameters{}, intention));
  for (int tick = 1; tick <= 30; ++tick) {
    const PlantOutput output = plant.step({kNoCurrent, kAllOn, false});
    ASSERT_EQ(output.buttons, tick >= 10 && tick < 20 ? 1 : 0) << tick;
  }
  EXPECT_EQ(plant.truth().hand_force, Eigen::Vector3d::Zero());
}

std::vector<PlantOutput> shaken_run(uint64_t seed) {
  const Eigen::Vector3d tip = premium::tool_position({0.0, 0.2, 0.3});
  HandParameters shaky;
  shaky.tremor = {0.3, 10.0, seed};
  PlantParameters parameters;
  parameters.start_q = {0.0, 0.2, 0.3};
  Plant plant(parameters,
              Hand(shaky, Intention::scripted({{0.0, tip}, {0.5, tip + Eigen::Vector3d(0, 0.03, 0)}})));
  Lines lines;
  test::Random random(62);
  std::vector<PlantOutput> outputs;
  outputs.reserve(1000);
  for (int tick = 0; tick < 1000; ++tick) {
    const auto code = [&random] { return static_cast<uint16_t>(1948 + random.below(200)); };
    const uint16_t first = code(), second = code(), third = code();
    outputs.push_back(plant.step(lines.drive({first, second, third})));
  }
  return outputs;
}

TEST(Plant, GivesTheSameBitsInEachRun) {
  const auto first = shaken_run(1);
  const auto second = shaken_run(1);
  const auto other = shaken_run(2);
  int differences = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i].encoder_counts, second[i].encoder_counts) << i;
    differences += first[i].encoder_counts != other[i].encoder_counts ? 1 : 0;
  }
  EXPECT_GT(differences, 900);
}

TEST(Plant, GivesTheSameBitsInItsTruth) {
  const auto run = [] {
    PlantParameters parameters;
    parameters.start_q = {0.1, 0.2, 0.3};
    Plant plant(parameters, hand_at(premium::tool_position({0.0, 0.25, 0.3})));
    Lines lines;
    for (int tick = 0; tick < 500; ++tick) plant.step(lines.drive({2100, 2000, 2070}));
    return plant.truth();
  };
  const PlantTruth a = run();
  const PlantTruth b = run();
  EXPECT_EQ(a.arm.q, b.arm.q);
  EXPECT_EQ(a.arm.rates, b.arm.rates);
  EXPECT_EQ(a.currents, b.currents);
  EXPECT_EQ(a.temperatures[0].winding, b.temperatures[0].winding);
}

TEST(Plant, NeedsNoFinerSubsteps) {
  // 40 kHz instead of 10 kHz moves a driven arm by far less than an encoder count (1.2e-4 rad).
  const auto run = [](int substeps) {
    PlantParameters parameters;
    parameters.substeps = substeps;
    parameters.start_q = {0.1, 0.2, 0.3};
    Plant plant(parameters, hand_at(premium::tool_position({0.0, 0.25, 0.3})));
    Lines lines;
    for (int tick = 0; tick < 200; ++tick) plant.step(lines.drive({2100, 2000, 2070}));
    return plant.truth().arm.q;
  };
  EXPECT_LT((run(10) - run(40)).norm(), 1e-6);
  EXPECT_GT((run(10) - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(), 0.01);
}

TEST(Plant, RefusesATickWithoutSubsteps) {
  PlantParameters parameters;
  parameters.substeps = 0;
  EXPECT_THROW(Plant{parameters}, std::invalid_argument);
}

}  // namespace
}  // namespace palpate::plant
