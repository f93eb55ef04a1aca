#include "cross_compiler.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace palpate::wcet::test {
namespace {

// As board/target_options.cmake has them, for a program without start-up or library.
constexpr const char* kOptions =
    " -std=c++17 -g -mcpu=cortex-m4 -mthumb -mfloat-abi=soft -fno-exceptions -fno-rtti -fno-unwind-tables "
    "-fno-asynchronous-unwind-tables -ffunction-sections -fdata-sections -mno-unaligned-access "
    "-ffreestanding "
    "-DPALPATE_TARGET -I" PALPATE_SOURCE_FOLDER "/core/numeric -isystem " PALPATE_EIGEN_FOLDER " ";
constexpr const char* kGcc = "arm-none-eabi-g++";
constexpr const char* kGccOptions =
    " -mslow-flash-data -fno-tree-loop-distribute-patterns -fno-ipa-cp-clone ";
constexpr const char* kLink = " -nostdlib -T " PALPATE_SOURCE_FOLDER "/tests/wcet/tests/program.ld ";

// The folders in which gcc finds the headers of the C++ library, which clang has none of for this target.
const std::string& gcc_header_options() {
  static const std::string options = [] {
    std::istringstream lines(
        output_of(std::string("echo | ") + kGcc + " -mcpu=cortex-m4 -mthumb -mfloat-abi=soft -xc++ -E -v -"));
    std::string found;
    bool is_listed = false;
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("End of search list", 0) == 0) is_listed = false;
      if (is_listed) found += " -isystem" + line;
      if (line.rfind("#include <...>", 0) == 0) is_listed = true;
    }
    return found + " ";
  }();
  return options;
}

std::string compile_command(Compiler compiler) {
  if (compiler == Compiler::kGcc) return std::string(kGcc) + kGccOptions;
  return "clang++ --target=arm-none-eabi" + gcc_header_options();
}

std::string build(const std::filesystem::path& folder, const std::string& source, const std::string& options,
                  Compiler compiler) {
  const std::string program = folder / "program";
  std::ofstream(program + ".cpp") << source;
  output_of(compile_command(compiler) + kOptions + options + " -c -o " + program + ".o " + program + ".cpp");
  output_of(std::string(kGcc) + kLink + "-o " + program + ".elf " + program + ".o");
  return program + ".elf";
}

}  // namespace

std::string output_of(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("can't run " + command);
  std::string output;
  std::array<char, 4096> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) output += part.data();
  if (pclose(pipe) != 0) throw std::runtime_error(command + "\n" + output);
  return output;
}

TargetProgram::TargetProgram(const std::string& source, const std::string& options, Compiler compiler)
    : program_(build(folder_.path(), source, options, compiler)) {}

}  // namespace palpate::wcet::test
