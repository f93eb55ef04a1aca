// When a body has come to rest.
#pragma once

#include <cmath>
#include <memory>

#include "palpate/solve/integrate.hpp"
#include "units.hpp"

namespace palpate::sim {

struct RestLimits {
  double displacement;  // cube edges
  double force;         // E_ref edge^2
};

/// At rest: over 500 ticks no node moved by more than the first limit from where it was, and no free node's
/// force was above the second.
template <class Profile>
class RestDetector {
 public:
  static constexpr int kTicks = 500;

  explicit RestDetector(const RestLimits& limits)
      : displacement_raw_(to_fixed<Position>(limits.displacement).raw()),
        force_raw_(to_fixed<Force>(limits.force).raw()),
        from_(std::make_unique<std::array<Vector3<Position>, Profile::kNodes>>()) {}

  /// After every tick. `driven`: a node that something else moves, or kNone.
  void look(const Forest<Profile>& forest, const SolveState<Profile>& solve, uint16_t driven) {
    bool is_still = still_ticks_ > 0;
    for (uint32_t i = 0; i < forest.nodes.used() && is_still; ++i) {
      const uint16_t node = forest.nodes.live(i);
      const bool is_free = solve.control[node] == NodeControl::kFree && node != driven;
      is_still =
          is_below(Vector3<Position>(forest.node.position[node] - (*from_)[node]), displacement_raw_) &&
          (!is_free || is_below(forest.node.force[node], force_raw_));
    }
    if (!is_still) *from_ = forest.node.position;
    still_ticks_ = is_still ? still_ticks_ + 1 : 1;
  }
  [[nodiscard]] bool is_at_rest() const { return still_ticks_ > kTicks; }

 private:
  template <class Scalar>
  static bool is_below(const Vector3<Scalar>& v, double limit_raw) {
    return std::hypot(v[0].raw(), v[1].raw(), v[2].raw()) < limit_raw;
  }

  double displacement_raw_;
  double force_raw_;
  std::unique_ptr<std::array<Vector3<Position>, Profile::kNodes>> from_;
  int still_ticks_ = 0;  // 0: nothing to compare with yet
};

}  // namespace palpate::sim
