// What came of a turn of either front.
#pragma once

#include "palpate/remesh/rules.hpp"

namespace palpate {

/// What has it as its base has a constructor too: an aggregate with zeros in it would be cleared by memset.
struct TurnOutcome {
  uint32_t flags = 0;    // RemeshFlag bits
  bool changed = false;  // the lists of the rotation front need index_groups

  void flag(RemeshFlag which) { flags |= static_cast<uint32_t>(which); }
  /// Returns false, for what is not done.
  bool refuse(RemeshFlag which) {
    flag(which);
    return false;
  }
};

}  // namespace palpate
