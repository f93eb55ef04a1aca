// A leaf in its group's frame: at rest it pulls at nothing, whatever its material and however it lies.
#include "palpate/elastic/leaf_force.hpp"

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace palpate::test {
namespace {

using Corner = Vector3<Position>;

Corner along(uint32_t signed_axis, Position length) {
  Corner g = zero_vector<Position>();
  g[signed_axis & 3u] = (signed_axis & 4u) != 0 ? -length : length;
  return g;
}

Corner half(const Corner& v) {
  const auto of = [](Position x) { return Position::from_raw(x.raw() / 2); };
  return Corner(of(v[0]), of(v[1]), of(v[2]));
}

struct LeafAtRest {
  Corner w[4];
  Axes axes;
};

/// The signed axes of g1, g2, g3; edges of length h.
LeafAtRest at_rest(TetType type, const uint32_t (&axis)[3], Position h) {
  const Corner g1 = along(axis[0], h);
  const Corner g2 = along(axis[1], h);
  const Corner g3 = along(axis[2], h);
  LeafAtRest tet;
  tet.axes = Axes::of(axis[0], axis[1], axis[2]);
  tet.w[0] = zero_vector<Position>();
  tet.w[1] = g1;
  tet.w[2] = type == TetType::kType2 ? half(g1 + g2) : Corner(g1 + g2);
  tet.w[3] = type == TetType::kType0   ? Corner(tet.w[2] + g3)
             : type == TetType::kType1 ? half(g3 + tet.w[2])
                                       : Corner(tet.w[2] + half(g3));
  return tet;
}

template <uint8_t Level>
void expect_no_force(Random& random) {
  constexpr uint32_t kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  const Position h = Position::from_raw((int32_t{1} << Position::kFractionBits) >> size_of_level(Level));
  for (uint32_t i = 0; i < 48; ++i) {
    const auto& order = kOrders[i / 8];
    const uint32_t axis[3] = {order[0] | (i & 1u) << 2, order[1] | (i & 2u) << 1, order[2] | (i & 4u)};
    const LeafAtRest tet = at_rest(type_of_level(Level), axis, h);
    for (int j = 0; j < 100; ++j) {
      const Material material{ShearCoefficient::from_raw(static_cast<int32_t>(random.below(1u << 27))),
                              BulkCoefficient::from_raw(static_cast<int32_t>(random.below(5u << 28)))};
      ClampFlag clamped;
      LeafForce<Level> leaf(tet.axes);
      leaf.gather(tet.w[0], tet.w[1], tet.w[2], tet.w[3], clamped);
      Vector3<FrameForce> f[4];
      for (auto& force : f) force = zero_vector<FrameForce>();
      leaf.set_stresses(material, clamped);
      leaf.scatter(f[0], f[1], f[2], f[3], clamped);
      for (const auto& force : f) ASSERT_EQ(force, zero_vector<FrameForce>()) << int{Level} << " " << i;
      ASSERT_FALSE(clamped.take());
    }
  }
}

TEST(ElasticLeafForce, IsZeroAtRestForAnyMaterialAndAxes) {
  Random random(71);
  expect_no_force<0>(random);
  expect_no_force<1>(random);
  expect_no_force<2>(random);
  expect_no_force<6>(random);
  expect_no_force<10>(random);
  expect_no_force<14>(random);
}

}  // namespace
}  // namespace palpate::test
