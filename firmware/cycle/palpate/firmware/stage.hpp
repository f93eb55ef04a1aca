// All stages of a cycle, in order: the core's between the device's. They index reports, telemetry and hashes.
#pragma once

#include "palpate/tick/stage.hpp"

namespace palpate::firmware {

enum class Stage : uint8_t {
  kKinematics,
  kTouch,
  kRemesh,
  kRotations,
  kForces,
  kIntegrate,
  kReaction,
  kMotorCodes
};
inline constexpr uint32_t kStageCount = 8;
static_assert(kStageCount == kCoreStages + 2, "palpate: every core stage has its place among all stages");

constexpr Stage stage_of(CoreStage stage) {
  return static_cast<Stage>(static_cast<uint32_t>(stage) + static_cast<uint32_t>(Stage::kTouch));
}
constexpr bool is_core_stage(Stage stage) {
  return stage != Stage::kKinematics && stage != Stage::kMotorCodes;
}
constexpr CoreStage core_stage_of(Stage stage) {
  return static_cast<CoreStage>(static_cast<uint32_t>(stage) - static_cast<uint32_t>(Stage::kTouch));
}

constexpr const char* stage_name(Stage stage) {
  if (stage == Stage::kKinematics) return "kinematics";
  if (stage == Stage::kMotorCodes) return "motor_codes";
  return palpate::stage_name(core_stage_of(stage));
}

/// Shows the core's stages to a probe of all stages.
template <class Probe>
struct CoreProbe {
  Probe& probe;
  void enter(CoreStage stage) { probe.enter(stage_of(stage)); }
  void leave(CoreStage stage) { probe.leave(stage_of(stage)); }
};

/// The probe that sees nothing and costs nothing.
struct NoProbe {
  void enter(Stage) {}
  void leave(Stage) {}
};

}  // namespace palpate::firmware
