// Renews the misfits of all groups, some leaves at a time: what a group would gain from a split changes
// slowly, and is not asked for while it blends.
#pragma once

#include "palpate/elastic/misfit.hpp"

namespace palpate {

/// Slices in which all misfits are renewed; twice as many where groups are of very different size.
inline constexpr uint32_t kMisfitSlices = 8;

/// How far the renewal is: in the middle of a group.
struct MisfitSweep {
  uint16_t group_at;  // the group's place among the live ones
  uint16_t tet;       // the group as it was: another one, or one with other leaves, is begun anew
  uint16_t leaves;
  uint16_t leaf_at;  // of its leaves, the next one
  MisfitSums sums;   // of those before it
  // Scratch, of the group: not on the stack, whose variables then meet no pointer.
  RotationMatrix rotation;

  void clear() { begin(0); }
  void begin(uint16_t at) {
    group_at = at;
    tet = kNone;
    leaves = leaf_at = 0;
    sums.clear();
  }
  /// The group at group_at, whose tet and number of leaves these are now.
  void resume(uint16_t tet_now, uint16_t leaves_now) {
    if (tet == tet_now && leaves == leaves_now) return;
    begin(group_at);
    tet = tet_now;
    leaves = leaves_now;
  }
};

namespace misfit_detail {

/// 2 w of a leaf, turned by R: of F R^T instead of R^T F. With the leaf's edge vectors g_k along s_k times an
/// axis, and r_k that column of R, it is the sum of s_k r_k x g_k / h. Within +-8, exact to 2^-23 / h.
inline Vector3<Strain> turn_of(const Leaf& leaf, const EdgeVectors& edges, const RotationMatrix& r) {
  using Moment = Q<6, 25>;  // r_k x g_k, of components of g within +-8
  Vector3<Moment> sum = zero_vector<Moment>();
  const auto add = [&](uint32_t k, const EdgeVector& g) {
    const RotationEntry* column = r.data() + std::size_t{3} * leaf.axes().axis(k);
    const int32_t minus = leaf.axes().is_negative(k) ? -1 : 0;
    const auto along = [&](Eigen::Index axis) { return Position::from_raw(within_bits<31>(g[axis].raw())); };
    const Position x = along(0);
    const Position y = along(1);
    const Position z = along(2);
    const RotationEntry a = with_sign(minus, column[0]);
    const RotationEntry b = with_sign(minus, column[1]);
    const RotationEntry c = with_sign(minus, column[2]);
    sum[0] = multiply_add_high(b, z, multiply_add_high(-c, y, sum[0]));
    sum[1] = multiply_add_high(c, x, multiply_add_high(-a, z, sum[1]));
    sum[2] = multiply_add_high(a, y, multiply_add_high(-b, x, sum[2]));
  };
  add(0, edges.g1);
  add(1, edges.g2);
  add(2, edges.g3);
  const int shift = Strain::kFractionBits - Moment::kFractionBits + size_of_level(leaf.level());
  const auto limit = Moment::from_raw(((int32_t{8} << Strain::kFractionBits) - 1) >> shift);
  const auto scaled = [&](Moment moment) {  // by size and sign: one comparison needs no branch
    const int32_t minus = moment.raw() >> 31;
    const Moment size = with_sign(minus, moment);
    const Moment within = size < limit ? size : limit;
    return Strain::from_raw(with_sign(minus, within).raw() * (1 << shift));
  };
  return Vector3<Strain>(scaled(sum[0]), scaled(sum[1]), scaled(sum[2]));
}

/// The leaf is below the group's tet.
template <class Profile>
void add_leaf(const Forest<Profile>& forest, const Leaf& leaf, const RotationMatrix& r, uint8_t group_level,
              MisfitSums& sums) {
  const auto& x = forest.node.position;
  const EdgeVectors edges = edge_vectors(type_of_level(leaf.level()), x[leaf.node[0]], x[leaf.node[1]],
                                         x[leaf.node[2]], x[leaf.node[3]]);
  sums.add(turn_of(leaf, edges, r), leaf.path(), static_cast<uint32_t>(leaf.level() - group_level));
}

}  // namespace misfit_detail

/// Goes on through the leaves, in the order of the groups' lists. O((leaves + groups) / kMisfitSlices).
template <class Profile>
void renew_misfits(const Forest<Profile>& forest, const RotationFront<Profile>& front,
                   Groups<Profile>& groups, MisfitSweep& sweep) {
  const auto slice = [](uint32_t leaves) { return (leaves + kMisfitSlices - 1) / kMisfitSlices; };
  constexpr uint32_t kMostGroups = Profile::kGroups / kMisfitSlices + 1;
  auto leaves = bounded_total<slice(Profile::kLeaves)>([] {});
  uint32_t left = slice(forest.leaf_count);
  for ([[maybe_unused]] const uint32_t i : bounded<kMostGroups>(kMostGroups, [] {})) {
    if (sweep.group_at >= front.groups.used()) sweep.begin(0);
    const uint16_t group = front.groups.live(sweep.group_at);
    const Span span = front.leaves[group];
    sweep.resume(front.tet[group], span.count);
    const uint8_t level = forest.level_of(front.tet[group]);
    rotation_matrix(groups.used[group], sweep.rotation);
    const uint32_t rest = static_cast<uint32_t>(span.count) - sweep.leaf_at;
    const uint32_t count = rest < left ? rest : left;
    left -= count;
    const uint32_t below =
        forest.tet[front.tet[group]].is_leaf() ? 0u : count;  // a single leaf has no misfit
    for (const uint32_t k : leaves.take(static_cast<uint32_t>(span.begin) + sweep.leaf_at, below)) {
      misfit_detail::add_leaf(forest, forest.leaf[front.leaf_order[k]], sweep.rotation, level, sweep.sums);
    }
    sweep.leaf_at = static_cast<uint16_t>(sweep.leaf_at + count);
    if (sweep.leaf_at < span.count) return;
    sweep.sums.finish(level, groups.misfit[group], groups.misfit_left[group]);
    sweep.begin(static_cast<uint16_t>(sweep.group_at + 1));
  }
}

}  // namespace palpate
