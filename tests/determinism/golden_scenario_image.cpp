// The scenario whose hashes are golden: a PHANToM takes a node near the bar's free end, drags it about, lets
// go, takes it again and jumps, so that the clamps of speed and strain have work. The script is made here
// from a few poses, by the compiler and in integers.
#include "golden_body.hpp"

#include <type_traits>

namespace palpate {
namespace golden {

// 144 leaves at start in Small, 288 in the others. Small has one substep, so its bar is heavier.
constexpr Discretization kDiscretization = std::is_same_v<Profile, Small>
                                               ? Discretization{3, 2, 4, 1, 80, Q<0, 31>::ratio(75, 128), 22}
                                               : Discretization{4, 3, 6, 3, 20, Q<0, 31>::ratio(25, 48), 21};

}  // namespace golden

namespace firmware {
namespace {

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

const ScenarioImage kScenarioImage = {
    "golden", {golden::make_body(golden::kDiscretization), golden::make_scene()}, kRows.data(), kTicks};

}  // namespace firmware
}  // namespace palpate
