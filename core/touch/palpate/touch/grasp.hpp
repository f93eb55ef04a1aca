// Grasping: the node nearest to the tool, within reach, follows the tool until it is released.
#pragma once

#include "palpate/mesh/forest.hpp"
#include "palpate/touch/direction.hpp"

namespace palpate {

struct Grasp {
  uint16_t node;             // kNone while nothing is held; no merge removes it meanwhile
  Vector3<Position> offset;  // node minus tool when the grasp closed
  bool was_closed;           // a grasp closes on the button's edge, not on its level

  static Grasp open() { return Grasp{kNone, zero_vector<Position>(), false}; }
  [[nodiscard]] bool holds() const { return node != kNone; }
};

/// The live node nearest to `tool` and no farther than `reach` (0 .. 4 edges), or kNone. Ties: the first live
/// one.
template <class Profile>
[[nodiscard]] uint16_t nearest_node(const Forest<Profile>& forest, const Vector3<Position>& tool,
                                    Position reach) {
  constexpr int kBits = 2 * Position::kFractionBits;
  Acc<kBits> least = reach * reach + Acc<kBits>::from_raw(1);
  uint16_t nearest = kNone;
  for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {})) {
    const uint16_t node = forest.nodes.live(i);
    const Acc<kBits> square = square_of(Vector3<Position>(forest.node.position[node] - tool));
    const bool closer = square < least;
    least = closer ? square : least;
    nearest = closer ? node : nearest;
  }
  return nearest;
}

/// Opens when `close` falls or when the node is gone. True on its rising edge: the grasp is to close.
template <class Profile>
[[nodiscard]] bool opened_or_closes(const Forest<Profile>& forest, bool close, Grasp& grasp) {
  const bool closes = close && !grasp.was_closed;
  const bool opens = !close || (grasp.holds() && !forest.nodes.is_live(grasp.node));
  grasp.was_closed = close;
  if (opens) grasp.node = kNone;
  return closes;
}

/// On the node that is nearest, if one is in reach. O(nodes).
template <class Profile>
void close_grasp(const Forest<Profile>& forest, const Vector3<Position>& tool, Position reach, Grasp& grasp) {
  const uint16_t node = nearest_node(forest, tool, reach);
  if (node == kNone) return;
  grasp.node = node;
  grasp.offset = forest.node.position[node] - tool;
}

/// Where the grasped node is drawn to in a tool that touches: in each tick an eighth of the way from `before`
/// to `target`. A node that follows every encoder count at once pulls with its whole own stiffness, some 150
/// times the body's: a count of 0.03 mm would be felt as 0.2 N. Rounded to nearest.
inline Vector3<Position> eased(const Vector3<Position>& before, const Vector3<Position>& target) {
  constexpr int kShift = 3;
  const auto along = [&](Eigen::Index axis) {
    const int64_t way = int64_t{target[axis].raw()} - before[axis].raw();
    return Position::from_raw(before[axis].raw() + static_cast<int32_t>(shift_right_rounded(way, kShift)));
  };
  return Vector3<Position>(along(0), along(1), along(2));
}

}  // namespace palpate
