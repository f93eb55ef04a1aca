// Corotated forces of all leaves, group by group in the group's own frame: its nodes are rotated once, a leaf
// then needs differences and 7 multiplies, and the sums are rotated back once a node and group.
#pragma once

#include "palpate/elastic/group_frame.hpp"
#include "palpate/elastic/groups.hpp"

namespace palpate {

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
    auto others = bounded_total<kOtherNodes>([] {});
    auto leaves = bounded_total<Profile::kLeaves>([] {});
    auto others_back = bounded_total<kOtherNodes>([] {});
    clamped_ = ClampFlag();
    uint32_t clamped_groups = 0;
    for (const uint32_t i : bounded<Profile::kGroups>(front_.groups.used(), [] {})) {
      const uint16_t group = front_.groups.live(i);
      const Span span = front_.nodes[group];
      check(0 < span.count && span.count <= frame_.node.size(),
            "a group has no node, or more than a root can have");
      const uint16_t* const node = front_.node_order.data() + span.begin;
      enter_frame<decltype(others)>(at, groups_.used[group], node, others.grant(span.count - 1u));
      const Span own = front_.leaves[group];
      if constexpr (Mode == Observe::kYes) {
        observe_leaves(group, leaves.take(front_.leaf_order.data() + own.begin, own.count));
      } else {
        add_leaves(leaves.take(front_.leaf_order.data() + own.begin, own.count));
      }
      clamped_groups += clamped_.take() ? 1u : 0u;
      leave_frame<decltype(others_back)>(node, others_back.grant(span.count - 1u));
    }
    return clamped_groups;
  }

 private:
  using Node = typename GroupFrame<Profile>::Node;
  /// Of a group all but the first one, which is the origin of the frame.
  static constexpr uint32_t kOtherNodes = RotationFront<Profile>::kGroupNodes - Profile::kGroups;

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

  /// Where the loop over leaves looks things up. The compiler would add up such addresses for every look.
  struct Tables {
    PALPATE_ALWAYS_INLINE explicit Tables(GroupForces& of)
        : leaf(opaque(of.forest_.leaf.data())),
          mark(opaque(of.front_.mark.data())),
          node(opaque(of.frame_.node.data())),
          material(opaque(of.materials_.data())) {}
    /// A mark is the distance of a node's place from the first one, in bytes: an address is one addition.
    [[nodiscard]] PALPATE_ALWAYS_INLINE Node& in_frame(uint16_t which) const {
      void* const first = node;
      void* const place = static_cast<std::byte*>(first) + mark[which];
      return *static_cast<Node*>(place);
    }
    const Leaf* leaf;
    const uint32_t* mark;
    Node* node;
    const Material* material;
  };

  /// Of all nodes, live or not: what is written in a row needs no list.
  void clear_forces() {
#pragma GCC unroll 8
    for (const uint32_t i : bounded<Profile::kNodes>(Profile::kNodes, [] {})) {
      forest_.node.force[i] = zero_vector<Force>();
    }
  }

  /// The frame of a group that is turned by q, positions of the group's nodes in it, and their marks. A
  /// function of its own, as leave_frame: the loop over leaves needs all registers. `count`: without the
  /// first.
  template <class Total>
  PALPATE_NOINLINE void enter_frame(const std::array<Vector3<Position>, Profile::kNodes>& at,
                                    const Quaternion& q, const uint16_t* first, uint32_t count) {
    group_frame_detail::set_frame(q, frame_.rotation);
    (void)clamped_.take();
    const typename Total::template Range<const uint16_t*> others(first + 1, count);
    const Vector3<Position>& origin = at[*first];
    const group_frame_detail::Place twice{opaque(2 * origin[0].raw()), opaque(2 * origin[1].raw()),
                                          opaque(2 * origin[2].raw())};
    const Matrix3<FrameEntry>& rotation = *opaque(&frame_.rotation);
    Node* place = frame_.node.data();
    *place = {zero_vector<Position>(), zero_vector<FrameForce>()};
    front_.mark[*first] = 0;
    uint32_t mark = 0;
    for (const uint16_t* node : others) {
      ++place;
      mark += sizeof(Node);
      *place = {group_frame_detail::into_frame(rotation, at[*node], twice, clamped_),
                zero_vector<FrameForce>()};
      front_.mark[*node] = mark;
    }
  }

  /// Forces of a group's leaves, which `range` goes through, into frame_.
  template <class Range>
  PALPATE_ALWAYS_INLINE void add_leaves(Range range) {
    const Tables in(*this);
    for (const uint16_t* place : range) {
      add_leaf(in, in.leaf[*place], SeesNothing{}, clamped_);
    }
  }
  /// And their mean gradient.
  template <class Range>
  PALPATE_ALWAYS_INLINE void observe_leaves(uint16_t group, Range range) {
    const uint8_t group_level = forest_.level_of(front_.tet[group]);
    const Vector3<Strain> none = zero_vector<Strain>();
    frame_.gradient.template topRows<3>() << none, none, none;
    const Tables in(*this);
    for (const uint16_t* place : range) {
      const Leaf& leaf = in.leaf[*place];
      const auto depth = static_cast<uint32_t>(leaf.level() - group_level);
      add_leaf(in, leaf, AddsGradient{depth, frame_.gradient}, clamped_);
    }
    set_gradient(group);
  }
  /// R A. The mean is made of variables before the first entry is stored.
  PALPATE_NOINLINE void set_gradient(uint16_t group) {
    const Matrix3<FrameEntry>& from = frame_.rotation;
    const FrameEntry xx = from(0, 0), xy = from(0, 1), xz = from(0, 2);
    const FrameEntry yx = from(1, 0), yy = from(1, 1), yz = from(1, 2);
    const FrameEntry zx = from(2, 0), zy = from(2, 1), zz = from(2, 2);
    const MeanGradient& mean = frame_.gradient;
    const Strain a0 = mean(0, 0), b0 = mean(0, 1), c0 = mean(0, 2);
    const Strain a1 = mean(1, 0), b1 = mean(1, 1), c1 = mean(1, 2);
    const Strain a2 = mean(2, 0), b2 = mean(2, 1), c2 = mean(2, 2);
    end_of_loads();
    const auto along = [](FrameEntry x, Strain a, FrameEntry y, Strain b, FrameEntry z, Strain c) {
      return narrow<Stretch>(x * a + y * b + z * c);
    };
    DeformationGradient& to = groups_.gradient[group];
    to.col(0) << along(xx, a0, xy, b0, xz, c0), along(yx, a0, yy, b0, yz, c0), along(zx, a0, zy, b0, zz, c0);
    to.col(1) << along(xx, a1, xy, b1, xz, c1), along(yx, a1, yy, b1, yz, c1), along(zx, a1, zy, b1, zz, c1);
    to.col(2) << along(xx, a2, xy, b2, xz, c2), along(yx, a2, yy, b2, yz, c2), along(zx, a2, zy, b2, zz, c2);
  }

  /// `see` is shown the leaf's LeafForce between its edge vectors and its forces. The level is held to the
  /// profile's, so that the table of levels needs no check of its own.
  template <class See>
  PALPATE_ALWAYS_INLINE void add_leaf(const Tables& in, const Leaf& leaf, See see, ClampFlag& clamped) {
    const uint32_t level = leaf.level();
    // Of a value that it knows nothing about the compiler believes that no other case occurs.
    switch (opaque(level < Profile::kMaxLevel ? level : Profile::kMaxLevel)) {
      case 0:
        return add_leaf_of<0>(in, leaf, see, clamped);
      case 1:
        return add_leaf_of<1>(in, leaf, see, clamped);
      case 2:
        return add_leaf_of<2>(in, leaf, see, clamped);
      case 3:
        return add_leaf_of<3>(in, leaf, see, clamped);
      case 4:
        return add_leaf_of<4>(in, leaf, see, clamped);
      case 5:
        return add_leaf_of<5>(in, leaf, see, clamped);
      case 6:
        return add_leaf_of<6>(in, leaf, see, clamped);
      case 7:
        return add_leaf_of<7>(in, leaf, see, clamped);
      case 8:
        return add_leaf_of<8>(in, leaf, see, clamped);
      case 9:
        return add_leaf_of<9>(in, leaf, see, clamped);
      case 10:
        return add_leaf_of<10>(in, leaf, see, clamped);
      case 11:
        return add_leaf_of<11>(in, leaf, see, clamped);
      case 12:
        return add_leaf_of<12>(in, leaf, see, clamped);
      case 13:
        return add_leaf_of<13>(in, leaf, see, clamped);
      case 14:
        return add_leaf_of<14>(in, leaf, see, clamped);
      default:
        __builtin_unreachable();  // no level is above kMaxLevel
    }
  }

  /// Levels that the profile does not have take no code.
  template <uint8_t Level, class See>
  PALPATE_ALWAYS_INLINE void add_leaf_of([[maybe_unused]] const Tables& in, [[maybe_unused]] const Leaf& leaf,
                                         [[maybe_unused]] See see, [[maybe_unused]] ClampFlag& clamped) {
    static_assert(Level <= kDeepestLevel);
    if constexpr (Level <= Profile::kMaxLevel) {
      auto& n0 = in.in_frame(leaf.node[0]);
      auto& n1 = in.in_frame(leaf.node[1]);
      auto& n2 = in.in_frame(leaf.node[2]);
      auto& n3 = in.in_frame(leaf.node[3]);
      LeafForce<Level> force(leaf.axes());
      force.gather(n0.position, n1.position, n2.position, n3.position, clamped);
      force.set_stresses(in.material[leaf.region()], clamped);
      see(force);
      force.scatter(n0.force, n1.force, n2.force, n3.force, clamped);
    }
  }

  /// Rotates the sums back. They sum to zero, so the first node's is what the others leave, and so are the
  /// roundings.
  template <class Total>
  PALPATE_NOINLINE void leave_frame(const uint16_t* first, uint32_t count) {
    const typename Total::template Range<const uint16_t*> others(first + 1, count);
    Vector3<Force>* const sums = opaque(forest_.node.force.data());
    const Matrix3<FrameEntry>& rotation = *opaque(&frame_.rotation);
    const Node* place = frame_.node.data();
    Force x = Force::from_raw(0), y = x, z = x;
    for (const uint16_t* node : others) {
      ++place;
      Vector3<Force>& sum = sums[*node];
      const Vector3<Force> force = group_frame_detail::out_of_frame(rotation, place->force);
      const Force sum_x = sum[0] + force[0];
      const Force sum_y = sum[1] + force[1];
      const Force sum_z = sum[2] + force[2];
      x += force[0];
      y += force[1];
      z += force[2];
      end_of_loads();
      sum[0] = sum_x;
      sum[1] = sum_y;
      sum[2] = sum_z;
    }
    Vector3<Force>& sum = sums[*first];
    const Force sum_x = sum[0] - x, sum_y = sum[1] - y, sum_z = sum[2] - z;
    end_of_loads();
    sum[0] = sum_x;
    sum[1] = sum_y;
    sum[2] = sum_z;
  }

  Forest<Profile>& forest_;
  RotationFront<Profile>& front_;
  Groups<Profile>& groups_;
  const Materials& materials_;
  GroupFrame<Profile>& frame_;
  ClampFlag clamped_;  // of one evaluation; here, so that the loop over leaves takes no address of a local
};

}  // namespace palpate
