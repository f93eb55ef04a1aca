// Corotated forces of all leaves, group by group in the group's own frame: its nodes are rotated once, a leaf
// then needs differences and 7 multiplies, and the sums are rotated back once a node and group.
#pragma once

#include "palpate/elastic/groups.hpp"
#include "palpate/elastic/leaf_force.hpp"

namespace palpate {

/// A rotation's entries below 1, so that a product's high word is its value.
using FrameEntry = Q<0, 31>;

/// Scratch of one evaluation: the frame of the group at hand, and positions and forces in it of the group's
/// nodes, in the order of its list. Beside each other, so that a node is one address.
template <class Profile>
struct GroupFrame {
  struct Node {
    Vector3<Position> position;
    Vector3<FrameForce> force;
  };
  Matrix3<FrameEntry> rotation;
  MeanGradient gradient;  // of its leaves
  std::array<Node, RotationFront<Profile>::kNodesOfGroup> node;
};

namespace group_forces_detail {

/// An entry of 1 becomes the largest one below it, which no ClampFlag may take for its own.
PALPATE_NOINLINE inline void set_frame(const Quaternion& q, Matrix3<FrameEntry>& frame) {
  frame = rotation_matrix(q).unaryExpr(
      [](RotationEntry entry) { return FrameEntry::from_raw(2 * within_bits<31>(entry.raw())); });
}

/// The frame's entries as variables, whose address nobody has: no store can meet them.
struct FrameEntries {
  PALPATE_ALWAYS_INLINE explicit FrameEntries(const Matrix3<FrameEntry>& frame)
      : xx(frame(0, 0)),
        xy(frame(0, 1)),
        xz(frame(0, 2)),
        yx(frame(1, 0)),
        yy(frame(1, 1)),
        yz(frame(1, 2)),
        zx(frame(2, 0)),
        zy(frame(2, 1)),
        zz(frame(2, 2)) {}
  FrameEntry xx, xy, xz, yx, yy, yz, zx, zy, zz;
};
/// As variables too, raw.
struct Place {
  int32_t x, y, z;
};

/// R^T (x - origin), within +-4 edges so that no edge vector overflows; `twice` is 2 origin. Rounded once,
/// here and below: roundings in an order make a body swing that is pressed just so.
PALPATE_ALWAYS_INLINE Vector3<Position> into_frame(const FrameEntries& r, const Vector3<Position>& x,
                                                   const Place& twice, ClampFlag& clamped) {
  using Doubled = Q<3, 28>;  // |x - origin| < 8
  const auto d0 = Doubled::from_raw(2 * x[0].raw() - twice.x);
  const auto d1 = Doubled::from_raw(2 * x[1].raw() - twice.y);
  const auto d2 = Doubled::from_raw(2 * x[2].raw() - twice.z);
  const auto along = [&](FrameEntry a, FrameEntry b, FrameEntry c) {
    return clamped.clamp<kPositionBits>(narrow<Position>(a * d0 + b * d1 + c * d2));
  };
  return Vector3<Position>(along(r.xx, r.yx, r.zx), along(r.xy, r.yy, r.zy), along(r.xz, r.yz, r.zz));
}

/// R f.
PALPATE_ALWAYS_INLINE Vector3<Force> out_of_frame(const FrameEntries& r, const Vector3<FrameForce>& f) {
  const auto along = [&](FrameEntry a, FrameEntry b, FrameEntry c) {
    return narrow<Force>(a * f[0] + b * f[1] + c * f[2]);
  };
  return Vector3<Force>(along(r.xx, r.xy, r.xz), along(r.yx, r.yy, r.yz), along(r.zx, r.zy, r.zz));
}

}  // namespace group_forces_detail

/// Whether a force evaluation also fills Groups::gradient.
enum class Observe : bool { kNo, kYes };

template <class Profile>
class GroupForces {
 public:
  GroupForces(Forest<Profile>& forest, RotationFront<Profile>& front, Groups<Profile>& groups,
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
      check(span.count <= frame_.node.size(), "a group has more nodes than a root can have");
      group_forces_detail::set_frame(groups_.used[group], frame_.rotation);
      (void)clamped.take();
      const group_forces_detail::FrameEntries r(frame_.rotation);
      const Vector3<Position>& origin = at[front_.node_order[span.begin]];
      const group_forces_detail::Place twice{2 * origin[0].raw(), 2 * origin[1].raw(), 2 * origin[2].raw()};
      for (const uint32_t k : nodes.take(span.begin, span.count)) {
        const uint16_t node = front_.node_order[k];
        const uint32_t place = k - span.begin;
        frame_.node[place] = {group_forces_detail::into_frame(r, at[node], twice, clamped),
                              zero_vector<FrameForce>()};
        front_.mark[node] = place;
      }
      const Span own = front_.leaves[group];
      if constexpr (Mode == Observe::kYes) {
        observe_leaves(group, leaves.take(own.begin, own.count), clamped);
      } else {
        add_leaves(leaves.take(own.begin, own.count), clamped);
      }
      clamped_groups += clamped.take() ? 1u : 0u;
      add_to_nodes(r, span.begin, nodes_back.take(span.begin, span.count));
    }
    return clamped_groups;
  }

 private:
  struct SeesNothing {
    template <class OfLeaf>
    PALPATE_ALWAYS_INLINE void operator()(const OfLeaf&) const {}
  };
  struct AddsGradient {
    uint32_t depth;
    MeanGradient& mean;
    template <class OfLeaf>
    PALPATE_ALWAYS_INLINE void operator()(const OfLeaf& force) const {
      force.add_gradient(depth, mean);
    }
  };

