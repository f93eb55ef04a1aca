// Corotated forces of all leaves, group by group in the group's own frame: its nodes are rotated once, a leaf
// then needs differences and 7 multiplies, and the sums are rotated back once a node and group.
#pragma once

#include "palpate/elastic/leaf_force.hpp"

namespace palpate {

/// Scratch of one evaluation: positions and forces in the frame of the group at hand, by node. Beside each
/// other, so that a node is one address.
template <class Profile>
struct GroupFrame {
  struct Node {
    Vector3<Position> position;
    Vector3<Force> force;
  };
  std::array<Node, Profile::kNodes> node;
};

/// A rotation's entries below 1, so that a product's high word is its value.
using FrameEntry = Q<0, 31>;

namespace group_forces_detail {

/// Of a coordinate in the group's frame: +-4 edges.
inline constexpr int kPositionBits = 30;

/// An entry of 1 becomes the largest one below it; what `clamped` knew is forgotten.
inline Matrix3<FrameEntry> frame_of(const Quaternion& q, ClampFlag& clamped) {
  Matrix3<FrameEntry> frame(rotation_matrix(q).unaryExpr(
      [&clamped](RotationEntry entry) { return FrameEntry::from_raw(2 * clamped.clamp<31>(entry).raw()); }));
  (void)clamped.take();
  return frame;
}

/// R^T (x - origin), within +-4 edges so that no edge vector overflows.
inline Vector3<Position> into_frame(const Matrix3<FrameEntry>& frame, const Vector3<Position>& x,
                                    const Vector3<Position>& origin, ClampFlag& clamped) {
  using Doubled = Q<3, 28>;  // |x - origin| < 8
  const Vector3<Position> d = x - origin;
  const Vector3<Doubled> from_origin(Doubled::from_raw(2 * d[0].raw()), Doubled::from_raw(2 * d[1].raw()),
                                     Doubled::from_raw(2 * d[2].raw()));
  const Vector3<Position> turned = narrow<Position>(frame.transpose() * from_origin);
  return Vector3<Position>(clamped.clamp<kPositionBits>(turned[0]), clamped.clamp<kPositionBits>(turned[1]),
                           clamped.clamp<kPositionBits>(turned[2]));
}

}  // namespace group_forces_detail

/// Whether a force evaluation also fills Groups::gradient, misfit and misfit_left.
enum class Observe : bool { kNo, kYes };

template <class Profile>
class GroupForces {
 public:
  GroupForces(Forest<Profile>& forest, const RotationFront<Profile>& front, Groups<Profile>& groups,
              const Materials& materials, GroupFrame<Profile>& frame)
      : forest_(forest), front_(front), groups_(groups), materials_(materials), frame_(frame) {}

  /// Of nodes `at` these places, into the forest. Returns the number of groups in which something was
  /// clamped.
  template <Observe Mode>
  uint32_t evaluate(const std::array<Vector3<Position>, Profile::kNodes>& at) {
    clear_forces();
    auto nodes = bounded_total<RotationFront<Profile>::kGroupNodes>([] {});
    auto leaves = bounded_total<Profile::kLeaves>([] {});
    auto nodes_back = bounded_total<RotationFront<Profile>::kGroupNodes>([] {});
    ClampFlag clamped;
    uint32_t clamped_groups = 0;
    for (const uint32_t i : bounded<Profile::kGroups>(front_.groups.used(), [] {})) {
      const uint16_t group = front_.groups.live(i);
      const Span span = front_.nodes[group];
      const Matrix3<FrameEntry> r = group_forces_detail::frame_of(groups_.used[group], clamped);
      const Vector3<Position>& origin = at[front_.node_order[span.begin]];
      for (const uint32_t k : nodes.take(span.begin, span.count)) {
        const uint16_t node = front_.node_order[k];
        frame_.node[node] = {group_forces_detail::into_frame(r, at[node], origin, clamped),
                             zero_vector<Force>()};
      }
      add_leaves<Mode>(group, leaves, clamped);
      clamped_groups += clamped.take() ? 1u : 0u;
      add_to_nodes(r, nodes_back.take(span.begin, span.count));
    }
    return clamped_groups;
  }

 private:
  void clear_forces() {
    for (const uint32_t i : bounded<Profile::kNodes>(forest_.nodes.used(), [] {})) {
      forest_.node.force[forest_.nodes.live(i)] = zero_vector<Force>();
    }
  }

