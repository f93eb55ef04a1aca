// Settings that change on the way of `hil touch`.
#include "hil/setting_plan.hpp"

#include <gtest/gtest.h>

#include "hil/plant_simulation.hpp"
#include "palpate/firmware/settings.hpp"
#include "recording/inspection.hpp"
#include "recording/mapped_file.hpp"
#include "scenario/errors.hpp"
#include "support/temporary_folder.hpp"
#include "telling_board.hpp"

namespace palpate::sim {
namespace {

TEST(SettingPlan, HasTicksAndRawValues) {
  const auto changes =
      planned_changes(small_touch("3: max force = 2.5;  40 :stuck ticks=7; 41: rotation split above = 4e9"));
  ASSERT_EQ(changes.size(), 3u);
  EXPECT_EQ(changes[0].tick, 3u);
  EXPECT_STREQ(firmware::setting_name(changes[0].change.setting), "max force");
  EXPECT_EQ(changes[0].change.value, phantom::Newton::ratio(5, 2).raw());
  EXPECT_EQ(changes[1].tick, 40u);
  EXPECT_STREQ(firmware::setting_name(changes[1].change.setting), "stuck ticks");
  EXPECT_EQ(changes[1].change.value, 7);
  EXPECT_EQ(static_cast<uint32_t>(changes[2].change.value), 4000000000u);
  EXPECT_TRUE(planned_changes(small_touch("")).empty());
}

struct Refused {
  const char* settings;
  const char* message;  // a part of it
};

TEST(SettingPlan, RefusesWhatTheFirmwareWould) {
  const Refused cases[] = {
      {"max force = 2", "a tick, a colon and NAME = VALUE"},
      {"3: max force", "NAME = VALUE behind the colon"},
      {"soon: max force = 2", "'soon' is no number of a tick"},
      {"3: max force = much", "'much' is no number"},
      {"3: most force = 2", "'most force' is no setting; they are ramp step, contact force"},
      {"3: max force = -1", "7.45058e-09 .. 16"},
      {"3: max force = nan", "7.45058e-09 .. 16"},
      {"3: stuck ticks = 1.5", "a whole number"},
      {"3: stuck ticks = 70000", "1 .. 65535"},
      {"3: ambient = 90", "contradicts the other settings"},
      {"0: max force = 2", "the tick must be above 0"},
      {"3: max force = 2; 3: warm = 70", "in '3: warm = 70' the tick must be above 3"},
      {"3: max force = 2;", "in '' there must be a tick"},
  };
  for (const Refused& one : cases) {
    try {
      (void)planned_changes(small_touch(one.settings));
      ADD_FAILURE() << one.settings;
    } catch (const BadInput& refusal) {
      EXPECT_NE(std::string(refusal.what()).find(one.message), std::string::npos) << refusal.what();
    }
  }
}

/// A lower limit that the hand's press passes drops the amplifiers; and the run is had again from its record.
TEST(SettingPlan, ChangesTheRun) {
  const test::TemporaryFolder folder;
  const auto driven_ticks = [&folder](const std::string& settings) {
    Scenario scenario = small_touch(settings);
    scenario.ticks = 3400;
    scenario.record = (folder / "recording").string();
    uint32_t ticks = 0;
    const auto simulation = make_plant_simulation(
        scenario, [&](const ClosedLoop& loop) { ticks += loop.answer().is_amplifier_enabled[0] ? 1u : 0u; });
    while (simulation->advance()) {
    }
    simulation->end();
    return ticks;
  };
  const uint32_t usual = driven_ticks("");
  EXPECT_LT(driven_ticks("2000: max force = 0.1"), usual);
  const recording::MappedFile file((folder / "recording").string());
  EXPECT_EQ(replayed_ticks(file.bytes()), 3400u);
  EXPECT_EQ(recording::inspect(file.bytes()).change_count, 1u);
}

}  // namespace
}  // namespace palpate::sim
