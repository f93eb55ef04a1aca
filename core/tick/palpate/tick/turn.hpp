// What changes slowly beside forces takes turns, so that the longest tick has one of it and not the sum.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate {

enum class Turn : uint8_t {
  kMesh,       // splits and merges
  kFront,      // groups split and joined; how urgent the next changes of the mesh are
  kRotations,  // of all groups; what the next changes of the front go by
};

inline constexpr uint32_t kTurnTicks = 4;

/// Rotations have every second tick.
constexpr Turn turn_of(uint32_t tick) {
  if (tick % 2 != 0) return Turn::kRotations;
  return tick % kTurnTicks == 0 ? Turn::kMesh : Turn::kFront;
}

}  // namespace palpate
