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

const std::string kIncludeHere = " -I" PALPATE_SOURCE_FOLDER "/tests/wcet/tests";

struct Options {
  Compiler compiler;
  const char* text;

  [[nodiscard]] std::string name() const {
    return (compiler == Compiler::kGcc ? "g++ " : "clang ") + std::string(text);
  }
};
std::ostream& operator<<(std::ostream& out, const Options& options) { return out << options.name(); }

class Measured : public testing::TestWithParam<std::tuple<Options, uint32_t>> {
 protected:
  /// Bound over measurement, of every root.
  static std::vector<double> ratios(Paths paths) {
    const auto [options, seed] = GetParam();
    const TargetProgram target(generate_program(seed, paths), options.text + kIncludeHere, options.compiler);
    const std::vector<Cycles> measured = measure(target);
    std::vector<double> ratios;
    for (uint32_t i = 0; i < measured.size(); ++i) {
      const Cycles bound = bound_of(target, "root_" + std::to_string(i));
      ratios.push_back(static_cast<double>(bound) / static_cast<double>(measured[i]));
      std::printf("root_%u: bound %ld, measured %ld, %.3f\n", i, bound, measured[i], ratios.back());
      EXPECT_LE(measured[i], bound) << "root_" << i;
    }
    EXPECT_EQ(ratios.size(), kRoots);
    return ratios;
  }
};

TEST_P(Measured, IsWithinTheBound) { ratios(Paths::kAny); }

// With full = ~0 such a program takes its longest way: the bound can't be far above it.
TEST_P(Measured, IsTheBoundWhereTheMaximumIsKnown) {
  constexpr double kMostSlack = 1.1;
  for (const double ratio : ratios(Paths::kKnownMaximum)) EXPECT_LE(ratio, kMostSlack);
}

std::string name_of(const testing::TestParamInfo<Measured::ParamType>& info) {
  const auto& [options, seed] = info.param;
  std::string name = options.name() + std::to_string(seed);
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    Options, Measured,
    testing::Combine(testing::Values(Options{Compiler::kGcc, "-O1 "}, Options{Compiler::kGcc, "-O2 "},
                                     Options{Compiler::kGcc, "-O3 "}, Options{Compiler::kGcc, "-Os "},
                                     Options{Compiler::kGcc, "-O3 -funroll-loops "},
                                     Options{Compiler::kClang, "-O1 "}, Options{Compiler::kClang, "-O2 "},
                                     Options{Compiler::kClang, "-O3 "}, Options{Compiler::kClang, "-Os "}),
                     testing::Range(1u, 4u)),
    name_of);

// Without a branch there is one way only.
constexpr const char* kBranchFree =
    "#include \"counting_run.hpp\"\n"
    "extern \"C\" __attribute__((noipa)) uint32_t root_0(uint32_t x, uint32_t full) {\n"
    "  const uint64_t square = uint64_t{x} * x;\n"
    "  return static_cast<uint32_t>(square >> 7) / (full | 1) + (x > full ? x : full);\n"
    "}\n"
    "const Root roots[] = {root_0};\nconst uint32_t root_count = 1;\n";

TEST(MeasuredExactly, BranchFreeCode) {
  for (const Compiler compiler : {Compiler::kGcc, Compiler::kClang}) {
    for (const char* options : {"-O1", "-O2", "-O3", "-Os"}) {
      const TargetProgram target(kBranchFree, options + kIncludeHere, compiler);
      EXPECT_EQ(measure(target), std::vector<Cycles>{bound_of(target, "root_0")}) << options;
    }
  }
}

}  // namespace
}  // namespace palpate::wcet::test
