// The surface of meshes that change: its faces, the candidates of a search, and the closest point, against a
// look at all faces in doubles.
#include "palpate/touch/surface.hpp"

#include <gtest/gtest.h>

#include "support/soak.hpp"
#include "support/surfaces.hpp"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

template <uint32_t Most>
struct FewCandidates : Bar {
  static constexpr uint16_t kLeaves = 600;
  static constexpr uint32_t kContactCandidates = Most;
};

/// Rest shape: closed, turned outwards, and around the block's volume.
TEST(TouchSurface, FacesAreClosedAndTurnedOutwards) {
  Random random(311);
  using Profile = FewCandidates<64>;
  for (int round = 0; round < 60; ++round) {
    const auto forest = changed_forest<Profile>(random, 20 * (round % 5));
    Vector3d area = Vector3d::Zero();
    double volume = 0.0;
    for (const Face& face : faces_of(*forest)) {
      const Vector3d normal = 0.5 * (face.x[1] - face.x[0]).cross(face.x[2] - face.x[0]);
      area += normal;
      volume += face.x[0].dot(normal) / 3.0;
      ASSERT_GT(normal.dot(face.x[0] - face.opposite), 0.0);
    }
    EXPECT_NEAR(area.norm(), 0.0, 1e-12);
    EXPECT_NEAR(volume, 9.0, 1e-12);  // cubes of the notched block
  }
}

struct Found {
  uint32_t searches = 0;
  uint32_t shrunk = 0;
  uint32_t certain = 0;
};

/// Every face within the final range is among the candidates, none beyond the range that was asked for, and
/// none twice.
template <class Profile>
void expect_complete(const Forest<Profile>& forest, const Candidates<Profile>& found, const Vector3d& centre,
                     double range) {
  std::set<std::set<uint16_t>> listed;
  for (uint32_t i = 0; i < found.count; ++i) {
    const FaceNodes node = nodes_of(forest, found.face[i]);
    ASSERT_TRUE(listed.insert({node[0], node[1], node[2]}).second);
  }
  for (const Face& face : faces_of(forest)) {
    const Vector3d low = face.x[0].cwiseMin(face.x[1]).cwiseMin(face.x[2]);
    const Vector3d high = face.x[0].cwiseMax(face.x[1]).cwiseMax(face.x[2]);
    const double bound = std::max(0.0, (low - centre).cwiseMax(centre - high).maxCoeff());
    const bool is_listed = listed.count({face.node[0], face.node[1], face.node[2]}) != 0;
    if (bound <= sim::to_double(found.range)) {
      ASSERT_TRUE(is_listed);
    }
    if (is_listed) {
      ASSERT_LE(bound, range);
    }
  }
}

template <uint32_t Most>
Found search_at_random(uint64_t seed, uint32_t rounds) {
  using Profile = FewCandidates<Most>;
  Random random(seed);
  Found result;
  Candidates<Profile> found;
  for (uint32_t round = 0; round < rounds; ++round) {
    const auto forest = changed_forest<Profile>(random, 60);
    deform_smoothly(*forest, random, 0.3);
    for (int i = 0; i < 20; ++i) {
      const auto centre =
          fixed_vector<Position>(Vector3d(random.vector().cwiseProduct(Vector3d(2.0, 1.5, 1.5))));
      const double range = 0.6 * random.unit();
      find_candidates(*forest, centre, sim::to_fixed<Position>(range), found);
      EXPECT_LE(found.count, Most);
      expect_complete(*forest, found, doubles(centre), range + 1e-8);
      if (testing::Test::HasFatalFailure()) return result;
      ++result.searches;
      result.shrunk += found.range < sim::to_fixed<Position>(range) ? 1u : 0u;
      SurfacePoint nearest{};
      const double distance = distance_to(faces_of(*forest), doubles(centre));
      if (!nearest_surface(*forest, found, centre, nearest)) {
        EXPECT_GT(distance, sim::to_double(found.range));
        continue;
      }
      EXPECT_GE(std::abs(sim::to_double(nearest.distance)), distance - 1e-7);
      if (distance > sim::to_double(found.range)) continue;
      ++result.certain;
      EXPECT_NEAR(std::abs(sim::to_double(nearest.distance)), distance, 1e-7);
      if (distance < 1e-3) continue;
      const Vector3d d = doubles(centre) - doubles(nearest.point);
      EXPECT_NEAR(std::abs(doubles(nearest.normal).dot(d)), distance, 1e-6);
      EXPECT_NEAR(doubles(nearest.normal).dot(d), sim::to_double(nearest.distance), 1e-6);
    }
  }
  return result;
}

