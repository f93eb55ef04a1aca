// A tool that pushes, slides and jumps at bodies that move and change: where its proxy is, and what its force
// is.
#include "palpate/touch/contact.hpp"

#include <gtest/gtest.h>

#include "support/soak.hpp"
#include "support/surfaces.hpp"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

struct ContactProfile : Bar {
  static constexpr uint16_t kLeaves = 600;
  static constexpr uint32_t kContactCandidates = 64;
};

ContactRules some_rules(double friction) {
  ContactRules rules{};
  rules.radius = Position::ratio(1, 8);
  rules.stiffness = Coupling::ratio(8, 1);
  rules.damping = Coupling::ratio(4, 1);
  rules.friction = sim::to_fixed<Fraction>(friction);
  rules.force_limit = Force::ratio(1, 2);
  rules.slew = Force::ratio(1, 8);
  rules.passivity = PassivityRules{1u << 20, Coupling::ratio(100, 1)};
  return rules;
}

/// A body whose nodes a test moves, and a tool.
struct Scene {
  std::unique_ptr<Forest<ContactProfile>> forest;
  ContactRules rules;
  Candidates<ContactProfile> candidates{};
  Contact contact{};

  void tick(const Vector3d& tool) {
    ContactStep<ContactProfile>(*forest, rules, candidates, contact).run(fixed_vector<Position>(tool));
  }
  [[nodiscard]] Vector3d force() const { return doubles(contact.force); }
  [[nodiscard]] Vector3d proxy() const { return doubles(contact.proxy); }
  void move(const Vector3d& way) {
    for (uint32_t i = 0; i < forest->nodes.used(); ++i) {
      forest->node.position[forest->nodes.live(i)] += fixed_vector<Position>(way);
    }
  }
};

/// The notched block, changed at random.
Scene scene_at(Random& random, double friction, const Vector3d& tool, int changes) {
  Scene scene{changed_forest<ContactProfile>(random, changes), some_rules(friction)};
  scene.contact.begin(fixed_vector<Position>(tool));
  return scene;
}

/// A smooth random motion of the body, so many edges a tick at most.
class Waves {
 public:
  Waves(const Forest<ContactProfile>& forest, Random& random, double speed)
      : wave_(2.0 * random.vector()), amplitude_(random.vector()), speed_(speed) {
    for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
      const uint16_t n = forest.nodes.live(i);
      start_[n] = doubles(forest.node.position[n]);
    }
  }
  void move(Forest<ContactProfile>& forest, int tick) const {
    for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
      const uint16_t n = forest.nodes.live(i);
      const auto found = start_.find(n);
      if (found == start_.end()) continue;
      const Vector3d x =
          found->second + amplitude_ * 0.1 * std::sin(wave_.dot(found->second) + speed_ * 10.0 * tick / 2.0);
      forest.node.position[n] = fixed_vector<Position>(x);
    }
  }

 private:
  std::map<uint16_t, Vector3d> start_;
  Vector3d wave_, amplitude_;
  double speed_;
};

/// A tool that goes from place to place, at some steady speed, mostly through the body.
class Path {
 public:
  Path(Random& random, double speed) : random_(random), speed_(speed) {}
  Vector3d next() {
    if ((goal_ - at_).norm() < speed_) goal_ = random_.vector().cwiseProduct(Vector3d(2.0, 1.5, 1.5));
    at_ += speed_ * (goal_ - at_).normalized();
    return at_;
  }
  [[nodiscard]] Vector3d at() const { return at_; }

 private:
  Random& random_;
  double speed_;
  Vector3d at_ = Vector3d(2.2, 1.6, 1.6);
  Vector3d goal_ = at_;
};

/// A tool at 1/64 edge a tick (1 m/s at 64 mm), a body that moves half as fast: the proxy stays outside.
TEST(TouchContact, TheProxyIsNeverInside) {
  Random random(321);
  double nearest = 1.0;
  uint32_t touching = 0;
  uint32_t ticks = 0;
  for (uint32_t round = 0; round < in_soak(400u, 12u); ++round) {
    Path path(random, 1.0 / 64.0);
    Scene scene = scene_at(random, round % 3 == 0 ? 0.0 : 0.5, path.at(), 50);
    const double radius = sim::to_double(scene.rules.radius);
    const Waves waves(*scene.forest, random, 1.0 / 128.0);
    for (int i = 0; i < 500; ++i) {
      waves.move(*scene.forest, i);
      scene.tick(path.next());
      ASSERT_TRUE(scene.contact.is_certain);
      ASSERT_LE(scene.contact.faces_examined, kPushes * ContactProfile::kContactCandidates);
      ++ticks;
      if (!scene.contact.is_touching) continue;
      ++touching;
      const auto faces = faces_of(*scene.forest);
      ASSERT_LT(winding_number(faces, scene.proxy()), 0.5) << "round " << round << " tick " << i;
      nearest = std::min(nearest, distance_to(faces, scene.proxy()) / radius);
    }
  }
  std::printf("%u ticks, %u touching: the proxy is never nearer than %.3f radii\n", ticks, touching, nearest);
  EXPECT_GT(touching, ticks / 10);
  EXPECT_GT(nearest, 0.5);
}

