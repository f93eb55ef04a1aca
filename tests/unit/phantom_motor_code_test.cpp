#include "palpate/phantom/motor_code.hpp"

#include <gtest/gtest.h>

#include "palpate/phantom/premium.hpp"
#include "phantom_reference.hpp"

namespace palpate::phantom {
namespace {

constexpr double kTorqueConstant = 0.0234;
constexpr double kRatios[] = {13.3, 11.2, 11.2};
constexpr double kSigns[] = {1, -1, -1};

DriveRatings with_limit(int32_t limit_milliamperes, int32_t full_scale_milliamperes) {
  DriveRatings ratings = premium::kDriveRatings;
  ratings.current_limit_milliamperes = limit_milliamperes;
  ratings.full_scale_milliamperes = full_scale_milliamperes;
  return ratings;
}

NewtonMetre torque(double newton_metres) {
  return NewtonMetre::from_raw(
      static_cast<int32_t>(std::llround(std::ldexp(newton_metres, NewtonMetre::kFractionBits))));
}

MotorCodes codes(const Drive& drive, NewtonMetre each) { return motor_codes(drive, each, each, each); }

TEST(MotorCode, IsExactlyZeroCodeForNoTorque) {
  const MotorCodes result = motor_codes(premium::kDrive, zero_vector<NewtonMetre>());
  for (const uint16_t code : result.codes) EXPECT_EQ(code, 2048);
  for (const bool limited : result.limited) EXPECT_FALSE(limited);
}

TEST(MotorCode, IsTheRoundedQuotient) {
  const Drive drive = make_drive(with_limit(5500, 5500));
  for (int step = -4000; step <= 4000; ++step) {
    const NewtonMetre each = torque(step * 0.3e-3);
    const MotorCodes result = codes(drive, each);
    for (std::size_t joint = 0; joint < 3; ++joint) {
      const double amperes = kSigns[joint] * test::to_double(each) / (kRatios[joint] * kTorqueConstant);
      ASSERT_NEAR(result.codes[joint], 2048 + 2047 * amperes / 5.5, 0.5 + std::ldexp(1, -11)) << step;
      ASSERT_FALSE(result.limited[joint]);
    }
  }
}

TEST(MotorCode, StopsAtTheContinuousCurrentByDefault) {
  const int32_t limit = 462;  // 2047 x 1.24 / 5.5 = 461.5
  for (const double newton_metres : {0.5, 10.0, 31.9}) {
    const MotorCodes up = codes(premium::kDrive, torque(newton_metres));
    const MotorCodes down = codes(premium::kDrive, torque(-newton_metres));
    for (std::size_t joint = 0; joint < 3; ++joint) {
      EXPECT_NEAR(up.codes[joint], 2048 + kSigns[joint] * limit, 1);
      EXPECT_NEAR(down.codes[joint], 2048 - kSigns[joint] * limit, 1);
      EXPECT_TRUE(up.limited[joint] && down.limited[joint]);
    }
  }
}

TEST(MotorCode, FlagsOnlyTheLimitedJoint) {
  // 28.6 mN m at the motor is the limit: 0.386 N m at joint 1, 0.325 N m at joints 2 and 3.
  const MotorCodes result = motor_codes(premium::kDrive, torque(0.385), torque(-0.326), torque(0.32));
  EXPECT_EQ(result.limited, (std::array<bool, 3>{false, true, false}));
}

TEST(MotorCode, StaysInTwelveBitsWhateverTheLimit) {
  const Drive drive = make_drive(with_limit(100000, 5500));
  const MotorCodes up = codes(drive, NewtonMetre::max());
  const MotorCodes down = codes(drive, NewtonMetre::min());
  EXPECT_EQ(up.codes, (std::array<uint16_t, 3>{4095, 1, 1}));
  EXPECT_EQ(down.codes, (std::array<uint16_t, 3>{1, 4095, 4095}));
  for (std::size_t joint = 0; joint < 3; ++joint) EXPECT_TRUE(up.limited[joint] && down.limited[joint]);
}

TEST(MotorCode, NeverFallsAsTheTorqueGrows) {
  int32_t last = 0;
  for (int step = -5000; step <= 5000; ++step) {
    const int32_t code = codes(premium::kDrive, torque(step * 1e-4)).codes[0];
    ASSERT_GE(code, last);
    last = code;
  }
}

TEST(MotorCode, GivesThePublishedForces) {
  // A push up at the zero pose is joint 2's alone: 1.5 N at 1.24 A and 6.7 N at 5.5 A, 3.3 mN a code.
  const Posture posture = premium::posture(joint_angles(premium::kPremium15, {}));
  const auto code_of = [&posture](const Drive& drive, double newtons) {
    const auto torques = premium::joint_torques(posture, test::to_force({0, 0, newtons}));
    return motor_codes(drive, torques);
  };
  EXPECT_FALSE(code_of(premium::kDrive, 1.50).limited[1]);
  EXPECT_TRUE(code_of(premium::kDrive, 1.52).limited[1]);
  const Drive stall = make_drive(with_limit(5500, 5500));
  EXPECT_FALSE(code_of(stall, 6.70).limited[1]);
  EXPECT_TRUE(code_of(stall, 6.71).limited[1]);
  EXPECT_EQ(code_of(stall, 1.0).codes[1], 2048 - 305);  // 1 N / 3.28 mN
}

}  // namespace
}  // namespace palpate::phantom
