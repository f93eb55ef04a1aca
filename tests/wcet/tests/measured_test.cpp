// No run takes more instructions than its bound: random programs, counted by QEMU.
#include <gtest/gtest.h>

#include <cctype>
#include <sstream>

#include "../bound.hpp"
#include "cross_compiler.hpp"
#include "generated_program.hpp"

namespace palpate::wcet::test {
namespace {

std::vector<Cycles> measure(const TargetProgram& target) {
  std::istringstream output(output_of("timeout 100 qemu-system-arm -M mps2-an386 -kernel " + target.path() +
                                      " -display none -monitor none -serial none -semihosting -icount "
                                      "shift=10,align=off,sleep=off </dev/null"));
  std::vector<Cycles> counts;
  for (Cycles count = 0; output >> count;) counts.push_back(count);
  return counts;
}

Cycles bound_of(const TargetProgram& target, const std::string& root) {
  const CallGraph calls(target.program(), target.entry_of(root));
  return BoundAnalysis(target.program(), calls, read_cost_model("instructions")).bound();
}

class Measured : public testing::TestWithParam<std::tuple<const char*, uint32_t>> {};

TEST_P(Measured, IsWithinTheBound) {
  const auto [options, seed] = GetParam();
  const std::string include = " -I" PALPATE_SOURCE_FOLDER "/tests/wcet/tests";
  const TargetProgram target(generate_program(seed), options + include);
  const std::vector<Cycles> measured = measure(target);
  ASSERT_EQ(measured.size(), kRoots);
  for (uint32_t i = 0; i < kRoots; ++i) {
    const Cycles bound = bound_of(target, "root_" + std::to_string(i));
    std::printf("root_%u: bound %ld, measured %ld, %.2f\n", i, bound, measured[i],
                static_cast<double>(bound) / static_cast<double>(measured[i]));
    EXPECT_LE(measured[i], bound) << "root_" << i;
  }
}

std::string name_of(const testing::TestParamInfo<Measured::ParamType>& info) {
  std::string name = std::get<0>(info.param) + std::to_string(std::get<1>(info.param));
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Options, Measured,
                         testing::Combine(testing::Values("-O1 ", "-O2 ", "-O3 ", "-Os ",
                                                          "-O3 -funroll-loops "),
                                          testing::Range(1u, 4u)),
                         name_of);

// Without a branch there is one way only.
TEST(Measured, BranchFreeCodeIsExact) {
  const TargetProgram target(
      "#include \"counting_run.hpp\"\n"
      "extern \"C\" __attribute__((noipa)) uint32_t root_0(uint32_t x, uint32_t full) {\n"
      "  const uint64_t square = uint64_t{x} * x;\n"
      "  return static_cast<uint32_t>(square >> 7) / (full | 1) + (x > full ? x : full);\n"
      "}\n"
      "const Root roots[] = {root_0};\nconst uint32_t root_count = 1;\n",
      "-O2 -I" PALPATE_SOURCE_FOLDER "/tests/wcet/tests");
  EXPECT_EQ(measure(target), std::vector<Cycles>{bound_of(target, "root_0")});
}

}  // namespace
}  // namespace palpate::wcet::test
