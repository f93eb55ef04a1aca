// A scene's state: everything full, and what a tick looks at as it costs most.
#pragma once

#include "mesh_wishes.hpp"
#include "run.hpp"

namespace palpate::worst_case {

class Setup {
 public:
  Setup(firmware::Run& run, const Scene& scene)
      : run_(run),
        state_(run.state.core),
        forest_(run.state.core.forest),
        scene_(scene),
        draw_(~scene.seed) {}

  [[nodiscard]] Status build() {
    const Status status = firmware::start(run_.state, model_of(scene_, draw_));
    if (status != Status::kDone) return status;
    if (scene_.grows) MeshGrowth(state_, scene_, draw_).run();
    split_groups(state_, scene_, draw_);
    start_groups(state_.front, state_.groups);
    hold_nodes();
    if (scene_.is_heaped) heap_nodes();
    follow_nodes();
    MeshWishes(state_, scene_, draw_).make();
    turn_groups();
    join_groups();
    want_groups();
    renew_where_most();
    place_tool();
    return status;
  }

 private:
  [[nodiscard]] uint16_t node_at(uint32_t i) const { return forest_.nodes.live(i); }

  /// All but those of a plane of the lattice: one where patches can be merged, with enough nodes for the
  /// tethers and no more than there must be.
  void hold_nodes() {
    if (scene_.is_held) {
      int32_t best = -0x7fff;
      for (uint32_t axis = 0; axis < 3; ++axis) {
        for (int32_t plane = -kEnd; plane <= kEnd; ++plane) {
          const int32_t worth = worth_of_plane(axis, plane);
          if (worth <= best) continue;
          best = worth;
          free_plane(axis, plane);
        }
      }
    }
    start_solve(forest_, state_.model.dynamics, state_.model.held, state_.solve);
  }
  /// In held nodes: a merge is worth more than one, a tether is worth some.
  [[nodiscard]] int32_t worth_of_plane(uint32_t axis, int32_t plane) const {
    const auto free = static_cast<int32_t>(nodes_in_plane(axis, plane));
    if (free == 0) return -0x7fff;
    int32_t tethers = 0;
    int32_t largest = 0;
    for (uint32_t i = 0; i < forest_.leaf_count; ++i) {
      const Leaf& leaf = forest_.leaf[i];
      if (leaf.level() == 0 || along(forest_.node.rest[middle_node(leaf)], axis) != plane) continue;
      Patch patch{};
      if (find_merge(forest_, leaf.tet, patch) != MeshStatus::kDone) continue;
      // Each leaf of the patch says so.
      tethers += 256 / static_cast<int32_t>(2 * patch.count);
      largest = static_cast<int32_t>(patch.count) > largest ? static_cast<int32_t>(patch.count) : largest;
    }
    tethers /= 256;
    if (tethers > Profile::kTethers) tethers = Profile::kTethers;
    return 8 * largest + 6 * tethers - free;
  }
  static constexpr int32_t kEnd = kMaxCubesPerAxis * kLatticeStepsPerEdge / 2;  // of the lattice
  static int32_t along(LatticePoint p, uint32_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }
  [[nodiscard]] uint32_t nodes_in_plane(uint32_t axis, int32_t plane) const {
    uint32_t count = 0;
    for (uint32_t i = 0; i < forest_.nodes.used(); ++i) {
      count += along(forest_.node.rest[node_at(i)], axis) == plane ? 1u : 0u;
    }
    return count;
  }
  void free_plane(uint32_t axis, int32_t plane) {
    constexpr auto kHigh = static_cast<int16_t>(kEnd);
    constexpr auto kLow = static_cast<int16_t>(-kEnd);
    LatticePoint below{kHigh, kHigh, kHigh};
    LatticePoint above{kLow, kLow, kLow};
    (axis == 0 ? below.x : axis == 1 ? below.y : below.z) = static_cast<int16_t>(plane - 1);
    (axis == 0 ? above.x : axis == 1 ? above.y : above.z) = static_cast<int16_t>(plane + 1);
    state_.model.held = {LatticeBox{{kLow, kLow, kLow}, below}, LatticeBox{above, {kHigh, kHigh, kHigh}}};
  }

