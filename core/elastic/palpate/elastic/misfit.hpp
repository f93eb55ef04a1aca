// The misfit of a group: what is lost by turning all of its leaves alike, and thus how much there is to gain
// from splitting it.
//
// A leaf whose own rotation differs from its group's by an angle theta has, with A = R^T F,
//   w = (A32 - A23, A13 - A31, A21 - A12) / 2,   |w| = sin theta,
// and to second order a trace that is wrong by |w|^2: lambda |w|^2 of pressure that should not be. With W_j
// the sums of V w over the four grandchildren of the group's tet and V in root volumes, a split removes
//   D0 = |W_0 + W_1 - W_2 - W_3|^2 / V
// of the sum S of V |w|^2, and splits of its halves (|W_0 - W_1|^2 + |W_2 - W_3|^2) / (V / 2) more. The
// misfit is
//   M = 4 (D0 + a quarter of those + S / 32),
// where S is there because mirror images of each other turn alike (D0 = 0) and would never be split
// otherwise. The factor 4 is of |w|^2 against |A - A^T|. What two children leave in their parent follows
// without extracting the parent's rotation: D0 = V |R_1 - R_2|_F^2 / 8 (with the norm of Tagawa et al., Eq.
// 3) and their own D0 and S.
#pragma once

#include "palpate/elastic/element_force.hpp"
#include "palpate/elastic/groups.hpp"
#include "palpate/numeric/high_word.hpp"

namespace palpate {

/// Sums over the leaves of a group.
class MisfitSums {
 public:
  void clear() {
    squares_ = 0;
    for (const uint32_t j : bounded<4>(4, [] {})) turn_[j] = zero_vector<Turn>();
  }

  /// A leaf `depth` levels, at least 1, below the group's tet; `turn` is its 2 w, `path` as in Leaf.
  void add(const Vector3<Strain>& turn, uint32_t path, uint32_t depth) {
    squares_ += dot(turn, turn).raw() >> depth;
    // A child that is a leaf counts for both of the children that it does not have.
    const uint32_t j = depth == 1 ? 2u * (path & 1u) : (path >> (depth - 2u)) & 3u;
    add_turn(turn, depth == 1 ? 2u : depth, turn_[j]);
    if (depth == 1) add_turn(turn, 2u, turn_[j + 1]);
  }

  /// M and, of it, what the group leaves in its parent: 4 (D0 / 4 + S / 32). `level` is the group's tet's.
  void finish(uint32_t level, Misfit& misfit, Misfit& left) const {
    const uint64_t d0 = square(turn_[0] + turn_[1] - (turn_[2] + turn_[3]));
    const uint64_t d1 = (square(turn_[0] - turn_[1]) + square(turn_[2] - turn_[3])) / 2;
    const uint64_t rest = static_cast<uint64_t>(squares_) / 32;
    misfit = to_misfit(d0 + d1 + rest, level);
    left = to_misfit(d0 / 4 + rest, level);
  }

 private:
  using Turn = Q<5, 26>;
  static constexpr int kSquareBits = 2 * Strain::kFractionBits;

  static void add_turn(const Vector3<Strain>& turn, uint32_t depth, Vector3<Turn>& sum) {
    const auto weight = Q<0, 31>::from_raw(int32_t{1} << (31 - depth));
    sum =
        Vector3<Turn>(multiply_add_high(turn[0], weight, sum[0]), multiply_add_high(turn[1], weight, sum[1]),
                      multiply_add_high(turn[2], weight, sum[2]));
  }
  static uint64_t square(const Vector3<Turn>& v) {
    return static_cast<uint64_t>(dot(v, v).raw()) << (kSquareBits - 2 * Turn::kFractionBits);
  }
  static Misfit to_misfit(uint64_t sum, uint32_t level) {
    const uint64_t raw = sum >> (static_cast<uint32_t>(kSquareBits - Misfit::kFractionBits) + level);
    return raw > 0x7fffffffu ? Misfit::max() : Misfit::from_raw(static_cast<int32_t>(raw));
  }

  std::array<Vector3<Turn>, 4> turn_;  // 2 W_j / V
  int64_t squares_;                    // 4 S / V
};

/// What a pair of groups would have as one, on their parent at `level`.
inline Misfit joined_misfit(Q<4, 27> square_of_difference, Misfit left0, Misfit left1, uint32_t level) {
  // 4 D0 = V |R_1 - R_2|_F^2 / 2, with V = 2^-level.
  const auto d0 = static_cast<uint64_t>(square_of_difference.raw()) << 4 >> level;
  const uint64_t sum = d0 + d0 / 32 + static_cast<uint64_t>(left0.raw()) + static_cast<uint64_t>(left1.raw());
  return sum > 0x7fffffffu ? Misfit::max() : Misfit::from_raw(static_cast<int32_t>(sum));
}

}  // namespace palpate
