// Every built-in scenario's model goes through a container and moves as before, bit by bit; the program
// writes such files and refuses what it cannot write.
#include "program/model_container.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>

#include "compiled_stages.hpp"
#include "program.hpp"
#include "scenario/grasp_script.hpp"
#include "simulation/capacity.hpp"
#include "support/models.hpp"

namespace palpate::test {
namespace {

constexpr uint32_t kTicks = 200;

sim::Scenario complete(const std::string& name, const std::string& profile) {
  sim::Scenario scenario = sim::built_in_scenario(name);
  scenario.profile = profile;
  if (profile == Small::kName) {
    // One substep a tick is stable.
    for (sim::RegionParameters& region : scenario.model.regions) region.density_kg_m3 = 2000.0;
  }
  sim::complete_scenario(scenario);
  sim::fit_to_profile(scenario);
  return scenario;
}

/// A pull at the corner that is nearest to the far end, and a turn of the held ends.
TickInput input_at(uint32_t tick, const Model& model) {
  const LatticePoint corner = model.block.corner(0, 0, model.block.cubes[2]);
  TickInput input{rest_position(corner), true, {RigidMotion::identity(), RigidMotion::identity()}};
  input.tool[1] += Position::from_raw(static_cast<int32_t>(tick) << 16);
  input.hold_motion[1].translation[0] = Position::from_raw(static_cast<int32_t>(tick) << 15);
  return input;
}

/// After 200 ticks of the core, and after 200 cycles with the encoders of a script.
template <class Profile>
std::vector<uint64_t> hashes_of(const CycleModel& model, const std::vector<firmware::ScriptRow>& rows) {
  const auto state = std::make_unique<firmware::CycleState<Profile>>();
  EXPECT_EQ(firmware::start(*state, model), Status::kDone);
  struct Blind {
    void enter(CoreStage) {}
    void leave(CoreStage) {}
  } blind;
  for (uint32_t i = 0; i < kTicks; ++i) tick(state->core, input_at(i, model.body), state->output, blind);
  std::vector<uint64_t> hashes = {state_hash(state->core, state->output)};
  EXPECT_TRUE(state->core.grasp.holds());

  EXPECT_EQ(firmware::start(*state, model), Status::kDone);
  firmware::NoProbe probe;
  for (const firmware::ScriptRow& row : rows) {
    const auto& counts = row.encoder_counts;
    firmware::Actuators actuators{};
    firmware::cycle(*state, {{counts[0], counts[1], counts[2]}, row.buttons != 0}, actuators, probe);
  }
  hashes.push_back(firmware::state_hash(*state));
  return hashes;
}

/// 200 rows of the grasp around the press of its button.
std::vector<firmware::ScriptRow> some_rows() {
  const auto rows = sim::grasp_script(complete("grasp", "cuboid-paper"));
  std::size_t pressed = 0;
  while (rows[pressed].buttons == 0) ++pressed;
  const auto first = rows.begin() + static_cast<std::ptrdiff_t>(pressed) - 20;
  return {first, first + kTicks};
}

CycleModel read_back(const sim::Scenario& scenario, uint8_t deepest) {
  const std::string file = sim::model_container(scenario);
  CycleModel model{};
  EXPECT_TRUE(firmware::read_model(bytes_of(file), deepest, model).is_done());
  return model;
}

template <class Profile>
void expect_motion_as_before() {
  const auto rows = some_rows();
  for (const std::string& name : sim::scenario_names()) {
    SCOPED_TRACE(name + " in " + Profile::kName);
    const sim::Scenario scenario = complete(name, Profile::kName);
    const CycleModel model = sim::cycle_model(scenario);
    const CycleModel read = read_back(scenario, Profile::kMaxLevel);
    expect_same(read, model);
    EXPECT_EQ(hashes_of<Profile>(read, rows), hashes_of<Profile>(model, rows));
  }
}

TEST(ModelContainerOfScenario, MovesAsBefore) { expect_motion_as_before<CuboidPaper>(); }
TEST(ModelContainerOfScenario, MovesAsBeforeOnASmallTarget) { expect_motion_as_before<Small>(); }

/// The comparison above would see another model.
TEST(ModelContainerOfScenario, AnotherModelMovesOtherwise) {
  const auto rows = some_rows();
  const CycleModel model = sim::cycle_model(complete("grasp", "small"));
  CycleModel other = model;
  other.body.materials[0].shear += ShearCoefficient::from_raw(1 << 16);
  other.scene.device_origin[0] += Position::from_raw(1);
  const auto hashes = hashes_of<Small>(model, rows);
  const auto other_hashes = hashes_of<Small>(other, rows);
  EXPECT_NE(hashes[0], other_hashes[0]);
  EXPECT_NE(hashes[1], other_hashes[1]);
}

TEST(ModelContainerOfScenario, IsWrittenByTheProgram) {
  const TemporaryFolder folder;
  for (const std::string& name : sim::scenario_names()) {
    const Outcome outcome = run_program(folder, fmt::format("model {0} --container {0}", name));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(read_text(folder / name), sim::model_container(complete(name, "cuboid-paper")));
  }
}

TEST(ModelContainerOfScenario, IsWrittenBesideTheImage) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(folder, "model grasp --container c --firmware-image i");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(folder.contents(), (std::vector<std::string>{"c", "i"}));
}

TEST(ModelContainerOfScenario, NeedsRoomOnTheDisk) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(folder, "model grasp --container /dev/full");
  EXPECT_EQ(outcome.exit_code, 3);
  expect_one_line(outcome.err);
  EXPECT_NE(outcome.err.find("No space left"), std::string::npos) << outcome.err;
}

/// The place, what was expected, what was found.
TEST(ModelContainerOfScenario, IsRefusedInWords) {
  std::string text = sim::model_container(complete("grasp", "small"));
  File file(text.begin(), text.end());
  file[64] ^= 1;
  const std::string damage = sim::describe(refusal_of(file));
  EXPECT_EQ(damage.rfind("at byte 48 in chunk BLCK: chunk damaged: expected ", 0), 0u) << damage;
  file[64] ^= 1;
  file.resize(100);
  EXPECT_EQ(sim::describe(refusal_of(file)), "at byte 48 in chunk BLCK: cut off: expected 88, found 52");
  CycleModel model = sample_model();
  model.body.level = 15;
  EXPECT_EQ(sim::describe(refusal_of(model_file(model), 6)),
            "at byte 67 in chunk BLCK: out of range: level: expected 0 to 6, found 15");
  EXPECT_EQ(sim::describe(refusal_of(File{'x'})), "at byte 0: not a container: expected 137, found 120");
}

}  // namespace
}  // namespace palpate::test
