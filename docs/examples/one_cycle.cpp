// The cycle of a haptic controller: encoder counts of a PHANToM Premium 1.5 in, motor codes out, a tick of
// soft tissue between. A firmware calls cycle() from its 1 kHz interrupt; here a loop does, and plays an
// operator who takes the bar and pulls it aside by turning the turret.
#include <cinttypes>
#include <cstdio>

#include "palpate/firmware/cycle.hpp"
#include "soft_bar.hpp"

namespace {

using namespace palpate;

firmware::CycleState<Small> g_state;

/// Where the bar stands in the device's workspace, and what its force unit is in newtons.
firmware::Scene scene_of_bar() {
  firmware::Scene scene{};
  scene.edges_per_metre = firmware::EdgesPerMetre::ratio(1000, example::kEdgeMm);
  // At zero counts the tool is at (215, 0, -170) mm in the device's frame. This puts it on the bar's side, at
  // (32, 0, 64) mm from the bar's middle.
  scene.device_origin = {example::from_mm(32 - 215), example::from_mm(0), example::from_mm(64 + 170)};
  scene.device_rotation = firmware::kNotTurned;
  // 2.048 N = 0.512 x 2^2 N
  scene.newton_mantissa = Q<0, 31>::ratio(example::kForceUnitMicronewtons, 4000000);
  scene.newton_exponent = 2;
  return scene;
}

/// The turret turns back by 2 counts a tick, 0.23 mrad or 50 um at the tool, and stops at 600.
firmware::Sensors operator_at(int32_t tick) {
  const int32_t turned = tick < 300 ? 2 * tick : 600;
  return {{-turned, 0, 0}, true};
}

int64_t micronewtons(phantom::Newton force) {
  return (int64_t{force.raw()} * 1000000) >> phantom::Newton::kFractionBits;
}

void print_row(int32_t tick, const firmware::Actuators& actuators) {
  const auto& force = g_state.force;
  std::printf("%" PRId32 ",%" PRId64 ",%" PRId64 ",%" PRId64 ",%u,%u,%u\n", tick, micronewtons(force[0]),
              micronewtons(force[1]), micronewtons(force[2]), actuators.motor_codes[0],
              actuators.motor_codes[1], actuators.motor_codes[2]);
}

}  // namespace

int main() {
  if (firmware::start(g_state, {example::soft_bar(), scene_of_bar()}) != Status::kDone) return 1;

  firmware::Actuators actuators{};
  firmware::NoProbe probe;
  std::printf("tick,force_x_uN,force_y_uN,force_z_uN,motor_code_1,motor_code_2,motor_code_3\n");
  for (int32_t tick = 1; tick <= 1000; ++tick) {
    firmware::cycle(g_state, operator_at(tick), actuators, probe);
    // The amplifiers are on after every cycle that ended well; after a fault they stay off.
    if (!actuators.amplifiers_enabled) return 1;
    if (tick % 100 == 0) print_row(tick, actuators);
  }
  // The same counts give the same bits on every machine.
  std::printf("state,%016" PRIx64 "\n", firmware::state_hash(g_state));
  return 0;
}
