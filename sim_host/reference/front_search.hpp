// A near-best choice of groups for a given count, to judge criteria by. Errors are mean distances from full
// corotation over the free nodes. They are predicted to first order from an equilibrium: what a group's
// shared rotation changes in the forces of its leaves, the body answers with the response of full corotation,
// and groups add up.
#pragma once

#include "reference/adaptive_corotation.hpp"

namespace palpate::reference {

/// One group is split and another pair of groups merged: the count stays.
struct Exchange {
  double error_mm;  // predicted
  uint32_t split;
  uint32_t merge;  // the parent
};

class FrontSearch {
 public:
  /// Predicts from the equilibrium that `body` is at, with the groups of `front`. One linear solve a tet of
  /// the tree.
  FrontSearch(const AdaptiveCorotation& body, const Front& front);

  /// From `front` down to the roots, one group less each: always the merge that is predicted to be the best.
  [[nodiscard]] std::vector<Front> merge_cheapest_first(Front front) const;

  /// The most promising exchanges that are predicted to help, best first.
  [[nodiscard]] std::vector<Exchange> exchanges(const Front& front, std::size_t most) const;

  /// Splits what is predicted to be best, one group after the other.
  void split_best(Front& front, uint32_t splits) const;

 private:
  struct Change {
    double error_mm;
    uint32_t parent;
  };

  [[nodiscard]] Eigen::VectorXd sum_of(const Front& front) const;
  [[nodiscard]] static double mean_mm(const Eigen::VectorXd& x);
  [[nodiscard]] std::vector<Change> best_changes(const Front& front, const Eigen::VectorXd& sum,
                                                 bool splits) const;

  const BisectionTree* tree_;
  Eigen::VectorXd base_;                // the error that no group's change explains
  std::vector<Eigen::VectorXd> moved_;  // by each tet as a group, m
  std::vector<Eigen::VectorXd> split_;  // children's minus its own
};

/// Fronts of every count from full corotation's equilibrium: fronts[i] has i groups less than leaves.
std::vector<Front> search_fronts(AdaptiveCorotation& body);

/// Splits up to `count` groups, predicted anew every few splits.
void grow(AdaptiveCorotation& body, Front& front, uint32_t count);

/// Exchanges that lower the true error: each is predicted at the front's own equilibrium and kept if the
/// error there falls. At most `rounds`. Leaves `body` at the front's equilibrium.
void polish(AdaptiveCorotation& body, Front& front, int rounds);

}  // namespace palpate::reference
