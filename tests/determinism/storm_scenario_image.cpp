// The storm: a bar as heavy as tissue at level 3, free to be refined until its pools are full, and a hand
// that does its worst.
#include "golden_body.hpp"
#include "storm.hpp"

namespace palpate {
namespace golden {

// 144 leaves at start.
constexpr Discretization kDiscretization = {3, 2, 6, 1, 1000, Q<0, 31>::ratio(3, 4), 18};

}  // namespace golden

namespace firmware {
namespace {

constexpr std::array<ScriptRow, golden::kStormTicks> make_rows() {
  std::array<ScriptRow, golden::kStormTicks> rows{};
  golden::StormHand hand(golden::kStormSeed);
  for (ScriptRow& row : rows) row = hand.next();
  return rows;
}

constexpr std::array<ScriptRow, golden::kStormTicks> kRows = make_rows();

}  // namespace

const ScenarioImage kScenarioImage = {"storm",
                                      {golden::make_body(golden::kDiscretization), golden::make_scene()},
                                      kRows.data(),
                                      golden::kStormTicks};

}  // namespace firmware
}  // namespace palpate