  [[nodiscard]] PALPATE_ALWAYS_INLINE typename GroupFrame<Profile>::Node& in_frame(uint16_t node) {
    return frame_.node[front_.mark[node]];
  }

  void clear_forces() {
    for (const uint32_t i : bounded<Profile::kNodes>(forest_.nodes.used(), [] {})) {
      forest_.node.force[forest_.nodes.live(i)] = zero_vector<Force>();
    }
  }

  /// Forces of a group's leaves, which `range` goes through, into frame_.
  template <class Range>
  PALPATE_ALWAYS_INLINE void add_leaves(Range range, ClampFlag& clamped) {
    for (const uint32_t k : range) {
      add_leaf(forest_.leaf[front_.leaf_order[k]], SeesNothing{}, clamped);
    }
  }
  /// And their mean gradient.
  template <class Range>
  PALPATE_ALWAYS_INLINE void observe_leaves(uint16_t group, Range range, ClampFlag& clamped) {
    const uint8_t group_level = forest_.level_of(front_.tet[group]);
    const Vector3<Strain> none = zero_vector<Strain>();
    frame_.gradient.template topRows<3>() << none, none, none;
    for (const uint32_t k : range) {
      const Leaf& leaf = forest_.leaf[front_.leaf_order[k]];
      const auto depth = static_cast<uint32_t>(leaf.level() - group_level);
      add_leaf(leaf, AddsGradient{depth, frame_.gradient}, clamped);
    }
    set_gradient(group);
  }
  PALPATE_NOINLINE void set_gradient(uint16_t group) {
    const Matrix3<Strain> mean = frame_.gradient.template topRows<3>().transpose();
    groups_.gradient[group] = narrow<Stretch>(frame_.rotation * mean);
  }

  /// `see` is shown the leaf's LeafForce between its edge vectors and its forces. The level is held to the
  /// profile's, so that the table of levels needs no check of its own.
  template <class See>
  PALPATE_ALWAYS_INLINE void add_leaf(const Leaf& leaf, See see, ClampFlag& clamped) {
    const uint32_t level = leaf.level();
    switch (level < Profile::kMaxLevel ? level : Profile::kMaxLevel) {
      case 0:
        return add_leaf_of<0>(leaf, see, clamped);
      case 1:
        return add_leaf_of<1>(leaf, see, clamped);
      case 2:
        return add_leaf_of<2>(leaf, see, clamped);
      case 3:
        return add_leaf_of<3>(leaf, see, clamped);
      case 4:
        return add_leaf_of<4>(leaf, see, clamped);
      case 5:
        return add_leaf_of<5>(leaf, see, clamped);
      case 6:
        return add_leaf_of<6>(leaf, see, clamped);
      case 7:
        return add_leaf_of<7>(leaf, see, clamped);
      case 8:
        return add_leaf_of<8>(leaf, see, clamped);
      case 9:
        return add_leaf_of<9>(leaf, see, clamped);
      case 10:
        return add_leaf_of<10>(leaf, see, clamped);
      case 11:
        return add_leaf_of<11>(leaf, see, clamped);
      case 12:
        return add_leaf_of<12>(leaf, see, clamped);
      case 13:
        return add_leaf_of<13>(leaf, see, clamped);
      case 14:
        return add_leaf_of<14>(leaf, see, clamped);
      default:
        __builtin_unreachable();  // no level is above kMaxLevel
    }
  }

  /// Levels that the profile does not have take no code.
  template <uint8_t Level, class See>
  PALPATE_ALWAYS_INLINE void add_leaf_of([[maybe_unused]] const Leaf& leaf, [[maybe_unused]] See see,
                                         [[maybe_unused]] ClampFlag& clamped) {
    static_assert(Level <= kDeepestLevel);
    if constexpr (Level <= Profile::kMaxLevel) {
      auto& n0 = in_frame(leaf.node[0]);
      auto& n1 = in_frame(leaf.node[1]);
      auto& n2 = in_frame(leaf.node[2]);
      auto& n3 = in_frame(leaf.node[3]);
      LeafForce<Level> force(leaf.axes());
      force.gather(n0.position, n1.position, n2.position, n3.position, clamped);
      see(force);
      force.scatter(materials_[leaf.region()], n0.force, n1.force, n2.force, n3.force, clamped);
    }
  }

  /// Rotates the sums back. Rounding leaves a net force of some LSB, which the group's first node takes back.
  template <class Range>
  PALPATE_ALWAYS_INLINE void add_to_nodes(const group_forces_detail::FrameEntries& r, uint16_t begin,
                                          Range range) {
    Vector3<Force> net = zero_vector<Force>();
    for (const uint32_t k : range) {
      const uint16_t node = front_.node_order[k];
      Vector3<Force>& sum = forest_.node.force[node];
      const Force x = sum[0];  // all of it before any is stored: a load may have to wait for a store
      const Force y = sum[1];
      const Force z = sum[2];
      const Vector3<Force> force = group_forces_detail::out_of_frame(r, frame_.node[k - begin].force);
      sum = Vector3<Force>(x + force[0], y + force[1], z + force[2]);
      net += force;
    }
    forest_.node.force[front_.node_order[begin]] -= net;
  }

  Forest<Profile>& forest_;
  RotationFront<Profile>& front_;
  Groups<Profile>& groups_;
  const Materials& materials_;
  GroupFrame<Profile>& frame_;
};

}  // namespace palpate
