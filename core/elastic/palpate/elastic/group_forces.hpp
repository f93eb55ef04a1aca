// Corotated forces of all leaves, group by group in the group's own frame: its nodes are rotated once, a leaf
// then needs differences, shifts and 7 multiplies, and the sums are rotated back once a node and group.
#pragma once

#include "palpate/elastic/leaf_force.hpp"
#include "palpate/elastic/misfit.hpp"

namespace palpate {

/// Scratch of one evaluation: positions and forces in the frame of the group at hand, by node.
template <class Profile>
struct GroupFrame {
  std::array<Vector3<Position>, Profile::kNodes> position;
  std::array<Vector3<Force>, Profile::kNodes> force;
};

/// A rotation's entries below 1, so that a product's high word is its value.
using FrameEntry = Q<0, 31>;

namespace group_forces_detail {

/// Of a coordinate in the group's frame.
inline constexpr Position kLimit = Position::from_raw((int32_t{4} << Position::kFractionBits) - 1);

inline Matrix3<FrameEntry> frame_of(const Quaternion& q) {
  return Matrix3<FrameEntry>(rotation_matrix(q).unaryExpr([](RotationEntry entry) {
    return narrow_saturated<FrameEntry>(widen<FrameEntry::kFractionBits>(entry));
  }));
}

/// R^T (x - origin), within +-4 edges so that no edge vector overflows.
inline Vector3<Position> into_frame(const Matrix3<FrameEntry>& frame, const Vector3<Position>& x,
                                    const Vector3<Position>& origin, uint32_t& clamped) {
  using Doubled = Q<3, 28>;  // |x - origin| < 8
  const Vector3<Position> d = x - origin;
  const Vector3<Doubled> from_origin(Doubled::from_raw(2 * d[0].raw()), Doubled::from_raw(2 * d[1].raw()),
                                     Doubled::from_raw(2 * d[2].raw()));
  const Vector3<Position> turned = narrow<Position>(frame.transpose() * from_origin);
  const auto within = [&clamped](Position coordinate) {
    const Position inside = clamp(coordinate, -kLimit, kLimit);
    clamped |= static_cast<uint32_t>(coordinate.raw() ^ inside.raw());
    return inside;
  };
  return Vector3<Position>(within(turned[0]), within(turned[1]), within(turned[2]));
}

/// What an observing evaluation gathers over the leaves of a group.
struct Observation {
  Matrix3<Strain> mean;
  MisfitSums misfit;

  Observation() {
    for (const uint32_t i : bounded<9>(9, [] {})) mean.data()[i] = Strain::from_raw(0);
  }
  /// A leaf `depth` levels below the group's tet.
  void add(const Matrix3<Strain>& a, uint32_t path, uint32_t depth) {
    const int32_t half = static_cast<int32_t>((uint32_t{1} << depth) >> 1);
    for (const uint32_t i : bounded<9>(9, [] {})) {
      mean.data()[i] += Strain::from_raw((a.data()[i].raw() + half) >> depth);
    }
    misfit.add(a, path, depth);
  }
};

}  // namespace group_forces_detail

/// Whether a force evaluation also fills Groups::gradient, misfit and misfit_left.
enum class Observe : bool { kNo, kYes };

template <class Profile>
class GroupForces {
 public:
  GroupForces(Forest<Profile>& forest, const RotationFront<Profile>& front, Groups<Profile>& groups,
              const Materials& materials, GroupFrame<Profile>& frame)
      : forest_(forest), front_(front), groups_(groups), materials_(materials), frame_(frame) {}

