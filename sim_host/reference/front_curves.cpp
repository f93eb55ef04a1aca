// Error against the number of groups for each criterion and for the searched near-optimum, as CSV: the
// paper's bar bent by 90 degrees, pressed in by 20 mm, or with its corner driven by 50 mm.
#include <cstdio>
#include <cstring>
#include <memory>

#include "palpate/mesh/make_forest.hpp"
#include "reference/front_search.hpp"
#include "reference/rotation_criterion.hpp"

namespace palpate::reference {
namespace {

constexpr double kEdgeM = 0.064;
constexpr double kQuarterTurn = 1.5707963267948966;
constexpr uint32_t kMostGroups = 1100;
constexpr int kPolishRounds = 150;
/// The paper's counts and some between.
constexpr uint32_t kSearchedCounts[] = {18,  32,  48,  72,  100, 150, 200, 250,
                                        300, 400, 500, 578, 696, 800, 908, 1072};

struct BarProfile {
  static constexpr uint16_t kLeaves = 1152;
  static constexpr uint16_t kNodes = 512;
  static constexpr uint8_t kMaxLevel = 6;
};

BisectionTree bar_tree() {
  const auto forest = std::make_unique<Forest<BarProfile>>();
  Block block{};
  for (uint8_t& region : block.region) region = Block::kAbsent;
  block.cubes[0] = block.cubes[1] = 1;
  block.cubes[2] = 3;
  for (uint32_t i = 0; i < block.cube_count(); ++i) block.region[i] = 0;
  const std::array<uint16_t, kRegions> density = {2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048};
  if (make_roots(*forest, block, density) != MeshStatus::kDone) return {};
  if (refine_uniformly(*forest, 6) != MeshStatus::kDone) return {};
  return tree_of(*forest, kEdgeM);
}

struct Case {
  const char* name;
  StaticProblem problem;
  uint32_t driven;  // the node whose reaction is reported, or kNoTet
};

std::vector<Case> cases_of(const Mesh& mesh) {
  const Material material = material_of(500.0, 0.49, 10.0);
  const uint32_t corner = node_nearest(mesh, upper_corner(mesh));
  const uint32_t middle = node_nearest(mesh, Vector(upper_corner(mesh)[0], 0, 0));
  return {{"bend", bend_problem(mesh, material, kQuarterTurn, BendFrame::kHeldEnd), kNoTet},
          {"indentation", indentation_problem(mesh, material, 0.02), middle},
          {"corner", corner_problem(mesh, material, 0.05), corner}};
}

class Writer {
 public:
  Writer(const Case& of, const AdaptiveCorotation& body) : case_(of), full_(body.full().force) {}

  void write(const char* method, uint32_t count, const Distance& error,
             const std::vector<Vector>& force) const {
    const double reaction =
        case_.driven == kNoTet ? 0.0 : 1e3 * (force[case_.driven] - full_[case_.driven]).norm();
    std::printf("%s,%s,%u,%.6f,%.6f,%.4f\n", case_.name, method, count, error.mean_mm, error.max_mm,
                reaction);
  }

 private:
  const Case& case_;
  const std::vector<Vector>& full_;
};

struct Method {
  const char* name;
  Criterion criterion;
  Closure closure;
  RotationSource source;
};

constexpr Method kMethods[] = {
    {"neighbours", Criterion::kNeighbours, Closure::kNone, RotationSource::kOwnNodes},
    {"siblings_conforming", Criterion::kSiblings, Closure::kConforming, RotationSource::kOwnNodes},
    {"skew", Criterion::kSkew, Closure::kNone, RotationSource::kOwnNodes},
    {"skew_mean", Criterion::kSkew, Closure::kNone, RotationSource::kMeanGradient},
    {"remaining_rotation_conforming", Criterion::kRemainingRotation, Closure::kConforming,
     RotationSource::kMeanGradient},
    {"remaining_rotation", Criterion::kRemainingRotation, Closure::kNone, RotationSource::kMeanGradient}};

void write_curves(const BisectionTree& tree, const Case& of) {
  for (const Method& method : kMethods) {
    AdaptiveCorotation body(tree, of.problem, method.source);
    const Writer writer(of, body);
    for (const FrontPoint& point : refine_worst_first(body, method.criterion, method.closure, kMostGroups)) {
      writer.write(method.name, point.front.count(), point.error, point.force);
    }
  }
}

/// Three ways to each count: merged from full corotation, and grown from the last count's and from the
/// criterion's. The best one is written.
void write_searched(const BisectionTree& tree, const Case& of) {
  AdaptiveCorotation body(tree, of.problem, RotationSource::kMeanGradient);
  const Writer writer(of, body);
  const std::vector<Front> merged = search_fronts(body);
  const std::vector<FrontPoint> curve =
      refine_worst_first(body, Criterion::kRemainingRotation, Closure::kNone, kMostGroups);
  Front best(tree);
  for (const uint32_t count : kSearchedCounts) {
    double least_mm = 1e300;
    for (Front front : {best, point_at(curve, count).front, merged[tree.mesh.tet.size() - count]}) {
      grow(body, front, count);
      polish(body, front, kPolishRounds);
      if (body.error().mean_mm >= least_mm) continue;
      least_mm = body.error().mean_mm;
      best = front;
    }
    if (body.settle(best)) writer.write("searched", count, body.error(), body.force());
  }
}

}  // namespace
}  // namespace palpate::reference

/// Arguments: the cases to compute, all if none.
int main(int argc, char** argv) {
  using palpate::reference::Case;
  const palpate::reference::BisectionTree tree = palpate::reference::bar_tree();
  const std::vector<Case> cases = palpate::reference::cases_of(tree.mesh);
  std::vector<const Case*> wanted;
  for (const Case& of : cases) {
    bool is_wanted = argc == 1;
    for (int i = 1; i < argc; ++i) is_wanted = is_wanted || std::strcmp(argv[i], of.name) == 0;
    if (is_wanted) wanted.push_back(&of);
  }
  if (wanted.empty()) {
    std::fprintf(stderr, "palpate_front_curves: no such case; there are bend, indentation, corner\n");
    return 2;
  }
  std::printf("case,method,rotation_tets,mean_error_mm,max_error_mm,reaction_error_mN\n");
  for (const Case* of : wanted) {
    palpate::reference::write_curves(tree, *of);
    palpate::reference::write_searched(tree, *of);
  }
  return 0;
}
