// Wrong input: exit code 2, one line that says what would be right, nothing written.
#include "program.hpp"

namespace palpate::test {
namespace {

struct Case {
  const char* name;
  const char* arguments;
  const char* message;  // a part of it
};

std::ostream& operator<<(std::ostream& stream, const Case& one) { return stream << one.name; }

class BadFlag : public testing::TestWithParam<Case> {};

TEST_P(BadFlag, IsRefusedWithOneLine) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(folder, GetParam().arguments);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  expect_one_line(outcome.err);
  EXPECT_NE(outcome.err.find(GetParam().message), std::string::npos) << outcome.err;
  EXPECT_TRUE(folder.contents().empty());
}

constexpr Case kFlags[] = {
    {"NoCommand", "", "compare, hil, inspect, model, paper, record, replay, run and table1"},
    {"UnknownCommand", "frobnicate", "there is no command 'frobnicate'"},
    {"UnknownScenario", "run cuboid", "choose cuboid-bend, cuboid-sine, grasp"},
    {"NoScenario", "run", "scenario is required"},
    {"DeviceScenarioInRun", "run grasp", "use palpate hil grasp"},
    {"ToolScenarioInHil", "hil cuboid-sine", "use palpate run cuboid-sine"},
    {"UnknownFlag", "run cuboid-sine --stiffness 3", "it takes --help, --youngs-modulus-pa"},
    {"FlagOfAnotherScenario", "run cuboid-bend --slow 2", "cuboid-bend has no --slow"},
    {"FlagWithoutValue", "run cuboid-sine --level", "--level"},
    {"FlagTwice", "run cuboid-sine --level 3 --level 4", "--level"},
    {"NotANumber", "run cuboid-sine --density-kg-m3 heavy", "10 .. 2000 kg/m3"},
    {"NotWhole", "run cuboid-sine --level 4.5", "a whole number, 0 .. 14"},
    {"TextAfterNumber", "run cuboid-sine --density-kg-m3 10kg", "10 .. 2000 kg/m3"},
    {"Nan", "run cuboid-sine --poisson-ratio nan", "0 .. 0.495"},
    {"Infinite", "run cuboid-sine --youngs-modulus-pa inf", "100 .. 1e+06 Pa"},
    {"TooLargeForDouble", "run cuboid-sine --amplitude-mm 1e999", "0 .. 200 mm"},
    {"TooLargeForInt", "run cuboid-sine --ticks 99999999999", "a whole number"},
    {"OutOfRange", "run cuboid-sine --poisson-ratio 0.5", "0 .. 0.495"},
    {"Negative", "run cuboid-sine --substeps -1", "1 .. 8"},
    {"TwoNumbersOfThree", "run cuboid-sine --node 1,2", "three numbers"},
    {"BlankInsideANumber", "run cuboid-sine --node '1 2,3,4'", "three numbers"},
    {"UnknownChoice", "run cuboid-sine --hold left", "one, both, none"},
    {"UnknownProfile", "run cuboid-sine --profile huge",
     "cuboid-paper, cuboid-dense, organ, small, tiny, workstation"},
    {"UnknownBoard", "hil grasp --board moon", "must be host"},
    {"LevelOverCapacity", "run cuboid-sine --level 9", "take level 6 or less"},
    {"MostLevelOverTheProfiles", "run cuboid-sine --most-level 9",
     "most_level is 9, but profile cuboid-paper goes down to level 6: take most_level 6 or less"},
    {"MostLevelBelowTheLeast", "run cuboid-sine --least-level 5 --most-level 3",
     "most_level is 3, but least_level is 5: it must be 5 or more"},
    {"StartBelowTheLeastLevel", "run cuboid-sine --level 3 --least-level 4 --most-level 5",
     "level is 3, but least_level is 4: it must be 4 or more"},
    {"StartAboveTheMostLevel", "run cuboid-sine --level 5 --most-level 4",
     "level is 5, but most_level is 4: it must be 4 or less"},
    {"TooManySubsteps", "hil grasp --substeps 4", "computes at most 3 a tick: take substeps 3 or less"},
    {"CriterionThatIsNotBuilt", "run cuboid-sine --rotations siblings",
     "take rotations misfit, or profile workstation"},
    {"AutomaticLevelBelowTheLeast", "run cuboid-sine --profile small --density-kg-m3 1000 --least-level 5",
     "level is 4, but least_level is 5"},
    {"UnstableAtTheMostLevel", "run cuboid-sine --profile workstation --most-level 9",
     "its critical step at most_level 9 is 0.200 ms; it needs 6 substeps"},
    {"NoSubstepsForTheMostLevel", "run cuboid-sine --profile workstation --most-level 12",
     "take a coarser most_level"},
    {"TooManyCubes", "model grasp --cubes 4,4,4 --profile small", "take a larger profile"},
    {"UnstableStep", "run cuboid-sine --substeps 1", "needs 3 substeps"},
    {"NoNodeThere", "run cuboid-sine --node 500,0,0", "the block fills (0, 0, 0) to (64, 64, 192) mm"},
    {"DrivenNodeIsHeld", "run cuboid-sine --node 0,0,0", "on a held face"},
    {"BendWithAFreeEnd", "run cuboid-bend --hold one", "it must be both"},
    {"OutOfTheArmsReach", "hil grasp --body-centre-in-device-m 0.25,0.25,0.2", "out of the arm's reach"},
    {"TooNearToAJointLimit", "hil grasp --body-centre-in-device-m 0.05,0,-0.1", "from a joint's limit"},
    {"NoDeviceForTheFirmware", "model cuboid-sine --firmware-image image.cpp",
     "a firmware image needs grasp"},
    {"EmptyPath", "run cuboid-sine --out ''", "a path"},
    {"OutIsNoFolder", "run cuboid-sine --out /dev/null", "is not a folder"},
    {"PaperIntoAFile", "paper --quick --out /dev/null", "is not a folder"},
    {"PaperUnknownFlag", "paper --quicker", "it takes --help, --out, --quick"},
    {"TwistOutOfRange", "run cuboid-bend --twist 181", "0 .. 180 deg"},
    {"Table1AngleOutOfRange", "table1 --angle 181", "0 .. 180 deg"},
    {"Table1NegativeTwist", "table1 --twist=-1", "0 .. 180 deg"},
    {"Table1AngleAndTwist", "table1 --angle 90 --twist 0", "--angle or --twist, not both"},
    {"Table1EmptyPath", "table1 --out ''", "a path"},
    {"Table1UnknownFlag", "table1 --level 3", "it takes --help, --angle, --twist, --out"},
    {"Table1OutIsNoFolder", "table1 --quick --out /dev/null", "is not a folder"},
    {"CompareOne", "compare a", "B is required"},
    {"CompareNoFolder", "compare a b", "'a' is not a folder"},
    {"CompareNoRun", "compare / /", "no run"},
};

std::string name_of(const testing::TestParamInfo<Case>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Flags, BadFlag, testing::ValuesIn(kFlags), name_of);

/// `arguments` is the file's text here.
class BadFile : public testing::TestWithParam<Case> {};

TEST_P(BadFile, IsRefusedWithItsPlace) {
  const TemporaryFolder folder;
  write_text(folder / "bar.toml", GetParam().arguments);
  const Outcome outcome = run_program(folder, "hil bar.toml");
  EXPECT_EQ(outcome.exit_code, 2);
  expect_one_line(outcome.err);
  EXPECT_NE(outcome.err.find(GetParam().message), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.contents(), std::vector<std::string>{"bar.toml"});
}

constexpr Case kFiles[] = {
    {"Syntax", "scenario = 'grasp'\nlevel = = 6\n", "bar.toml:2:9: "},
    {"NoScenario", "level = 6\n", "one of cuboid-bend, cuboid-sine, grasp"},
    {"UnknownScenario", "scenario = 'liver'\n", "no scenario is called 'liver'"},
    {"UnknownKey", "scenario = 'grasp'\nlevl = 6\n", "bar.toml:2:1: grasp has no key 'levl'; its keys are"},
    {"KeyOfAnotherScenario", "scenario = 'grasp'\nslow = 6\n", "bar.toml:2:1: grasp has no key 'slow'"},
    {"NumberAsText", "scenario = 'grasp'\nlevel = '6'\n", "bar.toml:2:1: level is text"},
    {"Nan", "scenario = 'grasp'\n\ndensity_kg_m3 = nan\n", "bar.toml:3:1: density_kg_m3 is 'nan'"},
    {"OutOfRange", "scenario = 'grasp'\nlevel = 60\n", "bar.toml:2:1: level is '60'"},
    {"TableAsValue", "scenario = 'grasp'\n[level]\na = 1\n", "level must be"},
    {"UnknownRegionKey", "scenario = 'grasp'\n[[region]]\ncolour = 1\n",
     "bar.toml:3:1: a [[region]] has no key"},
    {"RegionIsNoTable", "scenario = 'grasp'\nregion = 3\n", "[[region]] tables"},
    {"LevelsOfARegion",
     "scenario = 'grasp'\nregion_of_cube = [0, 1, 0]\n[[region]]\n[[region]]\nmost_level = 2\nleast_level = "
     "4\n",
     "region 1: most_level is 2, but least_level is 4"},
    {"StartOutsideTheLevelsOfARegion",
     "scenario = 'grasp'\nlevel = 5\nregion_of_cube = [0, 1, 0]\n[[region]]\n[[region]]\nmost_level = 4\n",
     "region 1: level is 5, but most_level is 4"},
    {"MostLevelOfARegionOverTheProfiles",
     "scenario = 'grasp'\nregion_of_cube = [0, 1, 0]\n[[region]]\n[[region]]\nmost_level = 7\n",
     "region 1: most_level is 7, but profile cuboid-paper goes down to level 6"},
    {"RegionsMissing", "scenario = 'grasp'\nregion_of_cube = [0, 1, 0]\n",
     "an entry of region_of_cube is 1, but must be -1 to 0"},
    {"CubesMissing", "scenario = 'grasp'\nregion_of_cube = [0, 0]\n", "the block has 3 cubes"},
};

INSTANTIATE_TEST_SUITE_P(Files, BadFile, testing::ValuesIn(kFiles), name_of);

TEST(BadFileName, IsRefused) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(folder, "hil bar.toml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("cannot read 'bar.toml': No such file"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace palpate::test
