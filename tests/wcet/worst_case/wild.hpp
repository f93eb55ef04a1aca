// States in which nothing is left of a sane body: positions, speeds, forces and energies at and beyond the
// limits at which the tick clamps and saturates them, a mesh that is damaged while a tick looks at it, a
// cycle that stands still. They keep what the code relies on (indices), and what they damage they repair.
#pragma once

#include "setup.hpp"

namespace palpate::worst_case {

class Wild {
 public:
  Wild(firmware::Run& run, uint32_t seed)
      : run_(run), core_(run.state.core), scene_(run.state.scene), draw_(seed) {}

  /// After a Setup.
  void shake() {
    shake_nodes();
    shake_groups();
    end_tethers();
    core_.model.remesh.stretch.criterion = static_cast<StretchCriterion>(draw_.below(3));
    run_.state.invariants.next_leaf = static_cast<uint16_t>(draw_.below(core_.forest.leaf_count));
    shake_device();
    shake_safety();
    shake_contact();
  }

  /// The leaves that the next tick's watch looks at; gives what repairs them.
  void damage() {
    core_.model.remesh.stretch.criterion = StretchCriterion::kFixed;
    Leaf& leaf = core_.forest.leaf[0];
    run_.state.invariants.next_leaf = 0;
    whole_ = leaf;
    switch (draw_.below(3)) {
      case 0:
        leaf.kind =
            LeafKind(leaf.path(), leaf.axes().of_second_child(TetType::kType1), leaf.region(), leaf.level());
        break;
      case 1:
        for (uint16_t& neighbour : leaf.neighbour) neighbour = kNone;
        break;
      default:
        for (uint16_t& neighbour : leaf.neighbour) neighbour = leaf.tet;
    }
  }
  void repair() {
    core_.forest.leaf[0] = whole_;
    run_.state.invariants.is_broken = false;
  }

  /// All nodes that are free, for a tick that finds none for its patches.
  void take_nodes() {
    taken_ = 0;
    for (; core_.forest.nodes.used() < Profile::kNodes; ++taken_) took_[taken_] = core_.forest.nodes.take();
  }
  void give_back_nodes() {
    for (uint32_t i = 0; i < taken_; ++i) core_.forest.nodes.release(took_[i]);
  }

 private:
  /// Of any size, and any sign.
  [[nodiscard]] int32_t raw() {
    const auto bits = static_cast<int32_t>(draw_.next() >> (draw_.one_in(2) ? 1 : 1 + draw_.below(31)));
    return draw_.one_in(2) ? -bits : bits;
  }
  template <class Scalar>
  [[nodiscard]] Vector3<Scalar> vector() {
    return Vector3<Scalar>(Scalar::from_raw(raw()), Scalar::from_raw(raw()), Scalar::from_raw(raw()));
  }
  void shake_device() {
    g_inputs.buttons = draw_.below(2);
    g_inputs.reading_number -= draw_.below(2);
    run_.was_late = draw_.one_in(2);
    firmware::leave(run_.changes, {static_cast<uint16_t>(draw_.below(firmware::kSettings + 2)), raw()});
    firmware::Scene& scene = run_.state.scene;
    scene = scene_;
    scene.newton_exponent =
        static_cast<int8_t>(28 - static_cast<int32_t>(draw_.one_in(2) ? draw_.below(45) : draw_.below(2)));
    g_inputs.encoder_counts = {0, 0, 0};
    run_.state.counts_at_reset = {0, 0, 0};
    if (draw_.one_in(2)) return;
    for (int32_t& counts : g_inputs.encoder_counts) counts = draw_.within(1 << (1 + draw_.below(18)));
    for (int32_t& counts : run_.state.counts_at_reset) counts = draw_.one_in(8) ? draw_.within(0x7fff) : 0;
    for (Position& origin : scene.device_origin) origin = within_position_limit(vector<Position>())[0];
    constexpr int32_t kLeast = firmware::kLeastEdgesPerMetre.raw();
    constexpr auto kRoom = static_cast<uint32_t>(firmware::kMostEdgesPerMetre.raw() - kLeast);
    scene.edges_per_metre =
        firmware::EdgesPerMetre::from_raw(kLeast + static_cast<int32_t>(draw_.below(kRoom)));
    scene.device_rotation = draw_.one_in(2) ? firmware::kNotTurned : draw_.one_in(2) ? kTurned : kStretched;
  }
  /// No rotation at all.
  static constexpr firmware::DeviceRotation kStretched = {
      firmware::kWholeEntry, firmware::kWholeEntry, firmware::kWholeEntry,
      firmware::kWholeEntry, firmware::kWholeEntry, firmware::kWholeEntry,
      firmware::kWholeEntry, firmware::kWholeEntry, firmware::kWholeEntry};
  /// By 45 degrees about each of two axes.
  static constexpr RotationEntry kHalf = RotationEntry::ratio(1, 2);
  static constexpr RotationEntry kRoot = RotationEntry::from_raw(759250125);  // of a half
  static constexpr firmware::DeviceRotation kTurned = {
      kRoot, -kRoot, firmware::kZeroEntry, kHalf, kHalf, -kRoot, kHalf, kHalf, kRoot};

