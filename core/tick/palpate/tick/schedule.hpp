// A cyclic schedule: what changes slowly beside forces takes turns, so that the longest tick has one of it
// and not the sum.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate {

/// What has its turn in a tick.
enum class Slot : uint8_t {
  kMesh,       // patches split and merged
  kFront,      // groups split and joined
  kJudgement,  // what the next turns of both go by: urgencies and misfits; and what is to be split or merged
};

/// A slot that is known at compile time, as an argument.
template <Slot Which>
struct SlotIs {
  static constexpr Slot kValue = Which;
};

inline constexpr uint32_t kScheduleTicks = 4;

/// Every second tick judges.
constexpr Slot slot_of(uint32_t tick) {
  if (tick % 2 != 0) return Slot::kJudgement;
  return tick % kScheduleTicks == 0 ? Slot::kMesh : Slot::kFront;
}

}  // namespace palpate
