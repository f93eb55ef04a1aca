// The stages of a tick, in order; they index reports, telemetry, hashes and docs/dataflow.md. forces and
// integrate run once a substep.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate {

enum class CoreStage : uint8_t { kTouch, kRemesh, kRotations, kForces, kIntegrate, kReaction };
inline constexpr uint32_t kCoreStages = 6;

constexpr const char* stage_name(CoreStage stage) {
  switch (stage) {
    case CoreStage::kTouch:
      return "touch";
    case CoreStage::kRemesh:
      return "remesh";
    case CoreStage::kRotations:
      return "rotations";
    case CoreStage::kForces:
      return "forces";
    case CoreStage::kIntegrate:
      return "integrate";
    default:
      return "reaction";
  }
}

/// The probe that sees nothing and costs nothing.
struct NoProbe {
  void enter(CoreStage) {}
  void leave(CoreStage) {}
};

}  // namespace palpate
