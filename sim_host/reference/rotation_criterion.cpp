#include "reference/rotation_criterion.hpp"

#include <algorithm>

#include "reference/polar_rotation.hpp"

namespace palpate::reference {
namespace {

constexpr double kTie = 1e-5;      // relative: equal but for rounding and the solver's tolerance
constexpr double kNothing = 1e-9;  // of the largest first measure: what is below is noise
constexpr int kMostRounds = 60;

using LeafPair = std::pair<uint32_t, uint32_t>;

std::vector<LeafPair> leaves_across_faces(const Mesh& mesh) {
  std::map<std::array<uint32_t, 3>, uint32_t> first_at;
  std::vector<LeafPair> pairs;
  for (uint32_t i = 0; i < mesh.tet.size(); ++i) {
    for (uint32_t face = 0; face < 4; ++face) {
      std::array<uint32_t, 3> nodes{};
      for (uint32_t k = 0; k < 3; ++k) nodes[k] = mesh.tet[i][(face + 1 + k) % 4];
      std::sort(nodes.begin(), nodes.end());
      const auto found = first_at.emplace(nodes, i);
      if (!found.second) pairs.emplace_back(found.first->second, i);
    }
  }
  return pairs;
}

/// Largest |R - R'|_F^2 over groups across a face; `among(a, b)` says which pairs count.
template <class Among>
void measure_neighbours(const AdaptiveCorotation& body, const Front& front, Among among,
                        std::vector<double>& measure) {
  const std::vector<uint32_t> group = front.group_of_leaves();
  for (const LeafPair& pair : leaves_across_faces(body.tree().mesh)) {
    const uint32_t a = group[pair.first];
    const uint32_t b = group[pair.second];
    if (a == b || !among(a, b)) continue;
    const double difference = (body.rotation(a) - body.rotation(b)).squaredNorm();
    measure[a] = std::max(measure[a], difference);
    measure[b] = std::max(measure[b], difference);
  }
}

Vector half_skew(const AdaptiveCorotation& body, uint32_t group, uint32_t leaf) {
  return 0.5 * axial_vector(body.rotation(group).transpose() * body.gradient(leaf));
}

/// Sum of V w over the leaves of `tet`, a descendant of the group.
Vector sum_of_skew(const AdaptiveCorotation& body, uint32_t group, uint32_t tet) {
  Vector sum = Vector::Zero();
  for (uint32_t i = body.tree().tet[tet].first_leaf; i < body.tree().tet[tet].end_leaf; ++i) {
    sum += body.leaves()[i].volume * half_skew(body, group, i);
  }
  return sum;
}

/// V/4 |w1 - w2|^2 of the two halves of a tet: |sum1 - sum2|^2 / V.
double between_halves(const AdaptiveCorotation& body, uint32_t group, uint32_t tet) {
  const TreeTet& whole = body.tree().tet[tet];
  if (body.tree().is_leaf(tet)) return 0.0;
  return (sum_of_skew(body, group, whole.child[0]) - sum_of_skew(body, group, whole.child[1])).squaredNorm() /
         whole.volume;
}

double largest_skew(const AdaptiveCorotation& body, uint32_t group) {
  double largest = 0.0;
  for (uint32_t i = body.tree().tet[group].first_leaf; i < body.tree().tet[group].end_leaf; ++i) {
    largest = std::max(largest, half_skew(body, group, i).norm());
  }
  return largest;
}

double measure_of(const AdaptiveCorotation& body, uint32_t group, Criterion criterion) {
  switch (criterion) {
    case Criterion::kSiblings:
      if (body.tree().tet[group].parent == kNoTet) return 0.0;
      return (body.rotation_as_group(body.tree().sibling(group)) - body.rotation(group)).squaredNorm();
    case Criterion::kSkew:
      return largest_skew(body, group);
    default:
      return remaining_rotation(body, group).measure();
  }
}

bool split_all_above(Front& front, const std::vector<double>& measure, Closure closure, double threshold) {
  bool any = false;
  for (uint32_t t = 0; t < measure.size(); ++t) {
    if (measure[t] <= threshold) continue;
    front.split(t, closure);
    any = true;
  }
  return any;
}

}  // namespace

RemainingRotation remaining_rotation(const AdaptiveCorotation& body, uint32_t group) {
  const TreeTet& tet = body.tree().tet[group];
  RemainingRotation sums;
  if (body.tree().is_leaf(group)) return sums;
  sums.first = between_halves(body, group, group);
  for (const uint32_t child : tet.child) sums.second += between_halves(body, group, child);
  for (uint32_t i = tet.first_leaf; i < tet.end_leaf; ++i) {
    sums.all += body.leaves()[i].volume * half_skew(body, group, i).squaredNorm();
  }
  return sums;
}

RemainingRotation remaining_rotation_merged(const AdaptiveCorotation& body, uint32_t parent) {
  const TreeTet& tet = body.tree().tet[parent];
  RemainingRotation sums;
  sums.first = tet.volume * (body.rotation(tet.child[0]) - body.rotation(tet.child[1])).squaredNorm() / 8.0;
  sums.all = sums.first;
  for (const uint32_t child : tet.child) {
    const RemainingRotation part = remaining_rotation(body, child);
    sums.second += part.first;
    sums.all += part.all;
  }
  return sums;
}

std::vector<double> measures_of(const AdaptiveCorotation& body, const Front& front, Criterion criterion) {
  const BisectionTree& tree = body.tree();
  std::vector<double> measure(tree.tet.size(), 0.0);
  const auto is_root = [&](uint32_t t) { return tree.tet[t].parent == kNoTet; };
  if (criterion == Criterion::kNeighbours) {
    measure_neighbours(
        body, front, [](uint32_t, uint32_t) { return true; }, measure);
  } else {
    if (criterion == Criterion::kSiblings) {
      measure_neighbours(
          body, front, [&](uint32_t a, uint32_t b) { return is_root(a) && is_root(b); }, measure);
    }
    for (const uint32_t group : front.tets()) {
      if (front.can_split(group))
        measure[group] = std::max(measure[group], measure_of(body, group, criterion));
    }
  }
  for (uint32_t t = 0; t < tree.tet.size(); ++t) {
    if (!front.can_split(t)) measure[t] = 0.0;
  }
  return measure;
}

std::vector<FrontPoint> refine_worst_first(AdaptiveCorotation& body, Criterion criterion, Closure closure,
                                           uint32_t most_groups) {
  Front front(body.tree());
  std::vector<FrontPoint> curve;
  body.reset();
  while (front.count() <= most_groups && body.settle(front)) {
    const std::vector<double> measure = measures_of(body, front, criterion);
    const double largest = *std::max_element(measure.begin(), measure.end());
    if (curve.empty() || largest < curve.back().measure * (1.0 - kTie)) {
      curve.push_back(FrontPoint{front, largest, body.error(), body.force()});
    }
    if (largest <= kNothing * curve.front().measure) break;
    for (uint32_t t = 0; t < measure.size(); ++t) {
      if (measure[t] > largest * (1.0 - kTie)) front.split(t, closure);
    }
  }
  return curve;
}

const FrontPoint& point_at(const std::vector<FrontPoint>& curve, uint32_t count) {
  const FrontPoint* best = &curve.front();
  for (const FrontPoint& point : curve) {
    if (point.front.count() <= count && point.front.count() >= best->front.count()) best = &point;
  }
  return *best;
}

bool refine_above(AdaptiveCorotation& body, Front& front, Criterion criterion, Closure closure,
                  double threshold) {
  for (int round = 0; round < kMostRounds; ++round) {
    if (!body.settle(front)) return false;
    if (!split_all_above(front, measures_of(body, front, criterion), closure, threshold)) return true;
  }
  return false;
}

bool adapt(AdaptiveCorotation& body, Front& front, double split_above, double merge_below) {
  for (int round = 0; round < kMostRounds; ++round) {
    if (!body.settle(front)) return false;
    std::vector<uint32_t> merges;
    for (uint32_t t = 0; t < body.tree().tet.size(); ++t) {
      if (front.can_merge(t) && remaining_rotation_merged(body, t).measure() < merge_below) {
        merges.push_back(t);
      }
    }
    const std::vector<double> measure = measures_of(body, front, Criterion::kRemainingRotation);
    const bool any_split = split_all_above(front, measure, Closure::kNone, split_above);
    for (const uint32_t parent : merges) {
      if (front.can_merge(parent)) front.merge(parent);
    }
    if (!any_split && merges.empty()) return true;
  }
  return false;
}

}  // namespace palpate::reference