  /// On an upright plane: beside the origin, so that the boxes of leaves that reach across hold it and no
  /// leaf does, or within the radius of a tool that presses.
  void heap_nodes() {
    for (uint32_t i = 0; i < forest_.nodes.used(); ++i) {
      const uint16_t node = node_at(i);
      const Position s = Position::from_raw(static_cast<int32_t>(draw_.below(1u << 28)));
      forest_.node.position[node] = Vector3<Position>(plane_at() + s, -s, height());
      for (int axis = 0; axis < 3; ++axis) {
        forest_.node.velocity[node][axis] = Velocity::from_raw(draw_.within(1 << 30));
      }
    }
    bring_leaves_across();
  }
  [[nodiscard]] bool presses() const { return scene_.tool == Tool::kPresses; }
  [[nodiscard]] Position plane_at() const {
    return presses() ? Position::ratio(1, 256) : Position::ratio(1, 2);
  }
  [[nodiscard]] Position reach() const {
    const Position radius = state_.model.contact.radius;
    return presses() ? radius + radius : radius;
  }
  /// Above a tool that presses, faces are as near as their lowest node: halvings of the range, so that it can
  /// be tightened often before few are left.
  [[nodiscard]] Position height() {
    constexpr uint32_t kHalvings = 24;
    if (!presses()) return Position::from_raw(draw_.within(1 << 26));
    const int32_t most = reach().raw() >> draw_.below(kHalvings);
    return Position::from_raw(most / 2 +
                              static_cast<int32_t>(draw_.below(static_cast<uint32_t>(most / 2) + 1)));
  }

  /// Leaves whose box holds the origin, and faces of the surface that a search there looks at.
  struct Near {
    uint32_t boxes = 0;
    uint32_t faces = 0;
  };
  [[nodiscard]] Near near_origin() {
    Near near;
    Sides<Profile>& sides = state_.candidates.sides;
    sides.find(forest_, zero_vector<Position>(), reach());
    for (uint32_t i = 0; i < forest_.leaf_count; ++i) {
      for (uint32_t faces = sides.faces_in_reach(forest_.leaf[i]); faces != 0; faces &= faces - 1)
        ++near.faces;
    }
    if (presses()) return near;
    sides.find(forest_, zero_vector<Position>(), Position::from_raw(0));
    for (uint32_t i = 0; i < forest_.leaf_count; ++i)
      near.boxes += sides.is_beyond(forest_.leaf[i]) ? 0u : 1u;
    return near;
  }

  /// Nodes go to the origin's other side, until as many leaves and faces are near it as a tick examines.
  void bring_leaves_across() {
    constexpr uint32_t kTries = 200;
    constexpr uint32_t kLooks = Candidates<Profile>::kLooks;
    constexpr uint32_t kMost = Candidates<Profile>::kMost;
    for (uint32_t tries = 0; tries < kTries; ++tries) {
      Vector3<Position>& x = forest_.node.position[node_at(draw_.below(forest_.nodes.used()))];
      const Vector3<Position> before = x;
      const Position s = Position::from_raw(1 << 27);
      x = Vector3<Position>(plane_at() - s - s, s + s, height());
      const Near near = near_origin();
      const bool fits = presses() ? near.faces <= kLooks
                                  : (scene_.is_crowded || near.boxes <= kMostBoxes) && near.faces <= kMost;
      if (!fits) x = before;
      if (presses() ? near.faces == kLooks : near.boxes == kMostBoxes && !scene_.is_crowded) break;
    }
  }

  void follow_nodes() {
    for (uint32_t i = 0; i < forest_.nodes.used(); ++i) {
      const uint16_t node = node_at(i);
      for (int axis = 0; axis < 3; ++axis) {
        state_.solve.force_position[node][axis] = integrate_detail::force_position(
            forest_.node.position[node][axis], forest_.node.velocity[node][axis],
            state_.model.dynamics.stiffness_damping);
      }
    }
  }

  /// Each worth splitting, as far as it can be, and on its way to its rotation or not yet.
  void turn_groups() {
    auto& groups = state_.groups;
    auto& front = state_.front;
    for (uint32_t i = 0; i < front.groups.used(); ++i) {
      const uint16_t group = front.groups.live(i);
      const auto entry = [this] { return RotationEntry::from_raw(draw_.within(1 << 29)); };
      groups.extracted[group] = Quaternion{RotationEntry::ratio(3, 4), entry(), entry(), entry()};
      normalise(groups.extracted[group]);
      groups.used[group] = Quaternion::identity();
      groups.blend[group] = static_cast<uint8_t>(scene_.blends ? 1 + draw_.below(kBlendSteps - 1) : 0);
      groups.misfit[group] = Misfit::from_raw(static_cast<int32_t>(draw_.next() >> (1 + draw_.below(8))));
      groups.misfit_left[group] = Misfit::from_raw(0);
    }
  }

