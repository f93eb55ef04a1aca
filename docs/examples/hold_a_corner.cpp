// Takes the top corner of a soft bar, pulls it 20 mm to the side within 0.2 s, holds it, and prints the force
// that the bar does to the hand. Build it with -O2: the core is all templates.
#include <cinttypes>
#include <cstdio>

#include "palpate/tick/tick.hpp"
#include "soft_bar.hpp"

namespace {

using namespace palpate;

// A profile fixes the capacities at compile time: the state has no pointers and never allocates, so it can be
// a static object of the firmware. This one is large enough for 288 leaves.
State<Small> g_state;

/// The hand's position after so many ticks: from the top corner along x.
Vector3<Position> hand_at(int64_t tick) {
  constexpr int64_t kPullTicks = 200;
  constexpr int64_t kPullMm = 20;
  const int64_t pulled = tick < kPullTicks ? tick : kPullTicks;
  const Position sideways = Position::ratio(pulled * kPullMm, kPullTicks * example::kEdgeMm);
  return {example::from_mm(32) + sideways, example::from_mm(32), example::from_mm(96)};
}

/// A component of a force in micronewtons, rounded down.
int64_t micronewtons(Force force) {
  return (force.raw() * example::kForceUnitMicronewtons) >> Force::kFractionBits;
}

void print_row(uint32_t tick, const TickOutput& output) {
  std::printf("%" PRIu32 ",%" PRId64 ",%" PRId64 ",%" PRId64 "\n", tick, micronewtons(output.reaction[0]),
              micronewtons(output.reaction[1]), micronewtons(output.reaction[2]));
}

}  // namespace

int main() {
  // Builds the mesh at rest. It fails when the mesh does not fit the profile.
  if (start(g_state, example::soft_bar()) != Status::kDone) return 1;

  TickInput input{};
  input.hold_motion = {RigidMotion::identity(), RigidMotion::identity()};  // held regions stay where they are
  input.close_grasp = true;  // takes the nearest node within reach
  TickOutput output{};
  NoProbe probe;  // a probe of your own can time the stages
  std::printf("tick,force_x_uN,force_y_uN,force_z_uN\n");
  for (uint32_t ticks = 1; ticks <= 1000; ++ticks) {
    input.tool = hand_at(ticks);
    tick(g_state, input, output, probe);
    if (ticks % 100 == 0) print_row(ticks, output);
  }
  return 0;
}
