#include "generated_program.hpp"

#include <fmt/format.h>

#include <random>
#include <vector>

namespace palpate::wcet::test {
namespace {

class Generator {
 public:
  Generator(uint32_t seed, Paths paths) : random_(seed), paths_(paths) {}

  std::string run() {
    text_ = "#include \"counting_run.hpp\"\nuint32_t table[16];\n";
    for (uint32_t i = 0; i < kHelpers; ++i) {
      const char* inlining = below(2) == 0 ? "__attribute__((noinline)) " : "";
      function(fmt::format("static {}uint32_t helper_{}", inlining, i));
      work_of_helpers_.push_back(work_);
    }
    std::string roots;
    for (uint32_t i = 0; i < kRoots; ++i) {
      function(fmt::format("extern \"C\" __attribute__((noipa)) uint32_t root_{}", i));
      roots += fmt::format("root_{}, ", i);
    }
    return text_ + "const Root roots[] = {" + roots +
           "};\nconst uint32_t root_count = sizeof(roots) / sizeof(Root);\n";
  }

 private:
  static constexpr uint32_t kHelpers = 5;
  static constexpr uint32_t kMostDepth = 4;
  static constexpr uint64_t kMostWork = 1500;  // statements that a function may run, so that a run is short

  uint32_t below(uint32_t count) { return static_cast<uint32_t>(random_() % count); }
  uint32_t between(uint32_t first, uint32_t last) { return first + below(last - first + 1); }
  void line(const std::string& text) { text_ += std::string(2 * depth_ + 2, ' ') + text + "\n"; }

  void function(const std::string& declaration) {
    text_ += declaration + "(uint32_t x, uint32_t full) {\n";
    work_ = 0;
    block(1);
    text_ += "  return x;\n}\n";
  }

  // `rounds`: how often the block runs at most.
  void block(uint64_t rounds) {
    ++depth_;
    const uint32_t statements = between(1, depth_ < 3 ? 3 : 2);
    for (uint32_t i = 0; i < statements; ++i) statement(rounds);
    --depth_;
  }

  void statement(uint64_t rounds) {
    work_ += rounds;
    line("x = x * 1664525u + 1013904223u;");
    if (depth_ >= kMostDepth || work_ > kMostWork) return simple();
    switch (below(8)) {
      case 0:
      case 1:
        return loop(rounds);
      case 2:
        return branch(rounds);
      case 3:
        return knows_maximum() ? loop(rounds) : choice(rounds);
      case 4:
        return call(rounds);
      case 5:
        return total(rounds);
      default:
        return simple();
    }
  }

  [[nodiscard]] bool knows_maximum() const { return paths_ == Paths::kKnownMaximum; }

  void simple() {
    static const std::vector<std::string> straight{
        "table[x >> 28] += x;", "x = static_cast<uint32_t>((uint64_t{x} * 2654435761u) >> 32);",
        "x ^= table[(x >> 20) & 15];", "x /= (x & 15) + 1;"};
    static const std::vector<std::string> branching{"if (x == 12345u) return x;",
                                                    "x = (x & 0x8000u) != 0 ? x + 7 : x ^ 99;"};
    const bool is_straight = knows_maximum() || below(3) > 0;
    const std::vector<std::string>& texts = is_straight ? straight : branching;
    line(texts[below(static_cast<uint32_t>(texts.size()))]);
  }

  // What opens rounds: bits of x, or only of full.
  [[nodiscard]] const char* opening() const { return knows_maximum() ? "full" : "((x >> 28) | full)"; }

  void loop(uint64_t rounds) {
    const uint32_t most = between(1, 7);
    line(fmt::format("for (const uint32_t i : bounded<{}>({}, [] {{}})) {{", most, opening()));
    line("  x += i;");
    block(rounds * most);
    line("}");
  }

  void branch(uint64_t rounds) {
    line(fmt::format("if (({} & {:#x}u) != 0) {{", knows_maximum() ? "full" : "(x | full)",
                     1u << between(8, 30)));
    block(rounds);
    if (!knows_maximum() && below(2) == 0) {
      line("} else {");
      block(rounds);
    }
    line("}");
  }

  void choice(uint64_t rounds) {
    line(fmt::format("switch (((x >> 9) + (full >> {})) & 7) {{", between(0, 28)));
    const uint32_t cases = between(3, 7);
    for (uint32_t i = 0; i < cases; ++i) {
      line(fmt::format("case {}: {{", i));
      block(rounds);
      line("} break;");
    }
    line("default: x += 3; break;");
    line("}");
  }

  void call(uint64_t rounds) {
    if (work_of_helpers_.empty()) return simple();
    const uint32_t helper = below(static_cast<uint32_t>(work_of_helpers_.size()));
    if (work_ + rounds * work_of_helpers_[helper] > 4 * kMostWork) return simple();
    work_ += rounds * work_of_helpers_[helper];
    line(fmt::format("x = helper_{}(x, full);", helper));
  }

  // Rounds of the inner loop are limited together, whatever round of the outer one they are in.
  void total(uint64_t rounds) {
    const uint32_t most = between(2, 12);
    line("{");
    line(fmt::format("auto total = bounded_total<{}>([] {{}});", most));
    line(fmt::format("for (const uint32_t i : bounded<{}>({}, [] {{}})) {{", between(2, 6), opening()));
    line("  x += i;");
    line(fmt::format("  for (const uint32_t j : total.take(0, {} & 15)) {{", opening()));
    line("    x += j;");
    block(rounds * most);
    line("  }");
    line("}");
    line("}");
  }

  std::mt19937 random_;
  Paths paths_;
  std::string text_;
  uint32_t depth_ = 0;
  uint64_t work_ = 0;
  std::vector<uint64_t> work_of_helpers_;
};

}  // namespace

std::string generate_program(uint32_t seed, Paths paths) { return Generator(seed, paths).run(); }

}  // namespace palpate::wcet::test