  /// As many pairs as a tick can split again. Of a pair one rotation is extracted instead of two, so there
  /// are none where no tick looks at them.
  void join_groups() {
    if (scene_.slot != Slot::kFront) return;
    auto& front = state_.front;
    uint32_t pairs = 0;
    for (uint32_t i = 0; i < front.groups.used() && pairs < Profile::kRotationChanges; ++i) {
      const uint16_t group = front.groups.live(i);
      const uint16_t tet = front.tet[group];
      if ((tet & 1u) != 0 || forest_.parent_of(tet) == kNone) continue;
      const uint16_t other = forest_.leaf_of(first_leaf(forest_, TheForest::sibling(tet))).group;
      if (front.tet[other] != TheForest::sibling(tet)) continue;
      front.partner[group] = other;
      front.partner[other] = group;
      state_.groups.misfit[group] = state_.groups.misfit[other] = Misfit::from_raw(0);
      state_.groups.blend[group] = state_.groups.blend[other] = 0;
      ++pairs;
    }
  }

  /// Those with most leaves are the worst: as many as a tick may split.
  void want_groups() {
    auto& front = state_.front;
    for (uint32_t wanted = 0; wanted < Profile::kRotationChanges; ++wanted) {
      uint16_t largest = kNone;
      for (uint32_t i = 0; i < front.groups.used(); ++i) {
        const uint16_t group = front.groups.live(i);
        const bool is_free = front.partner[group] == kNone && state_.groups.misfit[group] != Misfit::max();
        if (!is_free || forest_.tet[front.tet[group]].is_leaf()) continue;
        if (largest == kNone || front.leaves[group].count > front.leaves[largest].count) largest = group;
      }
      if (largest == kNone) return;
      state_.groups.misfit[largest] = Misfit::max();
      state_.groups.blend[largest] = 0;
    }
  }

  /// The misfits go on where a tick has most to renew: leaves below their group's tet, and groups that end.
  void renew_where_most() {
    constexpr uint32_t kSlice = (Profile::kLeaves + kMisfitSlices - 1) / kMisfitSlices;
    constexpr uint32_t kMostGroups = Profile::kGroups / kMisfitSlices + 1;
    const auto& front = state_.front;
    uint32_t most = 0;
    for (uint32_t start = 0; start < front.groups.used(); ++start) {
      uint32_t looked = 0;
      uint32_t worth = 0;
      for (uint32_t i = 0; i < kMostGroups && looked < kSlice; ++i, ++worth) {
        const uint16_t group = front.groups.live((start + i) % front.groups.used());
        const uint32_t rest = kSlice - looked;
        const uint32_t count = front.leaves[group].count < rest ? front.leaves[group].count : rest;
        looked += count;
        if (!forest_.tet[front.tet[group]].is_leaf()) worth += count;
      }
      if (worth <= most) continue;
      most = worth;
      state_.misfits.begin(static_cast<uint16_t>(start));
    }
  }

  /// The scene is put so that the tool is at the body's origin while the encoders stand at zero.
  void place_tool() {
    firmware::CycleState<Profile>& cycle = run_.state;
    const auto angles = phantom::joint_angles(phantom::premium::kPremium15, phantom::Counts{0, 0, 0});
    const auto at = phantom::premium::tool_position(phantom::premium::posture(angles));
    cycle.scene.device_origin = {Position::from_raw(0), Position::from_raw(0), Position::from_raw(0)};
    const Vector3<Position> tool = firmware::in_body_frame(cycle.scene, at);
    for (std::size_t axis = 0; axis < 3; ++axis)
      cycle.scene.device_origin[axis] = -tool[static_cast<Eigen::Index>(axis)];
    place_contact();
  }

  /// A tool that presses has touched nodes, one of which a merge may take away in this tick.
  void place_contact() {
    Contact& contact = state_.contact;
    contact.clear();
    if (scene_.tool != Tool::kPresses) return;
    contact.begin(zero_vector<Position>());
    contact.is_touching = true;
    contact.load.count = 3 + draw_.below(Load::kMost - 2);
    for (uint32_t i = 0; i < contact.load.count; ++i) {
      contact.load.node[i] = node_at(draw_.below(forest_.nodes.used()));
      contact.load.weight[i] = Fraction::from_raw((1 << 30) / 6);
    }
    // Of the tethers that end, the first kPatches are refused.
    if (state_.tethers.count > Profile::kPatches)
      contact.load.node[0] = state_.tethers.tether[Profile::kPatches].node;
    contact.anchor = loaded_point(forest_, contact.load);
    const auto entry = [this] { return Position::from_raw(draw_.within(1 << 26)); };
    contact.stretch = Vector3<Position>(entry(), entry(), entry());
    contact.normal = direction_of(contact.stretch);
  }

  firmware::Run& run_;
  CoreState& state_;
  TheForest& forest_;
  const Scene& scene_;
  Draw draw_;
};

}  // namespace palpate::worst_case
