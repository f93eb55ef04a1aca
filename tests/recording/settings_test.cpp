// Settings: each number changes its own threshold and nothing else, to values that are usable.
#include "palpate/firmware/settings.hpp"

#include <set>

#include "compiled_stages.hpp"
#include "recording/setting_table.hpp"
#include "support/recordings.hpp"

namespace palpate::test {
namespace {

using firmware::change_setting;
using firmware::kSettings;

std::unique_ptr<firmware::CycleState<Small>> started() {
  auto state = std::make_unique<firmware::CycleState<Small>>();
  EXPECT_EQ(firmware::start(*state, dragged_bar()), Status::kDone);
  return state;
}

/// Parameters, then the fronts' thresholds, as 32-bit words and in their order.
File settings_bytes(const firmware::CycleState<Small>& state) {
  MemorySink sink;
  ChunkWriter<MemorySink> writer(sink);
  container::FieldWriter<MemorySink> fields(writer);
  writer.begin(Kind::kRecording);
  writer.begin_chunk(Tag::of("TEST"), 1, 0, firmware::safety_fields::kThresholdBytes + 16);
  firmware::all_settings(fields, state.safety.parameters, state.core.model.remesh);
  writer.end_chunk();
  EXPECT_EQ(writer.end(), WriteStatus::kDone);
  return File(sink.file.begin() + 32, sink.file.begin() + 32 + firmware::safety_fields::kThresholdBytes + 16);
}

TEST(Settings, HaveNamesUpToTheirLast) {
  EXPECT_EQ(firmware::setting_name(0), nullptr);
  EXPECT_EQ(firmware::setting_name(kSettings + 1), nullptr);
  std::set<std::string> names;
  for (uint16_t setting = 1; setting <= kSettings; ++setting) {
    ASSERT_NE(firmware::setting_name(setting), nullptr);
    names.insert(firmware::setting_name(setting));
  }
  EXPECT_EQ(names.size(), kSettings);
}

/// A value near the present one: one field has other bytes afterwards, at a place above those before.
TEST(Settings, ChangeTheirOwnThresholdOnly) {
  std::size_t last_place = 0;
  for (uint16_t setting = 1; setting <= kSettings; ++setting) {
    SCOPED_TRACE(firmware::setting_name(setting));
    const auto state = started();
    const File before = settings_bytes(*state);
    // Within the range of a u16 too, and usable for each: those that must stay in order stay near theirs.
    int32_t value = 5;
    if (setting >= 13 && setting <= 16) value = safety::Celsius::ratio(setting == 16 ? 101 : 70, 1).raw();
    if (setting == 13) value = safety::Celsius::ratio(26, 1).raw();
    if (setting == 15) value = safety::Celsius::ratio(60, 1).raw();
    if (setting == 17) value = safety::Ampere::ratio(6, 1).raw();
    if (setting == 21) value = -1;  // of 32 bits without a sign
    if (setting == 23) value = Q<4, 27>::ratio(1, 1).raw();
    ASSERT_TRUE(change_setting(*state, {setting, value}));
    const File after = settings_bytes(*state);
    std::size_t first = 0;
    while (first < before.size() && before[first] == after[first]) ++first;
    std::size_t last = before.size();
    while (last > first && before[last - 1] == after[last - 1]) --last;
    ASSERT_LT(first, last);
    EXPECT_LE(last - first, 4u);
    EXPECT_GE(first, last_place);
    last_place = last;
  }
}

TEST(Settings, RefuseWhatIsNotUsable) {
  const auto state = started();
  const File before = settings_bytes(*state);
  const firmware::SettingChange refused[] = {
      {0, 1},
      {kSettings + 1, 1},
      {1, 0},                                     // a ramp that never rises
      {1, INT32_MAX},                             // above the whole force
      {3, 65536},                                 // above 16 bits
      {4, -1},                                    // no force
      {10, 0},                                    // always stuck
      {13, safety::Celsius::ratio(90, 1).raw()},  // an ambient above warm
      {18, safety::Ampere::ratio(7, 1).raw()},    // continuous above peak
      {22, -1},                                   // joined above where it is split
      {24, Q<4, 27>::ratio(8, 1).raw()}};
  for (const firmware::SettingChange& change : refused) {
    EXPECT_FALSE(change_setting(*state, change)) << change.setting << " " << change.value;
    EXPECT_EQ(settings_bytes(*state), before);
  }
}

TEST(Settings, HaveValuesInTheirUnits) {
  EXPECT_EQ(recording::value_of({4, phantom::Newton::ratio(5, 2).raw()}), 2.5);
  EXPECT_EQ(recording::value_of({10, 700}), 700.0);
  EXPECT_EQ(recording::value_of({14, safety::Celsius::ratio(70, 1).raw()}), 70.0);
  EXPECT_EQ(recording::value_of({21, -1}), 4294967295.0);
  EXPECT_EQ(recording::value_of({kSettings + 1, 7}), 0.0);
  for (uint16_t setting = 1; setting <= kSettings; ++setting) {
    const firmware::SettingChange change{setting, 12345};
    EXPECT_STREQ(recording::setting_table()[setting - 1u].name, firmware::setting_name(setting));
    EXPECT_EQ(recording::change_to(setting, recording::value_of(change)).value, change.value);
  }
  EXPECT_EQ(recording::change_to(21, 4294967295.0).value, -1);
}

/// A change enters with the sensors, and holds from this tick on.
TEST(Settings, ChangeInTheCycle) {
  const auto state = started();
  const auto cycle = [&state](const firmware::SettingChange& change) {
    firmware::Sensors sensors{};
    sensors.report.change = change;
    firmware::Actuators actuators{};
    firmware::NoProbe probe;
    firmware::cycle(*state, sensors, actuators, probe);
  };
  const auto limit = phantom::Newton::ratio(5, 2);
  cycle({4, limit.raw()});
  EXPECT_FALSE(state->is_setting_refused);
  EXPECT_EQ(state->safety.parameters.force.max_newtons, limit);
  cycle({4, -1});
  EXPECT_TRUE(state->is_setting_refused);
  EXPECT_EQ(state->safety.parameters.force.max_newtons, limit);
  cycle({0, 0});
  EXPECT_FALSE(state->is_setting_refused);
  firmware::refuse_model(*state);
  const File before = settings_bytes(*state);
  cycle({4, limit.raw()});
  EXPECT_TRUE(state->is_setting_refused);
  EXPECT_EQ(settings_bytes(*state), before);
}

}  // namespace
}  // namespace palpate::test
