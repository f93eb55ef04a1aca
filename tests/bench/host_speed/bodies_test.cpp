// The bodies that are timed do what the report says of them.
#include <gtest/gtest.h>

#include "field.hpp"

namespace palpate::bench {
namespace {

const TwistedBar& twisted_bar() {
  static TwistedBar bar{BarSetup{}};
  if (bar.ticks() == 0) bar.twist();
  return bar;
}

reference::Material tissue() { return reference::material_of(500.0, 0.49, 1000.0); }

TEST(HostSpeedBodies, TheCoresForcesAreExact) {
  const Bar& bar = twisted_bar().bar();
  EXPECT_EQ(bar.rotations(), 1152u);
  EXPECT_FALSE(bar.was_clamped());
  const auto still = bar.copy();
  still->evaluate_forces();
  const Motion motion = still->motion();
  EXPECT_LT(force_error(bar.mesh(), tissue(), motion.force_position, motion.force), 2e-3);
  // Nothing has moved.
  EXPECT_EQ(distance_mm(motion.position, bar.motion().position), 0.0);
}

/// A fifth longer and a quarter turned: where the far end's corner has gone.
TEST(HostSpeedBodies, TheEndIsTwistedAndDrawn) {
  const Bar& bar = twisted_bar().bar();
  const reference::Mesh mesh = bar.mesh();
  const reference::Positions now = bar.motion().position;
  const std::vector<uint8_t> held = bar.held_nodes();
  int corners = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const reference::Vector& rest = mesh.rest[i];
    if (held[i] == 1) {
      EXPECT_LT((now[i] - rest).norm(), 1e-6);
    }
    if (held[i] != 2) continue;
    EXPECT_NEAR(now[i][2] - rest[2], 0.2 * 0.192, 1e-6);
    // (x, y) to (-y, x), one degree of swinging aside
    EXPECT_LT((now[i] - reference::Vector(-rest[1], rest[0], now[i][2])).norm(), 1e-3);
    ++corners;
  }
  EXPECT_GT(corners, 4);
}

TEST(HostSpeedBodies, BothBuildsMakeTheSameBits) {
  BarSetup setup;
  setup.substeps = 2;
  setup.theta_deg = 1.5;
  TwistedBar bar(setup);
  TwistedBar native(setup, make_native_bar);
  for (int i = 0; i < 300; ++i) {
    bar.tick();
    native.tick();
  }
  EXPECT_GT(bar.bar().rotations(), 18u);
  EXPECT_EQ(bar.bar().hash(), native.bar().hash());
  native.tick();
  EXPECT_NE(bar.bar().hash(), native.bar().hash());
}

TEST(HostSpeedBodies, AnErrorIsRelativeToAllForces) {
  const Motion motion = twisted_bar().bar().motion();
  std::vector<reference::Vector> none(motion.position.size(), reference::Vector::Zero());
  EXPECT_DOUBLE_EQ(force_error(twisted_bar().bar().mesh(), tissue(), motion.position, none), 1.0);
}

class HostSpeedPeer : public testing::TestWithParam<PeerMode> {
 protected:
  void SetUp() override {
    if (!peer_name()) GTEST_SKIP() << "built without Bullet (Debian: libbullet-dev)";
  }
};

/// The same mesh, material, held nodes and motion: for 100 ms it is where the core's body is.
TEST_P(HostSpeedPeer, MovesAsTheCoreDoes) {
  TwistedBar bar{BarSetup{}};
  bar.twist();
  TwistedPeer peer(bar, GetParam());
  for (int i = 0; i < 100; ++i) {
    bar.tick();
    peer.tick();
  }
  EXPECT_EQ(peer.ticks(), bar.ticks());
  EXPECT_LT(distance_mm(peer.peer().positions(), bar.bar().motion().position), 1.0);
}
INSTANTIATE_TEST_SUITE_P(Peer, HostSpeedPeer, testing::Values(PeerMode::kImplicit, PeerMode::kExplicit),
                         [](const testing::TestParamInfo<PeerMode>& mode) {
                           return mode.param == PeerMode::kImplicit ? "implicit" : "explicit";
                         });

TEST_P(HostSpeedPeer, HasTheSameForces) {
  const TwistedBar& bar = twisted_bar();
  TwistedPeer peer(bar, GetParam());
  peer.peer().evaluate_forces();
  const double error = force_error(peer.mesh(), tissue(), peer.peer().positions(), peer.peer().forces());
  EXPECT_GT(error, 0.0);
  EXPECT_LT(error, 0.1);
}

}  // namespace
}  // namespace palpate::bench