/// On a flat face the proxy is a radius above it, straight above the tool, and the force is k times the
/// depth.
TEST(TouchContact, AFlatFacePushesStraightBack) {
  Random random(322);
  Scene scene = scene_at(random, 0.0, Vector3d(1.0, -0.4, 1.3), 0);
  scene.rules.force_limit = Force::ratio(1, 1);
  for (int i = 0; i <= 300; ++i) {
    const double depth = std::min(0.1, 0.001 * (i - 175));
    const Vector3d tool(1.0 + 0.0005 * i, -0.4, 1.125 - depth);
    scene.tick(tool);
    if (i < 175) {
      ASSERT_EQ(scene.contact.force, zero_vector<Force>());
      ASSERT_EQ(scene.contact.proxy, fixed_vector<Position>(tool));
      continue;
    }
    ASSERT_LE((scene.proxy() - Vector3d(1.0 + 0.0005 * i, -0.4, 1.125)).norm(), 1e-7);
    const double rate = i == 175 || depth == 0.1 ? 0.0 : 0.001;
    if (i > 177 && i != 275) {
      ASSERT_NEAR(scene.force()[2], 8.0 * depth + 4.0 * rate, 1e-5) << i;
    }
    ASSERT_EQ(scene.contact.force[0].raw(), 0);
    ASSERT_EQ(scene.contact.force[1].raw(), 0);
  }
}

/// Whatever happens: the force pushes outwards, within the cone and the limit, and the body gets
/// its opposite to the last bit.
TEST(TouchContact, ForcesKeepTheirRules) {
  Random random(323);
  uint32_t touching = 0;
  uint32_t slipping = 0;
  for (uint32_t round = 0; round < in_soak(2000u, 60u); ++round) {
    Path path(random, 0.02 * random.unit() + 0.001);
    const double friction = round % 2 == 0 ? 0.0 : 1.5 * random.unit();
    Scene scene = scene_at(random, friction, path.at(), 40);
    const Waves waves(*scene.forest, random, 1.0 / 256.0);
    for (int i = 0; i < 200; ++i) {
      waves.move(*scene.forest, i);
      scene.tick(path.next());
      const Vector3d f = scene.force();
      ASSERT_LE(f.norm(), sim::to_double(scene.rules.force_limit) + 8 * kForceLsb);
      if (scene.contact.is_touching) ++touching;
      const Vector3d n = doubles(scene.contact.normal);
      ASSERT_GE(f.dot(n), -8 * kForceLsb);
      const double across = (f - f.dot(n) * n).norm();
      ASSERT_LE(across, friction * f.dot(n) + 16 * kForceLsb);
      slipping += friction > 0.0 && across > 0.99 * friction * f.dot(n) && across > 1e-3 ? 1u : 0u;
      if (!scene.contact.is_touching) {
        ASSERT_EQ(scene.contact.force, zero_vector<Force>());
      }
      for (auto& force : scene.forest->node.force)
        force = fixed_vector<Force>(Vector3d(0.25 * random.vector()));
      const auto sum = [&] {
        std::array<int64_t, 3> all{};
        for (const auto& force : scene.forest->node.force) {
          for (std::size_t a = 0; a < 3; ++a) all[a] += force[static_cast<Eigen::Index>(a)].raw();
        }
        return all;
      };
      const auto without = sum();
      add_load(*scene.forest, scene.contact.load, scene.contact.force);
      const auto with = sum();
      for (std::size_t a = 0; a < 3; ++a) {
        ASSERT_EQ(with[a] - without[a], -int64_t{scene.contact.force[static_cast<Eigen::Index>(a)].raw()});
      }
    }
  }
  EXPECT_GT(touching, 1000u);
  EXPECT_GT(slipping, 100u);
}

