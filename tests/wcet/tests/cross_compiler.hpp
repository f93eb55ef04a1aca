// Tiny target programs, compiled and linked where a test needs them.
#pragma once

#include <cstdint>
#include <string>

#include "../program.hpp"
#include "support/temporary_folder.hpp"

namespace palpate::wcet::test {

/// What the cases are written with. FACT is a flow fact at a nop of its own, for assembler.
inline constexpr const char* kShorthands = R"(
using uint32_t = unsigned long;
#define CASE extern "C" __attribute__((noipa))
#define ASSEMBLER extern "C" __attribute__((naked, noipa))
#define FACT(kind, id, bound)                                     \
  "9: nop\n\t.pushsection .wcet.flowfacts,\"?\",%progbits\n\t" \
  ".word " #kind ", " #id ", 9b, " #bound "\n\t.popsection\n\t"
inline void keep() { asm volatile("" : : : "memory"); }
#line 1
)";
inline constexpr const char* kBoundedLoops = R"(
#include <palpate/numeric/bounded.hpp>
using namespace palpate;
#line 1
)";

enum class Compiler : uint8_t { kGcc, kClang };

/// An ELF that goes with its owner.
class TargetProgram {
 public:
  /// C++, compiled with `options` besides the project's own. Throws with what the
  /// compiler says.
  explicit TargetProgram(const std::string& source, const std::string& options = "-O2",
                         Compiler compiler = Compiler::kGcc);

  [[nodiscard]] std::string path() const { return folder_ / "program.elf"; }
  [[nodiscard]] const Program& program() const { return program_; }
  [[nodiscard]] uint32_t entry_of(const std::string& function) const {
    return program_.image().find_function(function).start;
  }

 private:
  palpate::test::TemporaryFolder folder_;
  Program program_;
};

/// What a command prints; throws with it when the command fails.
std::string output_of(const std::string& command);

}  // namespace palpate::wcet::test
