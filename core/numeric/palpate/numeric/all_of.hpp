// Conditions without branches, for loops in which a branch is dearer than all that it saves: on the target
// each may be mispredicted, and its bound says that it is.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate {

/// Whether all of them hold; unlike with && each is evaluated.
template <class... Bool>
constexpr bool all_of(Bool... conditions) {
  return (static_cast<uint32_t>(conditions) & ...) != 0;
}

/// Whether any of them holds; unlike with || each is evaluated.
template <class... Bool>
constexpr bool any_of(Bool... conditions) {
  return (static_cast<uint32_t>(conditions) | ...) != 0;
}

}  // namespace palpate
