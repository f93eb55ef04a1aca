#include "cross_compiler.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace palpate::wcet::test {
namespace {

// As board/target_options.cmake has them, for a program without start-up or library.
constexpr const char* kCompiler =
    "arm-none-eabi-g++ -std=c++17 -g -mcpu=cortex-m4 -mthumb -mfloat-abi=soft -fno-exceptions -fno-rtti "
    "-fno-unwind-tables -fno-asynchronous-unwind-tables -ffunction-sections -fdata-sections "
    "-mno-unaligned-access "
    "-mslow-flash-data -fno-tree-loop-distribute-patterns -fno-ipa-cp-clone -ffreestanding -nostdlib "
    "-DPALPATE_TARGET -I" PALPATE_SOURCE_FOLDER "/core/numeric -isystem " PALPATE_EIGEN_FOLDER
    " -T " PALPATE_SOURCE_FOLDER "/tests/wcet/tests/program.ld";

std::string build(const std::filesystem::path& folder, const std::string& source,
                  const std::string& options) {
  const std::string program = folder / "program";
  std::ofstream(program + ".cpp") << source;
  output_of(std::string(kCompiler) + " " + options + " -o " + program + ".elf " + program + ".cpp");
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

TargetProgram::TargetProgram(const std::string& source, const std::string& options)
    : program_(build(folder_.path(), source, options)) {}

}  // namespace palpate::wcet::test
