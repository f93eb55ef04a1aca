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
#pragma GCC unroll 6
    for (const uint32_t j : bounded<kSums>(kSums, [] {})) turn_[j] = zero_vector<Turn>();
  }

  /// A leaf `depth` levels, at least 1, below the group's tet; `turn` is its 2 w, `path` as in Leaf. Without
  /// a branch.
  void add(const Vector3<Strain>& turn, uint32_t path, uint32_t depth) {
    squares_ += static_cast<uint64_t>(dot(turn, turn).raw()) >> depth;
    const uint32_t is_child = depth == 1 ? 1u : 0u;
    const uint32_t below = depth - 2u + is_child;
    const uint32_t place = 4u * is_child + ((path >> below) & (3u - 2u * is_child));
    add_turn(turn, below + 2u, turn_[place]);
  }

  /// M and, of it, what the group leaves in its parent: 4 (D0 / 4 + S / 32). `level` is the group's tet's.
  void finish(uint32_t level, Misfit& misfit, Misfit& left) const {
    // A child that is a leaf counts for both of the children that it does not have: d1 sees nothing of it.
    const Vector3<Turn> first = turn_[4] + turn_[4];
    const Vector3<Turn> second = turn_[5] + turn_[5];
    const uint64_t d0 = square(turn_[0] + turn_[1] + first - (turn_[2] + turn_[3] + second));
    const uint64_t d1 = (square(turn_[0] - turn_[1]) + square(turn_[2] - turn_[3])) / 2;
    const uint64_t rest = squares_ / 32;
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

  static constexpr uint32_t kSums = 6;
  std::array<Vector3<Turn>, kSums> turn_;  // 2 W_j / V, and half of it of the two children that are leaves
  uint64_t squares_;                       // 4 S / V
};

/// What a pair of groups would have as one, on their parent at `level`.
inline Misfit joined_misfit(Q<4, 27> square_of_difference, Misfit left0, Misfit left1, uint32_t level) {
  // 4 D0 = V |R_1 - R_2|_F^2 / 2, with V = 2^-level.
  const auto d0 = static_cast<uint64_t>(square_of_difference.raw()) << 4 >> level;
  const uint64_t sum = d0 + d0 / 32 + static_cast<uint64_t>(left0.raw()) + static_cast<uint64_t>(left1.raw());
  return sum > 0x7fffffffu ? Misfit::max() : Misfit::from_raw(static_cast<int32_t>(sum));
}

}  // namespace palpate
