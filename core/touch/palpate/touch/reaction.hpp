// What of the body's force reaches the tool: never more than force_limit, passive as far as the controller
// can make it, and never another one by more than slew from tick to tick. A grasp's force and a contact's go
// the same way, so neither a grasp that closes nor one that lets go is a step, and the controller's braking
// is none either: what it may not take out in one tick stays in the observer's energy. What it could not take
// out until long after the touch, it gives up: a free tool has nothing that gives.
#pragma once

#include "palpate/touch/contact_rules.hpp"

namespace palpate {

/// So many ticks without a force asked for end a touch; a contact that chatters is one touch.
inline constexpr uint16_t kFreeTicks = 1000;

struct Reaction {
  Vector3<Force> force;    // on the tool, in the last tick
  Vector3<Position> tool;  // in the last tick, if there was one
  bool had_tool;
  uint16_t free_ticks;  // since a force was asked for, up to kFreeTicks
  Passivity passivity;

  static Reaction none() {
    return Reaction{zero_vector<Force>(), zero_vector<Position>(), false, 0, Passivity::at_rest()};
  }
  void count_free(bool is_free) {
    if (!is_free) free_ticks = 0;
    if (is_free && free_ticks < kFreeTicks) ++free_ticks;
    if (free_ticks == kFreeTicks) passivity.forgive();
  }
};

/// Once a tick. `asked`: any force; a component beyond 16 counts as 16. Two roots and some 25 multiplies.
inline Vector3<Force> react(const ContactRules& rules, const Vector3<Force>& asked,
                            const Vector3<Position>& tool, bool has_tool, Reaction& reaction) {
  constexpr Force kMost = Force::ratio(16, 1);
  const Vector3<Force> sane(clamp(asked[0], -kMost, kMost), clamp(asked[1], -kMost, kMost),
                            clamp(asked[2], -kMost, kMost));
  reaction.count_free(sane == zero_vector<Force>());
  const Vector3<Force> wanted = limited_to(sane, rules.force_limit);
  const bool is_moving = has_tool && reaction.had_tool;
  const Vector3<Position> moved =
      is_moving ? Vector3<Position>(tool - reaction.tool) : zero_vector<Position>();
  const Vector3<Force> passive = made_passive(rules.passivity, wanted, moved, reaction.passivity);
  reaction.force += limited_to(Vector3<Force>(passive - reaction.force), rules.slew);
  observe(rules.passivity, reaction.force, moved, reaction.passivity);
  reaction.tool = tool;
  reaction.had_tool = has_tool;
  return reaction.force;
}

}  // namespace palpate
