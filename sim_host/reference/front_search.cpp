#include "reference/front_search.hpp"

#include <algorithm>

#include "reference/polar_rotation.hpp"

namespace palpate::reference {
namespace {

constexpr std::size_t kShortlist = 40;
constexpr std::size_t kTrials = 40;
constexpr uint32_t kSplitsAtOnce = 4;
constexpr double kWorthwhile = 1e-9;  // relative

/// What the rotation of `tet` as a group changes in the forces of its leaves, on the free coordinates.
Eigen::VectorXd force_change(const AdaptiveCorotation& body, uint32_t tet) {
  const FreeNodes& free = body.free_nodes();
  Eigen::VectorXd change = Eigen::VectorXd::Zero(free.coordinates());
  const Matrix r = body.rotation_as_group(tet);
  for (uint32_t i = body.tree().tet[tet].first_leaf; i < body.tree().tet[tet].end_leaf; ++i) {
    const Matrix& f = body.gradient(i);
    const Element& leaf = body.leaves()[i];
    const ElementForces shared = forces_of(leaf, f, r, body.material());
    const ElementForces own = forces_of(leaf, f, polar_rotation(f), body.material());
    for (uint32_t k = 0; k < 4; ++k) {
      if (!free.is_free(leaf.node[k])) continue;
      change.segment<3>(free.first_coordinate(leaf.node[k])) += shared[k] - own[k];
    }
  }
  return change;
}

void apply(const Exchange& exchange, Front& front) {
  front.split(exchange.split, Closure::kNone);
  front.merge(exchange.merge);
}

}  // namespace

FrontSearch::FrontSearch(const AdaptiveCorotation& body, const Front& front) : tree_(&body.tree()) {
  for (uint32_t t = 0; t < tree_->tet.size(); ++t) {
    moved_.emplace_back(body.response(force_change(body, t)));
  }
  for (uint32_t t = 0; t < tree_->tet.size(); ++t) {
    split_.emplace_back();
    if (tree_->is_leaf(t)) continue;
    split_[t] = moved_[tree_->tet[t].child[0]] + moved_[tree_->tet[t].child[1]] - moved_[t];
  }
  base_ = Eigen::VectorXd::Zero(body.free_nodes().coordinates());
  for (uint32_t node = 0; node < body.position().size(); ++node) {
    if (!body.free_nodes().is_free(node)) continue;
    base_.segment<3>(body.free_nodes().first_coordinate(node)) = body.position()[node] - body.full().x[node];
  }
  for (const uint32_t t : front.tets()) base_ -= moved_[t];
}

double FrontSearch::mean_mm(const Eigen::VectorXd& x) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < x.size(); i += 3) sum += x.segment<3>(i).norm();
  return 3e3 * sum / static_cast<double>(x.size());
}

Eigen::VectorXd FrontSearch::sum_of(const Front& front) const {
  Eigen::VectorXd sum = base_;
  for (const uint32_t t : front.tets()) sum += moved_[t];
  return sum;
}

std::vector<FrontSearch::Change> FrontSearch::best_changes(const Front& front, const Eigen::VectorXd& sum,
                                                           bool splits) const {
  std::vector<Change> changes;
  for (uint32_t t = 0; t < tree_->tet.size(); ++t) {
    if (splits ? !front.can_split(t) : !front.can_merge(t)) continue;
    changes.push_back(Change{splits ? mean_mm(sum + split_[t]) : mean_mm(sum - split_[t]), t});
  }
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return a.error_mm < b.error_mm; });
  if (changes.size() > kShortlist) changes.resize(kShortlist);
  return changes;
}

std::vector<Front> FrontSearch::merge_cheapest_first(Front front) const {
  std::vector<Front> fronts = {front};
  Eigen::VectorXd sum = sum_of(front);
  while (front.count() > tree_->roots.size()) {
    const uint32_t parent = best_changes(front, sum, false).front().parent;
    front.merge(parent);
    sum -= split_[parent];
    fronts.push_back(front);
  }
  return fronts;
}

std::vector<Exchange> FrontSearch::exchanges(const Front& front, std::size_t most) const {
  const Eigen::VectorXd sum = sum_of(front);
  const double now = mean_mm(sum);
  const std::vector<Change> merges = best_changes(front, sum, false);
  std::vector<Exchange> found;
  for (const Change& s : best_changes(front, sum, true)) {
    for (const Change& m : merges) {
      if (tree_->tet[s.parent].parent == m.parent) continue;
      const double error = mean_mm(sum + split_[s.parent] - split_[m.parent]);
      if (error < now * (1.0 - kWorthwhile)) found.push_back(Exchange{error, s.parent, m.parent});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Exchange& a, const Exchange& b) { return a.error_mm < b.error_mm; });
  if (found.size() > most) found.resize(most);
  return found;
}

void FrontSearch::split_best(Front& front, uint32_t splits) const {
  Eigen::VectorXd sum = sum_of(front);
  for (uint32_t i = 0; i < splits; ++i) {
    const uint32_t split = best_changes(front, sum, true).front().parent;
    front.split(split, Closure::kNone);
    sum += split_[split];
  }
}

std::vector<Front> search_fronts(AdaptiveCorotation& body) {
  body.reset();
  const Front leaves = Front::of_leaves(body.tree());
  const FrontSearch search(body, leaves);
  return search.merge_cheapest_first(leaves);
}

void grow(AdaptiveCorotation& body, Front& front, uint32_t count) {
  while (front.count() < count && body.settle(front)) {
    FrontSearch(body, front).split_best(front, std::min(kSplitsAtOnce, count - front.count()));
  }
}

void polish(AdaptiveCorotation& body, Front& front, int rounds) {
  if (!body.settle(front)) return;
  double error = body.error().mean_mm;
  for (int round = 0; round < rounds; ++round) {
    const FrontSearch search(body, front);
    bool is_better = false;
    for (const Exchange& exchange : search.exchanges(front, kTrials)) {
      Front trial = front;
      apply(exchange, trial);
      if (!body.settle(trial) || body.error().mean_mm >= error * (1.0 - kWorthwhile)) continue;
      is_better = true;
      front = trial;
      error = body.error().mean_mm;
      break;
    }
    if (!is_better) break;
  }
  body.settle(front);
}

}  // namespace palpate::reference
