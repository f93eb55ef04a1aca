// The scenario whose hashes are golden: a PHANToM takes a node near the bar's free end, drags it about, lets
// go, takes it again and jumps, so that the clamps of speed and strain have work.
//
// It is written down as integers and does not come from the model compiler, because golden hashes must not
// depend on a host's doubles: a last bit of another libm would look like a change of the simulation. For the
// same reason the script is made here from a few poses, by the compiler and in integers.
#include "golden_scenario_image.hpp"

#include "palpate/remesh/stretch.hpp"

namespace palpate::firmware {
namespace {

constexpr golden::Discretization kMesh = golden::kDiscretization<golden::Profile>;

/// mu = E / (2 (1 + nu)) and lambda = E nu / ((1 + nu) (1 - 2 nu)) with nu = 0.49, for a region of E_ref /
/// softness.
constexpr Material make_material(int64_t softness) {
  constexpr int64_t kOnePlusNu = 149;
  constexpr int64_t kOneMinusTwoNu = 2;
  constexpr int64_t kNu = 49;
  return Material{ShearCoefficient::ratio(100, 12 * kOnePlusNu * softness),
                  BulkCoefficient::ratio(kNu * 100, 6 * kOnePlusNu * kOneMinusTwoNu * softness)};
}

constexpr Dynamics make_dynamics() {
  constexpr int64_t kSubsteps = kMesh.substeps;
  Dynamics dynamics{};
  dynamics.substeps = kMesh.substeps;
  dynamics.mass_damping = Q<-5, 36>::ratio(2, 1000 * kSubsteps);       // 2 / s
  dynamics.stiffness_damping = Q<0, 31>::ratio(50 * kSubsteps, 1000);  // 50 us
  dynamics.impulse_mantissa = Q<0, 31>::ratio(75, 128);                // dt^2 E edge / (kg a mass unit)
  dynamics.impulse_exponent = kMesh.impulse_exponent;
  return dynamics;
}

/// With both fronts on the move.
constexpr RemeshRules make_rules() {
  RemeshRules rules{};
  rules.rotation.criterion = RotationCriterion::kMisfit;
  rules.rotation.start_level = 0;
  rules.rotation.split_above = 2943556;  // 2 (1 - cos 1.5 deg) 2^32
  rules.rotation.join_below = 2126753;   // 2 (1 - cos 1.275 deg) 2^32
  rules.stretch.criterion = StretchCriterion::kSixEdges;
  rules.stretch.split_above = StretchMeasure::ratio(1236, 10000);  // 1.06^2 - 1
  rules.stretch.merge_below = StretchMeasure::ratio(609, 10000);   // 1.03^2 - 1
  for (LevelRange& levels : rules.stretch.levels) levels = LevelRange{kMesh.least_level, kMesh.most_level};
  return rules;
}

constexpr Model make_body() {
  Model body{};
  body.block = Block{{1, 1, 3}, {0, 0, 1}};
  body.level = kMesh.level;
  for (uint32_t i = 0; i < kRegions; ++i) {
    body.materials[i] = make_material(i == 1 ? 2 : 1);
    body.region_density[i] = i == 1 ? kDensityOne / 2 : kDensityOne;
  }
  body.dynamics = make_dynamics();
  body.remesh = make_rules();
  body.held[0] = LatticeBox{body.block.corner(0, 0, 0), body.block.corner(1, 1, 0)};
  body.held[1] = LatticeBox{{1, 1, 1}, {0, 0, 0}};
  body.grasp_reach = Position::ratio(1, 2);
  return body;
}

/// At zero counts the tool, at (0.215, 0, -0.170) m, is beside the node at (0.5, 0, 1) edges.
constexpr Scene make_scene() {
  Scene scene{};
  scene.edges_per_metre = EdgesPerMetre::ratio(1000, 64);
  scene.device_origin = {Position::ratio(-1820, 640), Position::ratio(0, 1), Position::ratio(2350, 640)};
  scene.newton_mantissa = Q<0, 31>::ratio(512, 1000);  // E edge^2 = 2.048 N = 0.512 2^2 N
  scene.newton_exponent = 2;
  return scene;
}

struct Pose {
  uint32_t tick;
  std::array<int16_t, 3> counts;
  bool grasps;
};

// From each pose to the next in a straight line of counts; 1613 counts of the turret are about 40 mm.
constexpr Pose kPoses[] = {
    {0, {0, 0, 0}, false},
    {100, {0, 0, 0}, true},
    {400, {-1613, 0, 0}, true},
    {800, {-1613, -700, -1300}, true},
    {1100, {-1613, -700, -1300}, true},
    {1500, {1600, 500, 600}, true},
    {1501, {1600, 500, 600}, false},
    {1800, {0, 0, 0}, false},
    {1900, {0, 0, 0}, true},
    {2100, {400, -800, 300}, true},
    {2101, {-1500, 200, -200}, true},
    {2400, {-1500, 200, -200}, true},
};
constexpr uint32_t kPoseCount = sizeof(kPoses) / sizeof(kPoses[0]);
constexpr uint32_t kTicks = kPoses[kPoseCount - 1].tick;

constexpr ScriptRow row_between(const Pose& from, const Pose& to, uint32_t tick) {
  ScriptRow row{};
  for (std::size_t joint = 0; joint < 3; ++joint) {
    const int32_t way = to.counts[joint] - from.counts[joint];
    const int32_t gone =
        way * static_cast<int32_t>(tick - from.tick) / static_cast<int32_t>(to.tick - from.tick);
    row.encoder_counts[joint] = static_cast<int16_t>(from.counts[joint] + gone);
  }
  row.buttons = from.grasps ? ScriptRow::kGraspButton : 0;
  return row;
}

constexpr std::array<ScriptRow, kTicks> make_rows() {
  std::array<ScriptRow, kTicks> rows{};
  uint32_t pose = 0;
  for (uint32_t tick = 0; tick < kTicks; ++tick) {
    if (tick == kPoses[pose + 1].tick) ++pose;
    rows[tick] = row_between(kPoses[pose], kPoses[pose + 1], tick);
  }
  return rows;
}

constexpr std::array<ScriptRow, kTicks> kRows = make_rows();

}  // namespace

const ScenarioImage kScenarioImage = {"golden", {make_body(), make_scene()}, kRows.data(), kTicks};

}  // namespace palpate::firmware
