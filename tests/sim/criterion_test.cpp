// The study of what refines a mesh best: its curves, the thresholds it tries, and what it concludes.
#include <cmath>

#include "paper/criterion_ranking.hpp"
#include "paper/threshold_search.hpp"
#include "program.hpp"

namespace palpate::test {
namespace {

using sim::StudyError;

constexpr double kOtherStagesNs = 100.0;

sim::StudyPoint point(double tets, double mm, double force_percent = 0.0, double remesh_ns = 0.0) {
  return {0.1, tets, {mm, mm}, force_percent, 0.0, remesh_ns, kOtherStagesNs + remesh_ns, ""};
}

TEST(CriterionCurve, IsStraightInLogarithms) {
  const sim::StudyCurve curve{"six-edges",
                              {point(100, 1.0), point(140, 0.5), point(140, 0.5), point(3000, 0.1)}};
  const auto error_at = [&](double tets) { return sim::error_at(curve, tets, StudyError::kMeanMm); };
  EXPECT_NEAR(error_at(std::sqrt(100.0 * 140.0)), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(error_at(100), 1.0, 1e-12);
  EXPECT_NEAR(error_at(1000), 0.5, 1e-12);  // the next mesh is too far away
  EXPECT_NEAR(error_at(5000), 0.1, 1e-12);
  EXPECT_FALSE(std::isfinite(error_at(99)));
}

/// A perfect mesh does not outweigh everything else in a geometric mean.
TEST(CriterionCurve, SmallErrorsAreEquallyGood) {
  const sim::StudyCurve curve{"six-edges", {point(100, 1e-14, 1e-3), point(140, 1e-15, 0.9)}};
  EXPECT_NEAR(sim::error_at(curve, 120, StudyError::kMeanMm), 1e-3, 1e-12);
  EXPECT_NEAR(sim::error_at(curve, 120, StudyError::kForcePercent), 1.0, 1e-12);
}

/// A criterion of this many tets at a threshold, tried until the search ends.
std::vector<sim::StudyPoint> searched(const std::function<double(double)>& tets_at, double most_tets) {
  std::vector<sim::StudyPoint> points = {point(tets_at(1.0), 1.0), point(tets_at(0.01), 1.0)};
  points[0].threshold = 1.0;
  points[1].threshold = 0.01;
  constexpr int kManyMore = 60;
  for (int i = 0; i < kManyMore; ++i) {
    const double threshold = sim::next_threshold(points, most_tets);
    if (threshold == 0.0) return points;
    const auto place = std::find_if(points.begin(), points.end(),
                                    [&](const sim::StudyPoint& one) { return one.threshold < threshold; });
    points.insert(place, point(tets_at(threshold), 1.0))->threshold = threshold;
  }
  ADD_FAILURE() << "the search does not end";
  return points;
}

TEST(ThresholdSearch, FillsASmoothCurve) {
  const auto points = searched([](double threshold) { return 100.0 / threshold; }, 5000.0);
  for (std::size_t i = 1; i < points.size() && points[i - 1].tets < 5000.0; ++i)
    EXPECT_LE(points[i].tets, sim::kNearTets * points[i - 1].tets);
}

TEST(ThresholdSearch, NarrowsDownAJump) {
  const auto points = searched([](double threshold) { return threshold > 0.2 ? 144.0 : 900.0; }, 5000.0);
  const auto jump =
      std::find_if(points.begin(), points.end(), [](const sim::StudyPoint& one) { return one.tets > 144.0; });
  ASSERT_NE(jump, points.begin());
  EXPECT_LT((jump - 1)->threshold, 1.03 * jump->threshold);
  EXPECT_GT((jump - 1)->threshold, 0.2);
  EXPECT_LE(jump->threshold, 0.2);
}

TEST(ThresholdSearch, LeavesOutWhatIsNotJudged) {
  const auto points = searched([](double threshold) { return 100.0 / threshold; }, 90.0);
  EXPECT_EQ(points.size(), 2U);
}

struct Errors {
  double six, longest, jump, uniform;
};

/// Curves whose errors are the same everywhere.
sim::LoadStudy flat_study(const std::string& load, const Errors& mm, const Errors& percent = {}) {
  const auto flat = [&](const std::string& name, double Errors::*of) {
    sim::StudyCurve curve{name, {}};
    for (const double tets : {150, 400, 1000}) curve.points.push_back(point(tets, mm.*of, percent.*of));
    return curve;
  };
  return {load,
          6,
          percent.uniform > 0.0,
          {flat(sim::kUniformMesh, &Errors::uniform), flat("six-edges", &Errors::six),
           flat("longest-edge", &Errors::longest), flat("strain-jump", &Errors::jump)}};
}

/// Curves whose errors fall by this power of the tets, each with its time of the re-mesh stage.
sim::LoadStudy falling_study(const Errors& mm_at_1, double power, const Errors& remesh_ns) {
  const auto falling = [&](const std::string& name, double Errors::*of) {
    sim::StudyCurve curve{name, {}};
    for (double tets = 100.0; tets < 3000.0; tets *= 1.25)
      curve.points.push_back(point(tets, mm_at_1.*of * std::pow(tets, -power), 0.0, remesh_ns.*of));
    return curve;
  };
  return {"bend",
          6,
          false,
          {falling(sim::kUniformMesh, &Errors::uniform), falling("six-edges", &Errors::six),
           falling("longest-edge", &Errors::longest), falling("strain-jump", &Errors::jump)}};
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

TEST(CriterionRanking, IsByTheGeometricMeanOverAllLoads) {
  const std::vector<sim::LoadStudy> studies = {flat_study("bend", {0.1, 0.4, 0.2, 1.0}),
                                               flat_study("corner", {1.8, 0.8, 0.4, 2.0})};
  const auto order = sim::rank_all(studies, sim::Equal::kTets);
  ASSERT_EQ(order.size(), 4U);
  EXPECT_EQ(order[0].name, "strain-jump");
  EXPECT_NEAR(order[0].error, 0.2, 1e-9);
  EXPECT_EQ(order[1].name, "six-edges");
  EXPECT_NEAR(order[1].error, 0.3, 1e-9);
  EXPECT_EQ(order[3].name, sim::kUniformMesh);
  EXPECT_NEAR(order[3].error, 1.0, 1e-9);
  const auto bend = sim::rank(studies[0], StudyError::kMeanMm, sim::Equal::kTets).order;
  EXPECT_EQ(sim::best_criterion(bend).name, "six-edges");
}

TEST(CriterionRanking, ForcesCountAsMuchAsDisplacements) {
  const sim::LoadStudy study = flat_study("corner", {0.4, 0.4, 0.1, 1.0}, {4.0, 20.0, 64.0, 40.0});
  const auto order = sim::rank_all({study}, sim::Equal::kTets);
  EXPECT_EQ(order[0].name, "six-edges");
  EXPECT_NEAR(order[0].error, 0.2, 1e-9);
  EXPECT_NEAR(sim::error_of(order, "strain-jump").error, 0.4, 1e-9);
}

/// At equal times a criterion that takes as long again as all other stages has half the tets.
TEST(CriterionRanking, AtEqualTimesASlowCriterionHasFewerTets) {
  const sim::LoadStudy study = falling_study({10.0, 20.0, 10.0, 40.0}, 1.0, {0.0, 25.0, 100.0, 0.0});
  const auto tets = sim::rank_all({study}, sim::Equal::kTets);
  EXPECT_NEAR(sim::error_of(tets, "six-edges").error, 0.25, 1e-6);
  EXPECT_NEAR(sim::error_of(tets, "strain-jump").error, 0.25, 1e-6);
  const auto time = sim::rank_all({study}, sim::Equal::kTime);
  EXPECT_NEAR(sim::error_of(time, "six-edges").error, 0.25, 1e-6);
  EXPECT_NEAR(sim::error_of(time, "longest-edge").error, 0.5 * 1.25, 1e-6);
  EXPECT_NEAR(sim::error_of(time, "strain-jump").error, 0.25 * 2.0, 1e-6);
}

/// strain-jump is the best at equal tets and longest-edge at equal times; six-edges is near both.
TEST(CriterionRanking, TheLeastLossIsNearTheBestInBoth) {
  const auto losses = sim::losses_of({falling_study({11.0, 12.0, 10.0, 40.0}, 1.0, {10.0, 0.0, 100.0, 0.0})});
  ASSERT_EQ(losses.size(), 3U);
  EXPECT_EQ(losses[0].name, "six-edges");
  EXPECT_NEAR(losses[0].error, 1.1, 1e-6);
  EXPECT_EQ(losses[1].name, "longest-edge");
  EXPECT_NEAR(losses[1].error, 1.2, 1e-6);
  EXPECT_NEAR(losses[2].error, 20.0 / 12.0, 1e-6);
}

/// The sentence follows from the figures and from the default, whatever they are.
TEST(CriterionRanking, ConcludesFromWhatWasMeasured) {
  for (const std::string& best : std::vector<std::string>{"six-edges", "longest-edge", "strain-jump"}) {
    const auto mm = [&](const char* name) { return best == name ? 0.1 : 0.4; };
    const std::string text = sim::conclusion_of(
        {flat_study("bend", {mm("six-edges"), mm("longest-edge"), mm("strain-jump"), 1.0})});
    EXPECT_TRUE(contains(text, best + " 0 %")) << text;
    EXPECT_EQ(contains(text, "is NOT the one that loses least, which is " + best),
              best != sim::default_criterion())
        << text;
    EXPECT_FALSE(contains(text, "A uniform mesh")) << text;
  }
  const std::string text = sim::conclusion_of(
      {flat_study("bend", {0.1, 0.4, 0.2, 0.05}), flat_study("corner", {1.8, 0.8, 0.4, 2.0})});
  EXPECT_TRUE(contains(text, "A uniform mesh beats all three for bend to level 6, mm.")) << text;
}

TEST(CriterionRanking, ADefaultThatIsNearTheBestStays) {
  const auto text = [](double six) { return sim::conclusion_of({flat_study("bend", {six, 0.4, 0.2, 1.0})}); };
  ASSERT_EQ(sim::default_criterion(), "six-edges");
  EXPECT_FALSE(contains(text(0.209), "NOT"));
  EXPECT_TRUE(contains(text(0.211), "NOT"));
}

}  // namespace
}  // namespace palpate::test