/// The moment of the body's share about the contact's point is that of the force: the point is where it acts.
TEST(TouchContact, TheLoadActsAtTheContact) {
  Random random(324);
  uint32_t loaded = 0;
  for (int round = 0; round < 20; ++round) {
    Path path(random, 0.01);
    Scene scene = scene_at(random, 0.4, path.at(), 40);
    for (int i = 0; i < 200; ++i) {
      scene.tick(path.next());
      if (!scene.contact.is_touching) continue;
      ++loaded;
      const Vector3d at = scene.proxy() - sim::to_double(scene.rules.radius) * doubles(scene.contact.normal);
      ASSERT_LE((doubles(loaded_point(*scene.forest, scene.contact.load)) - at).norm(), 1e-7);
    }
  }
  EXPECT_GT(loaded, 200u);
}

/// Pressed in, then drawn along: it sticks up to mu times the pressing force, then slips at that force.
TEST(TouchContact, FrictionSticksAndThenSlips) {
  Random random(325);
  for (const double mu : {0.0, 0.2, 0.6, 1.2}) {
    Scene scene = scene_at(random, mu, Vector3d(1.0, -0.4, 1.2), 0);
    scene.rules.damping = Coupling::from_raw(0);
    scene.rules.force_limit = scene.rules.slew = Force::ratio(1, 1);
    const double depth = 0.03;
    for (int i = 0; i < 200; ++i) scene.tick(Vector3d(1.0, -0.4, std::max(1.125 - depth, 1.2 - 0.001 * i)));
    const double press = 8.0 * depth;
    for (int i = 1; i <= 200; ++i) {
      const double way = 0.0005 * i;
      scene.tick(Vector3d(1.0 + way, -0.4, 1.125 - depth));
      const double stuck = mu * depth;
      EXPECT_NEAR(scene.force()[2], press, 1e-5);
      EXPECT_NEAR(scene.force()[0], -8.0 * std::min(way, stuck), 1e-5);
      EXPECT_NEAR(scene.proxy()[0], 1.0 + std::max(0.0, way - stuck), 1e-6);
    }
    // Back: the proxy stays until the tool has passed it by as much.
    const double left = scene.proxy()[0];
    scene.tick(Vector3d(left, -0.4, 1.125 - depth));
    EXPECT_NEAR(scene.force()[0], 0.0, 1e-5);
    EXPECT_NEAR(scene.proxy()[0], left, 1e-6);
  }
}

/// A tool that is stuck to a body that moves is carried along: no force but the pressing one.
TEST(TouchContact, AStuckProxyMovesWithTheBody) {
  Random random(326);
  Scene scene = scene_at(random, 0.8, Vector3d(1.0, -0.4, 1.2), 0);
  scene.rules.damping = Coupling::from_raw(0);
  for (int i = 0; i < 200; ++i) scene.tick(Vector3d(1.0, -0.4, std::max(1.1, 1.2 - 0.001 * i)));
  const Vector3d way(0.001, -0.0005, 0.0);
  for (int i = 1; i <= 200; ++i) {
    scene.move(way);
    scene.tick(Vector3d(1.0, -0.4, 1.1) + i * way);
    ASSERT_NEAR(scene.force()[0], 0.0, 1e-4);
    ASSERT_NEAR(scene.force()[1], 0.0, 1e-4);
    ASSERT_NEAR(scene.force()[2], 8.0 * 0.025, 1e-4);
  }
}

/// The mesh under a pressed tool is split and merged: the surface does not move, and neither does the force.
TEST(TouchContact, ChangesOfTheMeshAreNotFelt) {
  Random random(327);
  for (const double mu : {0.0, 0.5}) {
    Scene scene = scene_at(random, mu, Vector3d(1.01, -0.43, 1.2), 0);
    scene.rules.damping = Coupling::from_raw(0);
    const Vector3d tool(1.01, -0.43, 1.1);
    for (int i = 0; i < 200; ++i) scene.tick(Vector3d(1.01, -0.43, std::max(1.1, 1.2 - 0.001 * i)));
    const Vector3d force = scene.force();
    uint32_t splits = 0;
    uint32_t merges = 0;
    uint32_t moved = 0;
    for (int i = 0; i < 2000; ++i) {
      const uint16_t tet = scene.forest->leaf[random.below(scene.forest->leaf_count)].tet;
      Patch patch{};
      if (i / 200 % 2 == 0) {
        splits += bisect_with_closure(*scene.forest, tet);
      } else if (find_merge(*scene.forest, tet, patch) == MeshStatus::kDone) {
        const uint16_t middle = middle_node(scene.forest->leaf_of(scene.forest->child(patch.tet[0], 0)));
        const EdgeEnds ends = restored_edge(*scene.forest, patch.tet[0]);
        for (uint32_t k = 0; k < scene.contact.load.count; ++k)
          moved += scene.contact.load.node[k] == middle ? 1u : 0u;
        move_load(scene.contact.load, middle, ends);
        merge(*scene.forest, patch);
        ++merges;
      }
      for (uint32_t k = 0; k < scene.contact.load.count; ++k) {
        ASSERT_TRUE(scene.forest->nodes.is_live(scene.contact.load.node[k]));
      }
      scene.tick(tool);
      ASSERT_LE((scene.force() - force).norm(), 1e-6) << i;
    }
    EXPECT_GT(splits, 100u);
    EXPECT_GT(merges, 100u);
    EXPECT_GT(moved, 2u);
  }
}