TEST(TouchSurface, CandidatesAreAllWithinTheRange) {
  const Found found = search_at_random<64>(312, in_soak(5000u, 60u));
  std::printf("64 candidates: of %u searches %u shrank, %u found the closest point\n", found.searches,
              found.shrunk, found.certain);
  EXPECT_GT(found.certain, found.searches / 3);
}

/// With no room for most of them the range shrinks, and what is within it is still complete.
TEST(TouchSurface, ARangeThatIsTooFullShrinks) {
  const Found found = search_at_random<5>(313, in_soak(5000u, 60u));
  std::printf("5 candidates: of %u searches %u shrank, %u found the closest point\n", found.searches,
              found.shrunk, found.certain);
  EXPECT_GT(found.shrunk, found.searches / 5);
  EXPECT_GT(found.certain, found.searches / 20);
}

/// All faces equally near: none can be dropped for another, and the range says so.
TEST(TouchSurface, ANodeWhereTooManyMeetIsNotCertain) {
  using Profile = FewCandidates<4>;
  const auto forest = roots_of<Profile>(full_block(1, 1, 1));
  Candidates<Profile> found;
  find_candidates(*forest, zero_vector<Position>(), Position::ratio(1, 1), found);
  EXPECT_EQ(found.count, 4u);
  EXPECT_LT(found.range, Position::ratio(1, 2));
}

/// More faces in range than may be looked at: what was seen is no whole.
TEST(TouchSurface, MoreFacesThanLooksAreNotCertain) {
  using Profile = FewCandidates<4>;
  const auto forest = roots_of<Profile>(full_block(3, 1, 1));  // 28 faces
  Candidates<Profile> found;
  find_candidates(*forest, zero_vector<Position>(), Position::ratio(3, 1), found);
  EXPECT_LT(found.range, Position::from_raw(0));
  find_candidates(*forest,
                  Vector3<Position>(Position::ratio(3, 2), Position::ratio(1, 4), Position::ratio(1, 8)),
                  Position::ratio(1, 16), found);
  EXPECT_EQ(found.range, Position::ratio(1, 16));
  EXPECT_GT(found.count, 0u);
}

/// Straight behind a face it is inside; in front of it, and beside any edge or corner, outside.
TEST(TouchSurface, KnowsInsideFromOutside) {
  Random random(314);
  using Profile = FewCandidates<64>;
  Candidates<Profile> found;
  uint32_t inside = 0;
  for (int round = 0; round < 40; ++round) {
    const auto forest = changed_forest<Profile>(random, 60);
    deform_smoothly(*forest, random, 0.2);
    const auto faces = faces_of(*forest);
    for (int i = 0; i < 40; ++i) {
      const auto x = fixed_vector<Position>(Vector3d(random.vector().cwiseProduct(Vector3d(1.8, 1.2, 1.2))));
      find_candidates(*forest, x, Position::ratio(1, 2), found);
      SurfacePoint nearest{};
      if (!nearest_surface(*forest, found, x, nearest) || nearest.distance > found.range) continue;
      if (std::abs(sim::to_double(nearest.distance)) < 1e-4) continue;
      const bool is_inside = winding_number(faces, doubles(x)) > 0.5;
      if (!is_inside) {
        EXPECT_GT(nearest.distance.raw(), 0);
      }
      inside += nearest.distance.raw() < 0 ? 1u : 0u;
      if (nearest.distance.raw() < 0) {
        EXPECT_TRUE(is_inside);
      }
    }
  }
  EXPECT_GT(inside, 100u);
}

}  // namespace
}  // namespace palpate::test
