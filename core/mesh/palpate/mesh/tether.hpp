// Tethers: what keeps a change of the mesh from being felt. A new node starts at the midpoint of its edge and
// moves with it; its tether lets go over kTetherTicks. Before a node is merged, a tether draws it to the
// midpoint over as many ticks. solve/tether_force.hpp makes the forces; here is the list.
#pragma once

#include "palpate/mesh/forest.hpp"

namespace palpate {

/// Ticks to release a new node, and to draw an old one.
inline constexpr uint8_t kTetherTicks = 32;

enum class TetherKind : uint8_t { kRelease, kDraw };

/// Whole words to the last byte, so that a copy needs no call.
struct alignas(uint32_t) Tether {
  uint16_t node;
  std::array<uint16_t, 2> end;  // of the edge whose midpoint the node is or was
  uint16_t tet;                 // one that the edge's bisection split
  uint8_t ticks_left;
  TetherKind kind;
  uint16_t padding;
};

template <class Profile>
struct Tethers {
  static constexpr uint16_t kTethers = Profile::kTethers;

  uint16_t count;
  uint16_t peak;
  std::array<Tether, kTethers> tether;
  std::array<uint8_t, Profile::kNodes> holds_node;  // so that the question costs a load

  void clear() {
    count = peak = 0;
    for (const uint32_t i : bounded<Profile::kNodes>(Profile::kNodes, [] {})) holds_node[i] = 0;
  }
  [[nodiscard]] bool is_full() const { return count == kTethers; }
  /// Whether `node` has a tether; as an end of another one's it has none.
  [[nodiscard]] bool holds(uint16_t node) const { return holds_node[node] != 0; }
  /// The list must not be full.
  void add(const Tether& added) {
    check(!is_full(), "one tether too many");
    check(!holds(added.node), "a second tether at one node");
    tether[count] = added;
    ++count;
    peak = count > peak ? count : peak;
    holds_node[added.node] = 1;
  }
  /// The last one moves into the gap.
  void remove(uint32_t at) {
    holds_node[tether[at].node] = 0;
    --count;
    tether[at] = tether[count];
  }

  /// A tick of all in which none ends, and one in its last tick waits there, but that of a node which the
  /// tool has taken.
  void advance(uint16_t taken) {
    uint32_t of_taken = count;
    for (const uint32_t i : bounded<kTethers>(count, [] {})) {
      const uint32_t left = tether[i].ticks_left;
      tether[i].ticks_left = static_cast<uint8_t>(left - (left > 1 ? 1u : 0u));
      of_taken = tether[i].node == taken ? i : of_taken;
    }
    if (of_taken < count) remove(of_taken);
  }
};

}  // namespace palpate
