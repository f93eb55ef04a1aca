#include "paper/criterion_ranking.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scenario/scenario.hpp"

namespace palpate::sim {
namespace {

/// Errors within this factor of each other are equally good.
constexpr double kTie = 1.05;

/// A criterion that never refines shares nothing and has the error of its last point everywhere.
void find_range(const LoadStudy& study, Ranking& ranking) {
  constexpr double kNoLimit = 1e9;
  ranking.least_tets = 1.0;
  ranking.most_tets = kNoLimit;
  for (const StudyCurve& curve : study.curves) {
    if (curve.criterion != kUniformMesh)
      ranking.least_tets = std::max(ranking.least_tets, curve.points.front().mean_tets);
  }
  for (const StudyCurve& curve : study.curves) {
    const double last = curve.points.back().mean_tets;
    if (curve.criterion != kUniformMesh && last > ranking.least_tets)
      ranking.most_tets = std::min(ranking.most_tets, last);
  }
  if (ranking.most_tets == kNoLimit) ranking.most_tets = ranking.least_tets;
}

double mean_time_ns(const StudyCurve& curve) {
  double sum = 0.0;
  for (const StudyPoint& point : curve.points) sum += point.remesh_ns;
  return sum / static_cast<double>(curve.points.size());
}

double mean_error(const StudyCurve& curve, const Ranking& ranking) {
  constexpr int kSamples = 21;
  double sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double part = static_cast<double>(i) / (kSamples - 1);
    const double tets = ranking.least_tets * std::pow(ranking.most_tets / ranking.least_tets, part);
    sum += std::log(error_at(curve, tets)) / kSamples;
  }
  return std::exp(sum);
}

void sort_by_error(std::vector<RankedError>& order) {
  std::sort(order.begin(), order.end(),
            [](const RankedError& a, const RankedError& b) { return a.mm < b.mm; });
}

}  // namespace

Ranking rank(const LoadStudy& study) {
  Ranking ranking{};
  find_range(study, ranking);
  ranking.order.reserve(study.curves.size());
  for (const StudyCurve& curve : study.curves)
    ranking.order.push_back({mean_error(curve, ranking), curve.criterion, mean_time_ns(curve)});
  sort_by_error(ranking.order);
  return ranking;
}

std::vector<RankedError> rank_all(const std::vector<LoadStudy>& studies) {
  std::vector<RankedError> means;
  for (const LoadStudy& study : studies) {
    for (const RankedError& one : rank(study).order) {
      auto found = std::find_if(means.begin(), means.end(),
                                [&](const RankedError& mean) { return mean.name == one.name; });
      if (found == means.end()) found = means.insert(means.end(), RankedError{0.0, one.name, 0.0});
      found->mm += std::log(one.mm) / static_cast<double>(studies.size());
      found->remesh_ns += one.remesh_ns / static_cast<double>(studies.size());
    }
  }
  for (RankedError& mean : means) mean.mm = std::exp(mean.mm);
  sort_by_error(means);
  return means;
}

const RankedError& error_of(const std::vector<RankedError>& order, const std::string& name) {
  const auto found =
      std::find_if(order.begin(), order.end(), [&](const RankedError& one) { return one.name == name; });
  if (found == order.end()) throw std::logic_error("no curve is called " + name);
  return *found;
}

const RankedError& best_criterion(const std::vector<RankedError>& order) {
  const auto found = std::find_if(order.begin(), order.end(),
                                  [](const RankedError& one) { return one.name != kUniformMesh; });
  if (found == order.end()) throw std::logic_error("no criterion is ranked");
  return *found;
}

const RankedError& chosen_criterion(const std::vector<RankedError>& means) {
  const RankedError* chosen = &best_criterion(means);
  const double limit_mm = kTie * chosen->mm;
  for (const RankedError& one : means) {
    const bool is_good = one.name != kUniformMesh && one.mm <= limit_mm;
    if (is_good && one.remesh_ns < chosen->remesh_ns) chosen = &one;
  }
  return *chosen;
}

std::string default_criterion() { return Scenario{}.stretch; }

std::string name_of(const LoadStudy& study) {
  return fmt::format("{} to level {}", study.load, study.finest_level);
}

std::string conclusion_of(const std::vector<LoadStudy>& studies) {
  std::vector<std::string> all;
  const std::vector<RankedError> means = rank_all(studies);
  all.reserve(means.size());
  for (const RankedError& mean : means)
    all.push_back(fmt::format("{} {:.3f} mm, {:.0f} ns", mean.name, mean.mm, mean.remesh_ns));
  const std::string& chosen = chosen_criterion(means).name;
  std::vector<std::string> lost;
  std::vector<std::string> useless;
  for (const LoadStudy& study : studies) {
    const std::vector<RankedError> order = rank(study).order;
    const RankedError& best = best_criterion(order);
    const RankedError& own = error_of(order, chosen);
    if (order.front().name == kUniformMesh) useless.push_back(name_of(study));
    if (own.mm > kTie * best.mm)
      lost.push_back(
          fmt::format("{} ({} {:.3f} mm, {} {:.3f} mm)", name_of(study), best.name, best.mm, chosen, own.mm));
  }
  std::string text = fmt::format(
      "Conclusion: over {} loads {} is the best criterion: the lowest geometric mean error, or within 5 % of "
      "it "
      "and the fastest that is; time is that of the re-mesh stage a tick and tet ({}). It is {}",
      studies.size(), chosen, fmt::join(all, "; "),
      chosen == default_criterion() ? "the default" : "NOT the default, which is " + default_criterion());
  if (!lost.empty()) text += fmt::format(". Another criterion is better for {}", fmt::join(lost, "; "));
  if (!useless.empty())
    text += fmt::format(". A uniform mesh beats all three for {}", fmt::join(useless, "; "));
  return text + ".";
}

}  // namespace palpate::sim
