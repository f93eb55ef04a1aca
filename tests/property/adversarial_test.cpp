// A tool that does its worst for a long time: grasps, is dragged through the body and out of it at up to 1
// m/s, lets go, again and again, with both fronts on the move. In the checked build any operation that leaves
// its range aborts.
#include <gtest/gtest.h>

#include "support/remeshing.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

/// Goes from place to place at some speed, now slowly, now as fast as a hand can; often right through the
/// body.
class Hand {
 public:
  Hand(uint64_t seed, double edge_m) : random_(seed), edge_m_(edge_m) {}

  TickInput next() {
    if ((goal_ - at_).norm() <= step_) {
      goal_ = random_.vector().cwiseProduct(Vector3d(1.2, 1.2, 2.2));
      if (random_.below(2) == 0) goal_ = -at_;  // through the middle
      step_ = std::pow(10.0, -2.0 * random_.unit()) * 1e-3 / edge_m_;
    }
    if ((goal_ - at_).norm() > 1e-9)
      at_ += std::min(step_, (goal_ - at_).norm()) * (goal_ - at_).normalized();
    if (random_.below(150) == 0) close_ = !close_;
    TickInput input = input_at_rest();
    input.tool = fixed_vector<Position>(at_);
    input.close_grasp = close_;
    return input;
  }

 private:
  Random random_;
  double edge_m_;
  double step_ = 1e-3;
  Vector3d at_ = Vector3d(0.5, 0.5, 1.5);
  Vector3d goal_ = at_;
  bool close_ = false;
};

struct Peaks {
  uint64_t hash = 0;
  uint32_t flags = 0;
  uint32_t grasping = 0;
};

template <class Profile>
Peaks torment(const sim::ModelParameters& parameters, uint32_t ticks, uint32_t check_every, bool print) {
  const auto state = started<Profile>(compile_model(parameters));
  Hand hand(7, parameters.edge_m);
  Peaks peaks;
  TickOutput output{};
  for (uint32_t i = 1; i <= ticks; ++i) {
    output = tick_once(*state, hand.next());
    peaks.flags |= output.flags;
    peaks.grasping += has(output, TickFlag::kGrasping) ? 1u : 0u;
    if (i % check_every == 0) expect_whole(*state);
    if (testing::Test::HasFatalFailure()) return peaks;
  }
  peaks.hash = state_hash(*state, output);
  if (!print) return peaks;
  const RemeshCounters& c = state->remesh;
  std::printf(
      "%u ticks, %u grasping, flags seen %03x; tets bisected %u, merged %u; groups split %u, joined %u\n",
      ticks, peaks.grasping, peaks.flags, c.bisected, c.merged, c.groups_split, c.groups_joined);
  std::printf(
      "peaks: leaves %u of %u, nodes %u of %u, groups %u of %u, tethers %u of %u; clamps: speed %u, position "
      "%u, "
      "strain %u\n",
      unsigned{state->forest.leaf_counters.peak}, unsigned{Profile::kLeaves},
      unsigned{state->forest.nodes.counters().peak}, unsigned{Profile::kNodes},
      unsigned{state->front.groups.counters().peak}, unsigned{Profile::kGroups},
      unsigned{state->tethers.peak}, unsigned{Profile::kTethers}, state->clamps.speed, state->clamps.position,
      state->clamps.strain);
  EXPECT_GT(c.bisected, ticks / 40);
  EXPECT_GT(c.merged, ticks / 40);
  EXPECT_GT(c.groups_split + c.groups_joined, 0u);
  return peaks;
}

sim::ModelParameters tissue() {
  sim::ModelParameters parameters = remeshing_bar();
  parameters.mass_damping_per_s = 2.0;
  parameters.regions[0] = {500.0, 0.49, 1000.0, 1, 5};
  parameters.grasp_reach_m = 0.2;
  return parameters;
}

template <class Profile>
void torment_twice(const sim::ModelParameters& parameters, uint32_t ticks) {
  const Peaks first = torment<Profile>(parameters, ticks, 97, true);
  if (testing::Test::HasFatalFailure()) return;
  EXPECT_GT(first.grasping, ticks / 10);
  EXPECT_EQ(torment<Profile>(parameters, ticks, ticks, false).hash, first.hash);
}

TEST(Adversarial, ABarInASmallProfileStaysWhole) { torment_twice<Small>(tissue(), in_soak(1000000u, 5000u)); }
TEST(Adversarial, ABarInADenseProfileStaysWhole) {
  torment_twice<CuboidDense>(tissue(), in_soak(1000000u, 3000u));
}
struct DenseWithConformingFront : CuboidDense {
  static constexpr bool kStudyCriteria = true;
};
TEST(Adversarial, AConformingFrontStaysWhole) {
  sim::ModelParameters parameters = tissue();
  parameters.remesh.rotation = RotationCriterion::kSiblings;
  torment_twice<DenseWithConformingFront>(parameters, in_soak(100000u, 2000u));
}
TEST(Adversarial, FullCorotationStaysWhole) {
  sim::ModelParameters parameters = tissue();
  parameters.remesh.rotation = RotationCriterion::kFull;
  const auto ticks = in_soak(100000u, 2000u);
  const auto state = started<WithFullCorotation<Small>>(compile_model(parameters));
  Hand hand(8, parameters.edge_m);
  for (uint32_t i = 1; i <= ticks; ++i) {
    tick_once(*state, hand.next());
    if (i % 97 == 0) {
      ASSERT_NO_FATAL_FAILURE(expect_whole(*state));
    }
  }
  EXPECT_GT(state->remesh.bisected, ticks / 20);
}
struct SmallForLightBodies : Small {
  static constexpr uint32_t kSubsteps = 4;
};
TEST(Adversarial, ALightFreeBodyStaysWhole) {
  sim::ModelParameters parameters = tissue();
  parameters.regions[0].density_kg_m3 = 10.0;
  parameters.regions[0].most_level = 4;
  parameters.substeps = 4;
  parameters.held = sim::HeldEnds::kNone;
  torment_twice<SmallForLightBodies>(parameters, in_soak(100000u, 1500u));
}

}  // namespace
}  // namespace palpate::test
