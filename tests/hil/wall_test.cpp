// How stiff a wall may be that the loop renders, by its delay: what an application must know of this
// controller.
#include <gtest/gtest.h>

#include "hil/closed_loop.hpp"
#include "palpate/phantom/premium.hpp"
#include "plant/units.hpp"
#include "support/soak.hpp"

namespace palpate::sim {
namespace {

/// Renders F = - K y: a wall that pushes from both sides, so that a swing that does not die out stays seen.
class Wall final : public Controller {
 public:
  explicit Wall(double stiffness_n_m) : stiffness_n_m_(stiffness_n_m) {}

  link::ActuatorsMessage answer(const link::SensorsMessage& sensors, const UserWish&) override {
    namespace premium = phantom::premium;
    const auto posture = premium::posture(phantom::joint_angles(premium::kPremium15, sensors.encoder_counts));
    y_m = std::ldexp(premium::tool_position(posture)[1].raw(), -phantom::Metre::kFractionBits);
    Vector3<phantom::Newton> force = zero_vector<phantom::Newton>();
    const double newtons = std::clamp(-stiffness_n_m_ * y_m, -15.9, 15.9);
    force[1] = phantom::Newton::from_raw(
        static_cast<int32_t>(std::lround(std::ldexp(newtons, phantom::Newton::kFractionBits))));
    watchdog_level_ = !watchdog_level_;
    const auto codes = phantom::motor_codes(premium::kDrive, premium::joint_torques(posture, force)).codes;
    return {sensors.tick, codes, {true, true, true}, watchdog_level_, 0, 0, 0, 0};
  }

  double y_m = 0.0;

 private:
  double stiffness_n_m_;
  bool watchdog_level_ = false;
};

/// The turret, 1 mm beside the wall's zero, with nobody's hand on it and nothing but its own friction.
plant::Plant device_beside_wall() {
  plant::PlantParameters parameters;
  parameters.arm.gravity = 0.0;
  parameters.start_q = {0.001 / 0.215, 0.0, 0.0};
  return plant::Plant(parameters);
}

/// Largest |y| in the last tenth of two seconds, over the 1 mm at the start.
double swing_left(double stiffness_n_m, uint32_t extra_delay) {
  plant::Plant plant = device_beside_wall();
  Wall wall(stiffness_n_m);
  ClosedLoop loop(plant, wall, extra_delay);
  double largest_m = 0.0;
  for (int tick = 0; tick < 2000; ++tick) {
    loop.advance();
    if (tick >= 1800) largest_m = std::max(largest_m, std::abs(wall.y_m));
  }
  return largest_m / 0.001;
}

double stiffest_stable(uint32_t extra_delay) {
  const double step = test::in_soak(std::pow(2.0, 0.125), 2.0);
  double stiffest = 0.0;
  for (double stiffness = 25.0; stiffness <= 3200.0; stiffness *= step) {
    if (swing_left(stiffness, extra_delay) < 0.5) stiffest = stiffness;
  }
  return stiffest;
}

TEST(Wall, IsStableTo800NewtonsAMetreWithoutDelayAndTo100WithATickOfIt) {
  for (const double stiffness : {50.0, 100.0, 200.0, 400.0, 800.0})
    EXPECT_LT(swing_left(stiffness, 0), 0.5) << stiffness;
  for (const double stiffness : {50.0, 100.0}) EXPECT_LT(swing_left(stiffness, 1), 0.5) << stiffness;
  EXPECT_GT(swing_left(800.0, 1), 0.5) << "a delay that does not show is none";
  std::printf("stiffest stable wall: %.0f N/m without delay, %.0f with one tick, %.0f with two\n",
              stiffest_stable(0), stiffest_stable(1), stiffest_stable(2));
}

}  // namespace
}  // namespace palpate::sim