  void shake_safety() {
    firmware::CycleState<Profile>& cycle = run_.state;
    for (uint16_t& code : cycle.motor_codes) code = static_cast<uint16_t>(draw_.next());
    safety::Safety& safety = cycle.safety;
    for (safety::WarmMotor& motor : safety.motors.motors) {
      motor.temperatures = {temperature(), temperature()};
      motor.is_warm = draw_.one_in(2);
      motor.current_limit = safety::Ampere::from_raw(raw() & 0x7fff'ffff);
      motor.is_overheated = draw_.one_in(2);
    }
    const auto done = safety::EventSet::of(safety::Event::kCalibrationDone, draw_.one_in(2));
    firmware::leave(run_.requests, done);
    firmware::leave(run_.findings,
                    safety::ConditionSet::of(safety::Condition::kInvariantBroken, draw_.one_in(8)));
    safety.velocity = {vector<phantom::Metre>(), draw_.one_in(2)};
    for (auto& force : safety.force.last) force = vector<phantom::Newton>();
    if (draw_.one_in(2)) safety.parameters.ignored = safety::ConditionSet();
    if (draw_.one_in(2)) safety.state = static_cast<safety::State>(draw_.below(safety::kStateCount));
  }
  [[nodiscard]] safety::HeatSum temperature() {
    if (draw_.one_in(2)) return safety::HeatSum::from_raw(int64_t{raw()} << 20);
    return safety::motor_at(safety::Celsius::from_raw(static_cast<int32_t>(draw_.below(130) << 23))).winding;
  }

  /// Some anywhere, or all within some LSB of the origin.
  void shake_nodes() {
    const uint32_t one_in = 1 + draw_.below(20);
    const bool is_tiny = draw_.one_in(3);
    const uint32_t shift = draw_.below(31);
    for (uint32_t i = 0; i < core_.forest.nodes.used(); ++i) {
      const uint16_t node = core_.forest.nodes.live(i);
      if (!is_tiny && !draw_.one_in(one_in)) continue;
      Vector3<Position> x = within_position_limit(vector<Position>());
      for (int axis = 0; axis < 3 && is_tiny; ++axis)
        x[axis] = Position::from_raw(static_cast<int32_t>(draw_.next()) >> shift >> 1);
      core_.forest.node.position[node] = within_position_limit(x);
      core_.forest.node.velocity[node] = vector<Velocity>();
      core_.solve.force_position[node] = core_.forest.node.position[node];
    }
  }
  void shake_groups() {
    for (uint32_t i = 0; i < core_.front.groups.used(); ++i) {
      const uint16_t group = core_.front.groups.live(i);
      if (draw_.one_in(2)) core_.groups.gradient[group] = unstretched();
      core_.groups.blend[group] = static_cast<uint8_t>(draw_.one_in(4) ? draw_.below(kBlendSteps) : 0);
      core_.groups.misfit_left[group] = Misfit::from_raw(raw() & 0x7fff'ffff);
    }
    // Now all are worth splitting, now all worth joining, or something between.
    RotationRules& rules = core_.model.remesh.rotation;
    rules.split_above = draw_.one_in(2) ? 0x7fff'ffff : draw_.next() >> (1 + draw_.below(31));
    rules.join_below = draw_.one_in(2) ? 0x7fff'ffff : draw_.next();
  }
  /// What is drawn may be merged now.
  void end_tethers() {
    for (uint32_t i = 0; i < core_.tethers.count; ++i) {
      if (draw_.one_in(2)) core_.tethers.tether[i].ticks_left = 1;
    }
    for (uint8_t& urgency : core_.urgencies.of)
      urgency = draw_.one_in(3) ? urgency : Urgencies<Profile>::kCalm;
  }
  [[nodiscard]] uint16_t some_node() {
    const bool is_tethered = core_.tethers.count > 0 && draw_.one_in(2);
    return is_tethered ? core_.tethers.tether[draw_.below(core_.tethers.count)].node
                       : core_.forest.nodes.live(draw_.below(core_.forest.nodes.used()));
  }
  void shake_contact() {
    Reaction& reaction = core_.reaction;
    reaction.had_tool = draw_.one_in(2);
    reaction.tool = within_position_limit(vector<Position>());
    reaction.passivity.energy = Energy::from_raw((int64_t{raw()} << 32) >> draw_.below(60));
    core_.grasp.offset = vector<Position>();
    reaction.free_ticks = draw_.one_in(2) ? kFreeTicks : 0;
    core_.model.contact.radius =
        Position::from_raw(draw_.one_in(4) ? 0 : kLeastRadius.raw() << draw_.below(6));
    core_.model.contact.friction = Fraction::from_raw(raw() & 0x3fff'ffff);
    core_.model.grasp_reach = Position::from_raw(draw_.one_in(2) ? 0 : raw() & 0x1fff'ffff);
    core_.grasp.was_closed = draw_.one_in(2);
    const auto& nodes = core_.forest.nodes;
    core_.grasp.node = draw_.one_in(3) ? some_node() : kNone;
    const bool is_gone = draw_.one_in(2) && nodes.used() < Profile::kNodes;
    if (core_.grasp.holds() && is_gone) core_.grasp.node = nodes.live(nodes.used());
    core_.driven.node = core_.grasp.node;
    core_.driven.target = within_position_limit(vector<Position>());
    Contact& contact = core_.contact;
    contact.is_present = !draw_.one_in(4);
    contact.is_touching = contact.is_present && draw_.one_in(2);
    // With nothing left between it and the tool, or anywhere.
    contact.proxy = draw_.one_in(2) ? zero_vector<Position>() : within_position_limit(vector<Position>());
    contact.stretch = within_position_limit(vector<Position>());
    if (draw_.one_in(2)) return;
    // It has just left the surface: its force still acts, on a node that may go.
    contact.force = Vector3<Force>(Force::ratio(1, 8), Force::ratio(1, 8), Force::ratio(1, 8));
    contact.load.count = 1 + draw_.below(Load::kMost);
    for (uint32_t i = 0; i < contact.load.count; ++i) {
      contact.load.node[i] = some_node();
      contact.load.weight[i] = Fraction::from_raw((1 << 30) / 6);
    }
    contact.anchor = loaded_point(core_.forest, contact.load);
  }

  firmware::Run& run_;
  CoreState& core_;
  firmware::Scene scene_;  // as it was set up: the tool is at the body's origin
  Draw draw_;
  Leaf whole_{};
  inline static std::array<uint16_t, Profile::kNodes> took_{};  // too large for the stack
  uint32_t taken_ = 0;
};

}  // namespace palpate::worst_case