  /// Forces of a group's leaves, into frame_.
  template <Observe Mode, class Total>
  void add_leaves(uint16_t group, Total& leaves, ClampFlag& clamped) {
    const Span span = front_.leaves[group];
    const uint8_t group_level = forest_.tet[front_.tet[group]].level;
    Observation seen;
    for (const uint32_t k : leaves.take(span.begin, span.count)) {
      add_leaf<Mode>(forest_.leaf[front_.leaf_order[k]], group_level, seen, clamped);
    }
    if constexpr (Mode == Observe::kYes) {
      groups_.gradient[group] = narrow<Stretch>(rotation_matrix(groups_.used[group]) * seen.mean());
      seen.misfit().finish(group_level, groups_.misfit[group], groups_.misfit_left[group]);
    }
  }

  template <Observe Mode>
  PALPATE_ALWAYS_INLINE void add_leaf(const Leaf& leaf, uint8_t group_level, Observation& seen,
                                      ClampFlag& clamped) {
    switch (leaf.level) {
      case 0:
        return add_leaf_of<0, Mode>(leaf, group_level, seen, clamped);
      case 1:
        return add_leaf_of<1, Mode>(leaf, group_level, seen, clamped);
      case 2:
        return add_leaf_of<2, Mode>(leaf, group_level, seen, clamped);
      case 3:
        return add_leaf_of<3, Mode>(leaf, group_level, seen, clamped);
      case 4:
        return add_leaf_of<4, Mode>(leaf, group_level, seen, clamped);
      case 5:
        return add_leaf_of<5, Mode>(leaf, group_level, seen, clamped);
      case 6:
        return add_leaf_of<6, Mode>(leaf, group_level, seen, clamped);
      case 7:
        return add_leaf_of<7, Mode>(leaf, group_level, seen, clamped);
      case 8:
        return add_leaf_of<8, Mode>(leaf, group_level, seen, clamped);
      case 9:
        return add_leaf_of<9, Mode>(leaf, group_level, seen, clamped);
      case 10:
        return add_leaf_of<10, Mode>(leaf, group_level, seen, clamped);
      case 11:
        return add_leaf_of<11, Mode>(leaf, group_level, seen, clamped);
      case 12:
        return add_leaf_of<12, Mode>(leaf, group_level, seen, clamped);
      case 13:
        return add_leaf_of<13, Mode>(leaf, group_level, seen, clamped);
      default:
        return add_leaf_of<14, Mode>(leaf, group_level, seen, clamped);
    }
  }

  /// Levels that the profile does not have take no code.
  template <uint8_t Level, Observe Mode>
  PALPATE_ALWAYS_INLINE void add_leaf_of([[maybe_unused]] const Leaf& leaf,
                                         [[maybe_unused]] uint8_t group_level,
                                         [[maybe_unused]] Observation& seen,
                                         [[maybe_unused]] ClampFlag& clamped) {
    static_assert(Level <= kDeepestLevel);
    if constexpr (Level <= Profile::kMaxLevel) {
      auto& n0 = frame_.node[leaf.node[0]];
      auto& n1 = frame_.node[leaf.node[1]];
      auto& n2 = frame_.node[leaf.node[2]];
      auto& n3 = frame_.node[leaf.node[3]];
      LeafForce<Level> force(leaf.axes);
      force.gather(n0.position, n1.position, n2.position, n3.position, clamped);
      if constexpr (Mode == Observe::kYes) {
        force.observe(leaf, group_level, seen);
      }
      force.scatter(materials_[leaf.region], n0.force, n1.force, n2.force, n3.force, clamped);
    }
  }

  /// Rotates the sums back. Rounding leaves a net force of some LSB, which the group's first node takes back.
  template <class Range>
  void add_to_nodes(const Matrix3<FrameEntry>& r, Range range) {
    Vector3<Force> net = zero_vector<Force>();
    uint16_t first = kNone;
    for (const uint32_t k : range) {
      const uint16_t node = front_.node_order[k];
      const Vector3<Force> force = narrow<Force>(r * frame_.node[node].force);
      forest_.node.force[node] += force;
      net += force;
      first = first == kNone ? node : first;
    }
    if (first != kNone) forest_.node.force[first] -= net;
  }

  Forest<Profile>& forest_;
  const RotationFront<Profile>& front_;
  Groups<Profile>& groups_;
  const Materials& materials_;
  GroupFrame<Profile>& frame_;
};

}  // namespace palpate