  /// See evaluate_forces.
  template <Observe Mode>
  uint32_t evaluate(const std::array<Vector3<Position>, Profile::kNodes>& at) {
    clear_forces();
    auto nodes = bounded_total<RotationFront<Profile>::kGroupNodes>([] {});
    auto leaves = bounded_total<Profile::kLeaves>([] {});
    auto nodes_back = bounded_total<RotationFront<Profile>::kGroupNodes>([] {});
    uint32_t clamped_leaves = 0;
    for (const uint32_t i : bounded<Profile::kGroups>(front_.groups.used(), [] {})) {
      const uint16_t group = front_.groups.live(i);
      const Span span = front_.nodes[group];
      const Matrix3<FrameEntry> r = group_forces_detail::frame_of(groups_.used[group]);
      const Vector3<Position>& origin = at[front_.node_order[span.begin]];
      uint32_t clamped = 0;
      for (const uint32_t k : nodes.take(span.begin, span.count)) {
        const uint16_t node = front_.node_order[k];
        frame_.position[node] = group_forces_detail::into_frame(r, at[node], origin, clamped);
        frame_.force[node] = zero_vector<Force>();
      }
      clamped_leaves += clamped != 0 ? 1u : 0u;
      clamped_leaves += add_leaves<Mode>(group, leaves);
      add_to_nodes(r, nodes_back.take(span.begin, span.count));
    }
    return clamped_leaves;
  }

 private:
  void clear_forces() {
    for (const uint32_t i : bounded<Profile::kNodes>(forest_.nodes.used(), [] {})) {
      forest_.node.force[forest_.nodes.live(i)] = zero_vector<Force>();
    }
  }

  /// Forces of a group's leaves, into frame_.force. Returns the number of clamped leaves.
  template <Observe Mode, class Total>
  uint32_t add_leaves(uint16_t group, Total& leaves) {
    const Span span = front_.leaves[group];
    const uint8_t group_level = forest_.tet[front_.tet[group]].level;
    group_forces_detail::Observation seen;
    uint32_t clamped_leaves = 0;
    for (const uint32_t k : leaves.take(span.begin, span.count)) {
      const Leaf& leaf = forest_.leaf[front_.leaf_order[k]];
      uint32_t clamped = 0;
      switch (type_of_level(leaf.level)) {
        case TetType::kType0:
          add_leaf<TetType::kType0, Mode>(leaf, group_level, seen, clamped);
          break;
        case TetType::kType1:
          add_leaf<TetType::kType1, Mode>(leaf, group_level, seen, clamped);
          break;
        default:
          add_leaf<TetType::kType2, Mode>(leaf, group_level, seen, clamped);
          break;
      }
      clamped_leaves += clamped != 0 ? 1u : 0u;
    }
    if constexpr (Mode == Observe::kYes) {
      groups_.gradient[group] = narrow<Stretch>(rotation_matrix(groups_.used[group]) * seen.mean);
      seen.misfit.finish(group_level, groups_.misfit[group], groups_.misfit_left[group]);
    }
    return clamped_leaves;
  }

  template <TetType Type, Observe Mode>
  PALPATE_ALWAYS_INLINE void add_leaf(const Leaf& leaf, uint8_t group_level,
                                      group_forces_detail::Observation& seen, uint32_t& clamped) {
    const auto& y = frame_.position;
    auto& f = frame_.force;
    LeafForce<Type> force(leaf.axes, leaf.level);
    force.gather(y[leaf.node[0]], y[leaf.node[1]], y[leaf.node[2]], y[leaf.node[3]], clamped);
    if constexpr (Mode == Observe::kYes) {
      seen.add(force.gradient(), leaf.path, static_cast<uint32_t>(leaf.level - group_level));
    }
    force.scatter(materials_[leaf.region], f[leaf.node[0]], f[leaf.node[1]], f[leaf.node[2]], f[leaf.node[3]],
                  clamped);
  }

  /// Rotates the sums back. Rounding leaves a net force of some LSB, which the group's first node takes back.
  template <class Range>
  void add_to_nodes(const Matrix3<FrameEntry>& r, Range range) {
    Vector3<Force> net = zero_vector<Force>();
    uint16_t first = kNone;
    for (const uint32_t k : range) {
      const uint16_t node = front_.node_order[k];
      const Vector3<Force> force = narrow<Force>(r * frame_.force[node]);
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