TEST(TouchContact, AMovedLoadKeepsItsSumAndItsPoint) {
  Random random(328);
  for (int round = 0; round < 2000; ++round) {
    Load load{};
    load.count = 3;
    load.node = {0, 1, 2};
    const auto part = Fraction::from_raw(static_cast<int32_t>(random.below(1u << 29)));
    load.weight = {part, part, kFullFraction - part - part};
    for (int k = 3; k < 3 + round % 8; ++k) {
      move_load(load, static_cast<uint16_t>(random.below(6)),
                {static_cast<uint16_t>(k + 10), static_cast<uint16_t>(k)});
      ASSERT_LE(load.count, Load::kMost);
      int64_t sum = 0;
      for (uint32_t i = 0; i < load.count; ++i) sum += load.weight[i].raw();
      ASSERT_EQ(sum, int64_t{1} << 30);
    }
  }
}

/// Rules, places and motions at the ends of their ranges. In the checked build an overflow stops it.
TEST(TouchContact, SurvivesTheDomainsCorners) {
  Random random(329);
  const auto corner = [&] {
    const auto coordinate = [&] {
      const uint32_t which = random.below(5);
      return which == 0   ? -kPositionLimit
             : which == 1 ? kPositionLimit
                          : sim::to_fixed<Position>(random.centred());
    };
    const Position x = coordinate();
    const Position y = coordinate();
    return Vector3<Position>(x, y, coordinate());
  };
  uint32_t touching = 0;
  for (uint32_t round = 0; round < in_soak(20000u, 200u); ++round) {
    Scene scene = scene_at(random, 0.0, Vector3d::Zero(), 20);
    scene.rules.radius = random.below(2) == 0 ? Position::ratio(1, 2) : Position::ratio(1, 64);
    scene.rules.stiffness = random.below(2) == 0 ? Coupling::max() : Coupling::ratio(1, 2);
    scene.rules.damping = random.below(2) == 0 ? Coupling::max() : Coupling::from_raw(0);
    scene.rules.friction = random.below(2) == 0 ? Fraction::max() : Fraction::from_raw(0);
    scene.rules.force_limit = kContactForceLimit;
    scene.rules.slew = random.below(2) == 0 ? Force::ratio(2, 1) : Force::from_raw(1);
    Passivity passivity = Passivity::at_rest();
    const auto start = corner();
    scene.contact.begin(start);
    Vector3<Position> before = start;
    for (int i = 0; i < 60; ++i) {
      if (random.below(4) == 0) {
        for (uint32_t k = 0; k < 40; ++k) {
          scene.forest->node.position[scene.forest->nodes.live(random.below(scene.forest->nodes.used()))] =
              corner();
        }
      }
      const Vector3<Position> tool = corner();
      ContactStep<ContactProfile>(*scene.forest, scene.rules, scene.candidates, scene.contact).run(tool);
      touching += scene.contact.is_touching ? 1u : 0u;
      const Vector3<Position> moved = tool - before;
      before = tool;
      const auto force = made_passive(scene.rules.passivity, scene.contact.force, moved, passivity);
      observe(scene.rules.passivity, force, moved, passivity);
      ASSERT_LE(doubles(force).cwiseAbs().maxCoeff(), 2.01);
      ASSERT_EQ(within_position_limit(scene.contact.proxy), scene.contact.proxy);
      for (auto& f : scene.forest->node.force)
        f = Vector3<Force>(Force::ratio(62, 1), Force::ratio(-62, 1), f[2]);
      add_load(*scene.forest, scene.contact.load, scene.contact.force);
    }
  }
  EXPECT_GT(touching, 500u);
}

}  // namespace
}  // namespace palpate::test
