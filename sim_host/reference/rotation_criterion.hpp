// Which groups of a rotation front should be split: a measure for each, to be compared with a threshold.
//
// With A = R_group^T F_leaf and w = half the axial vector of A - A^T (of length sin theta where A is a
// rotation by theta), a leaf's strain sym(A) - I has a spurious trace of about -|w|^2: the material swells by
// it. What the body moves is about the sum of V |w|^2 over all leaves, so kRemainingRotation splits the group
// whose split takes the most from that sum.
#pragma once

#include "reference/adaptive_corotation.hpp"

namespace palpate::reference {

enum class Criterion {
  kNeighbours,  // the paper's: largest |R - R'|_F^2 over groups across a face
  kSiblings,    // the same over the sibling only; a root has its face neighbours
  kSkew,        // largest |w| of a leaf
  kRemainingRotation
};

/// Sums over a group's leaves, m3. The split parts are the between-halves part of the variance of w.
struct RemainingRotation {
  double first = 0.0;   // V/4 |w1 - w2|^2 of its two children's means: what splitting it removes
  double second = 0.0;  // the same of both children
  double all = 0.0;     // sum of V |w|^2 over the leaves

  /// The next split counts for a quarter, because a split may have to be followed by another before it pays:
  /// children that mirror each other have the same mean. The whole counts for 1/32, so that no group can
  /// stall.
  [[nodiscard]] double measure() const { return first + second / 4 + all / 32; }
};

RemainingRotation remaining_rotation(const AdaptiveCorotation& body, uint32_t group);

/// That of a parent, from its children alone: first = V |R1 - R2|_F^2 / 8, since |w1 - w2| is their angle and
/// |R1 - R2|_F^2 = 4 (1 - cos theta).
RemainingRotation remaining_rotation_merged(const AdaptiveCorotation& body, uint32_t parent);

/// The measure of each tet of the front, indexed by tet; zero elsewhere and where nothing can be split.
std::vector<double> measures_of(const AdaptiveCorotation& body, const Front& front, Criterion criterion);

/// A front met on the way, with its error from full corotation.
struct FrontPoint {
  Front front;
  double measure;  // the largest in the front
  Distance error;
  std::vector<Vector> force;  // on all nodes, N
};

/// Starts from the roots and splits the group with the largest measure, with those that equal it (mirror
/// images do), each time at equilibrium, until more than most_groups. Returns the fronts at which a threshold
/// can stop: those whose largest measure is below all before.
std::vector<FrontPoint> refine_worst_first(AdaptiveCorotation& body, Criterion criterion, Closure closure,
                                           uint32_t most_groups);

/// The point with the most groups that is not above `count`.
const FrontPoint& point_at(const std::vector<FrontPoint>& curve, uint32_t count);

/// Splits all groups whose measure is above the threshold, at equilibrium and again until none is left. False
/// if it does not end.
bool refine_above(AdaptiveCorotation& body, Front& front, Criterion criterion, Closure closure,
                  double threshold);

/// The same for kRemainingRotation without closure, and merges all pairs whose parent would be below
/// merge_below.
bool adapt(AdaptiveCorotation& body, Front& front, double split_above, double merge_below);

}  // namespace palpate::reference
