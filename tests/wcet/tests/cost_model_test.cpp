#include "../cost_model.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "../refusal.hpp"
#include "support/temporary_folder.hpp"

namespace palpate::wcet::test {
namespace {

std::string text_of(const std::string& name) {
  std::ifstream file(std::string(PALPATE_SOURCE_FOLDER) + "/tests/wcet/models/" + name + ".toml");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string refusal_of_model(const std::string& text) {
  const palpate::test::TemporaryFolder folder;
  const std::string path = folder / "model.toml";
  std::ofstream(path) << text;
  try {
    read_cost_model(path);
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(CostModel, ReadsItsModels) {
  EXPECT_EQ(read_cost_model("instructions").rows[static_cast<size_t>(CostClass::kDivide)].cycles, 1);
  EXPECT_EQ(read_cost_model("m4").interrupt_entry, 12);
  EXPECT_EQ(read_cost_model("m7").mispredicted, 9);
}

TEST(CostModel, SaysWhatIsWrong) {
  EXPECT_THROW(read_cost_model("m5"), BadInput);
  EXPECT_NE(refusal_of_model("no model").find("is no cost model"), std::string::npos);
  const std::string m4 = text_of("m4");
  EXPECT_EQ(refusal_of_model(m4), "");
  EXPECT_NE(refusal_of_model(replaced(m4, "of = \"alu\"", "of = \"glu\"")).find("unknown class 'glu'"),
            std::string::npos);
  EXPECT_NE(refusal_of_model(replaced(m4, "address = 1", "adress = 1")).find("unknown key adress"),
            std::string::npos);
  EXPECT_NE(refusal_of_model(replaced(m4, "cycles = 1", "cycles = -1")).find("no whole number"),
            std::string::npos);
  EXPECT_NE(refusal_of_model(replaced(m4, "of = \"alu\"", "of = \"load\"")).find("two costs of load"),
            std::string::npos);
  EXPECT_NE(refusal_of_model(replaced(m4, "source = ", "#")).find("does not say where"), std::string::npos);
  EXPECT_NE(refusal_of_model(m4.substr(0, m4.rfind("[[cost]]"))).find("has no cost of system"),
            std::string::npos);
}

Instruction branch(uint32_t address, uint32_t target) {
  Instruction made;
  made.address = address;
  made.size = 2;
  made.flow = Flow::kJump;
  made.cost = CostClass::kConditionalBranch;
  made.target = target;
  return made;
}

TEST(CostModel, PaysForMispredictions) {
  CostModel m7 = read_cost_model("m7");
  EXPECT_EQ(exit_cycles(m7, branch(8, 0), true), 2 + 9);
  EXPECT_EQ(exit_cycles(m7, branch(8, 0), false), 9);
  m7.predictor = Predictor::kStatic;
  EXPECT_EQ(exit_cycles(m7, branch(8, 0), true), 2);
  EXPECT_EQ(exit_cycles(m7, branch(8, 0), false), 9);
  EXPECT_EQ(exit_cycles(m7, branch(8, 20), true), 2 + 9);
  EXPECT_EQ(exit_cycles(m7, branch(8, 20), false), 0);
}

TEST(CostModel, PaysForEveryWordThatIsFetched) {
  CostModel m4 = read_cost_model("m4");
  Instruction wide = branch(0, 0);
  wide.cost = CostClass::kAlu;
  wide.size = 4;
  EXPECT_EQ(issue_cycles(m4, nullptr, wide), 1);
  m4.wait_states = 5;
  EXPECT_EQ(issue_cycles(m4, nullptr, wide), 1 + 5);
  wide.address = 2;
  EXPECT_EQ(issue_cycles(m4, nullptr, wide), 1 + 2 * 5);
}

}  // namespace
}  // namespace palpate::wcet::test
