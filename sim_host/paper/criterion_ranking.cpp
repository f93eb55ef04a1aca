#include "paper/criterion_ranking.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scenario/scenario.hpp"

namespace palpate::sim {
namespace {

/// Losses within this factor of each other are equal.
constexpr double kTie = 1.05;

const StudyCurve& curve_of(const LoadStudy& study, const std::string& criterion) {
  const auto found = std::find_if(study.curves.begin(), study.curves.end(),
                                  [&](const StudyCurve& curve) { return curve.criterion == criterion; });
  if (found == study.curves.end()) throw std::logic_error("no curve is called " + criterion);
  return *found;
}

double mean_over(const std::vector<StudyPoint>& points, double (*value)(const StudyPoint&)) {
  double sum = 0.0;
  for (const StudyPoint& point : points) sum += value(point);
  return sum / static_cast<double>(points.size());
}

double remesh_ns(const StudyCurve& curve) {
  return mean_over(curve.points, [](const StudyPoint& point) { return point.remesh_ns; });
}

/// Of the stages that are the same whatever refines, a tick and tet.
double other_ns(const LoadStudy& study) {
  double sum = 0.0;
  for (const StudyCurve& curve : study.curves) {
    if (curve.criterion == kUniformMesh) continue;
    sum += mean_over(curve.points, [](const StudyPoint& point) { return point.tick_ns - point.remesh_ns; });
  }
  return sum / static_cast<double>(study.curves.size() - 1);
}

/// What a tet costs.
double price_of(const LoadStudy& study, const StudyCurve& curve, Equal equal) {
  return equal == Equal::kTets ? 1.0 : other_ns(study) + remesh_ns(curve);
}

void find_range(const LoadStudy& study, Equal equal, Ranking& ranking) {
  ranking.least = 0.0;
  for (const StudyCurve& curve : study.curves)
    ranking.least = std::max(ranking.least, curve.points.front().tets * price_of(study, curve, equal));
  const StudyCurve& uniform = curve_of(study, kUniformMesh);
  ranking.most = std::max(ranking.least, uniform.points.back().tets * price_of(study, uniform, equal));
}

double mean_error(const StudyCurve& curve, StudyError which, double price, const Ranking& ranking) {
  constexpr int kSamples = 41;
  double sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double part = static_cast<double>(i) / (kSamples - 1);
    const double amount = ranking.least * std::pow(ranking.most / ranking.least, part);
    // Rounding must not lead below the first point, where a curve has no error.
    const double tets = std::max(amount / price, curve.points.front().tets);
    sum += std::log(error_at(curve, tets, which)) / kSamples;
  }
  return std::exp(sum);
}

void sort_by_error(std::vector<RankedError>& order) {
  std::sort(order.begin(), order.end(),
            [](const RankedError& a, const RankedError& b) { return a.error < b.error; });
}

/// The loads and errors for which a uniform mesh is better than every criterion.
std::vector<std::string> lost_to_uniform(const std::vector<LoadStudy>& studies) {
  std::vector<std::string> lost;
  for (const LoadStudy& study : studies) {
    for (const StudyError which : errors_of(study)) {
      if (rank(study, which, Equal::kTets).order.front().name == kUniformMesh)
        lost.push_back(name_of(study, which));
    }
  }
  return lost;
}

}  // namespace

Ranking rank(const LoadStudy& study, StudyError which, Equal equal) {
  Ranking ranking{};
  find_range(study, equal, ranking);
  ranking.order.reserve(study.curves.size());
  for (const StudyCurve& curve : study.curves) {
    const double price = price_of(study, curve, equal);
    ranking.order.push_back({mean_error(curve, which, price, ranking), curve.criterion});
  }
  sort_by_error(ranking.order);
  return ranking;
}

std::vector<RankedError> rank_all(const std::vector<LoadStudy>& studies, Equal equal) {
  std::vector<RankedError> means;
  for (const StudyCurve& curve : studies.front().curves) means.push_back({0.0, curve.criterion});
  double count = 0.0;
  for (const LoadStudy& study : studies) {
    for (const StudyError which : errors_of(study)) {
      const std::vector<RankedError> order = rank(study, which, equal).order;
      const double uniform = error_of(order, kUniformMesh).error;
      for (RankedError& mean : means) mean.error += std::log(error_of(order, mean.name).error / uniform);
      count += 1.0;
    }
  }
  for (RankedError& mean : means) mean.error = std::exp(mean.error / count);
  sort_by_error(means);
  return means;
}

std::vector<RankedError> losses_of(const std::vector<LoadStudy>& studies) {
  std::vector<RankedError> losses;
  for (const StudyCurve& curve : studies.front().curves)
    if (curve.criterion != kUniformMesh) losses.push_back({1.0, curve.criterion});
  for (const Equal equal : {Equal::kTets, Equal::kTime}) {
    const std::vector<RankedError> order = rank_all(studies, equal);
    const double best = best_criterion(order).error;
    for (RankedError& loss : losses)
      loss.error = std::max(loss.error, error_of(order, loss.name).error / best);
  }
  sort_by_error(losses);
  return losses;
}

double remesh_ns_of(const std::vector<LoadStudy>& studies, const std::string& criterion) {
  double sum = 0.0;
  for (const LoadStudy& study : studies) sum += remesh_ns(curve_of(study, criterion));
  return sum / static_cast<double>(studies.size());
}

std::vector<StudyError> errors_of(const LoadStudy& study) {
  if (study.has_force) return {StudyError::kMeanMm, StudyError::kForcePercent};
  return {StudyError::kMeanMm};
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

std::string default_criterion() { return Scenario{}.stretch; }

std::string name_of(const LoadStudy& study, StudyError which) {
  return fmt::format("{} to level {}, {}", study.load, study.finest_level,
                     which == StudyError::kMeanMm ? "mm" : "force in %");
}

std::string conclusion_of(const std::vector<LoadStudy>& studies) {
  const std::vector<RankedError> losses = losses_of(studies);
  std::vector<std::string> all;
  all.reserve(losses.size());
  for (const RankedError& loss : losses)
    all.push_back(fmt::format("{} {:.0f} %", loss.name, 100.0 * (loss.error - 1.0)));
  const bool stays = error_of(losses, default_criterion()).error <= kTie * losses.front().error;
  std::string text = fmt::format(
      "Conclusion: behind the best criterion, at equal numbers of tets or at equal times, whichever is "
      "worse: "
      "{}. The default, {}, {}",
      fmt::join(all, ", "), default_criterion(),
      stays ? "is the one that loses least, or within 5 % of it"
            : "is NOT the one that loses least, which is " + losses.front().name);
  const std::vector<std::string> lost = lost_to_uniform(studies);
  if (!lost.empty()) text += fmt::format(". A uniform mesh beats all three for {}", fmt::join(lost, "; "));
  return text + ".";
}

}  // namespace palpate::sim
