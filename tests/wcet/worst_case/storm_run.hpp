// What a body in its rest shape, a hand and a device make of a tick: for the code that no full state needs. A
// storm is some hundred ticks of the golden storm's hand, with every setting changed to anything, requests in
// any order and failing hardware.
#pragma once

#include "background.hpp"
#include "body.hpp"
#include "determinism/storm.hpp"
#include "inputs.hpp"
#include "palpate/ports/buttons.hpp"
#include "palpate/ports/device_status.hpp"

namespace palpate::worst_case {

class StormRun {
 public:
  StormRun(firmware::Run& run, uint32_t seed)
      : run_(run), draw_(seed), hand_(draw_.next() | 1u), seed_(seed) {}

  [[nodiscard]] Status start() {
    const Status status = firmware::start(run_.state, model());
    // Every other one with a hand on the device: everything is watched.
    is_guarded_ = seed_ % 2 == 1 && status == Status::kDone;
    if (is_guarded_ && !guard_device(run_.state, safety::kPremium15Parameters))
      return Status::kTooManySubsteps;
    return status;
  }

  /// Before every tick.
  void prepare() {
    hand_row_ = draw_.one_in(20) ? hand_row_ : hand_.next();
    for (std::size_t i = 0; i < 3; ++i) g_inputs.encoder_counts[i] = hand_row_.encoder_counts[i];
    g_inputs.buttons = (hand_row_.buttons & firmware::ScriptRow::kGraspButton) != 0 ? port::kGraspButton : 0;
    if (!draw_.one_in(10)) ++g_inputs.reading_number;
    if (is_guarded_) trouble();
    if (draw_.one_in(4)) firmware::leave(run_.changes, change());
    while (run_.telemetry.oldest() != nullptr && !draw_.one_in(8)) run_.telemetry.release();
  }

 private:
  /// Of three cubes, with leaves left to refine them; at most 4.
  [[nodiscard]] static constexpr uint32_t deepest_level() {
    uint32_t level = 1;
    while (level < 4 && (3 * kRootsPerCube << (level + 1)) < Profile::kLeaves) ++level;
    return level;
  }
  [[nodiscard]] firmware::CycleModel model() {
    firmware::CycleModel model = kModel;
    Model& body = model.body;
    body.level = static_cast<uint8_t>(1 + draw_.below(deepest_level()));
    body.remesh.stretch.criterion = static_cast<StretchCriterion>(1 + seed_ % 2);
    body.remesh.stretch.levels[kBarred].most = body.level;
    body.block.region[1] = kBarred;
    body.contact = kContactRules;
    if (draw_.one_in(2)) body.contact.radius = Position::ratio(1, 8);
    body.dynamics.substeps = static_cast<uint8_t>(1 + draw_.below(Profile::kSubsteps));
    return model;
  }

  /// Any value of a setting that may not be there; of the fronts' mostly near what it was, or nothing would
  /// be refined ever after.
  [[nodiscard]] firmware::SettingChange change() {
    const auto setting = static_cast<uint16_t>(draw_.below(firmware::kSettings + 2));
    const auto anything = static_cast<int32_t>(draw_.next() >> draw_.below(32));
    if (setting <= firmware::safety_fields::kThresholds || draw_.one_in(30))
      return {setting, draw_.one_in(8) ? -anything : anything};
    const RemeshRules& rules = kModel.body.remesh;
    const std::array<uint32_t, firmware::kFrontThresholds> usual = {
        rules.rotation.split_above, rules.rotation.join_below,
        static_cast<uint32_t>(rules.stretch.split_above.raw()),
        static_cast<uint32_t>(rules.stretch.merge_below.raw())};
    const uint32_t which = (setting - firmware::safety_fields::kThresholds - 1u) % firmware::kFrontThresholds;
    return {setting, static_cast<int32_t>(usual[which] / 8 * (2 + draw_.below(12)))};
  }

  void trouble() {
    const auto request = [this](safety::Event event, uint32_t one_in) {
      return safety::EventSet::of(event, draw_.one_in(one_in));
    };
    using safety::Event;
    firmware::leave(run_.requests, request(Event::kAcknowledge, 3) | request(Event::kCalibrationStarted, 3) |
                                       request(Event::kCalibrationDone, 4) | request(Event::kEnable, 3) |
                                       request(Event::kDisable, 40) |
                                       request(Event::kCalibrationAborted, 40));
    g_inputs.device_status = draw_.one_in(60) ? draw_.below(8) : 0;
    if (draw_.one_in(60)) g_inputs.encoder_counts[draw_.below(3)] = draw_.within(1 << 20);
    if (!draw_.one_in(30)) return;
    safety::WarmMotor& motor = run_.state.safety.motors.motors[draw_.below(3)];
    motor.temperatures =
        safety::motor_at(safety::Celsius::from_raw(static_cast<int32_t>(draw_.below(130) << 23)));
  }

  firmware::Run& run_;
  Draw draw_;
  golden::StormHand hand_;
  firmware::ScriptRow hand_row_{};
  uint32_t seed_;
  bool is_guarded_ = false;
};

}  // namespace palpate::worst_case
