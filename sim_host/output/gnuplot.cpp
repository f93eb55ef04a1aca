#include "output/gnuplot.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "output/output_file.hpp"
#include "scenario/errors.hpp"

namespace palpate::sim {
namespace {

struct Outcome {
  int status;
  std::string text;  // standard output and standard error
};

Outcome run_shell(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return Outcome{-1, "no child process can be started"};
  Outcome outcome{0, ""};
  for (int character = std::fgetc(pipe); character != EOF; character = std::fgetc(pipe)) {
    outcome.text += static_cast<char>(character);
  }
  outcome.status = pclose(pipe);
  return outcome;
}

std::string shell_word(const std::string& path) {
  std::string text = "'";
  for (const char character : path) {
    if (character == '\'') {
      text += "'\\''";
    } else {
      text += character;
    }
  }
  return text + "'";
}

/// gnuplot shows the line that it dislikes and ends with why.
std::string last_line(const std::string& text) {
  const auto end = text.find_last_not_of(" \n");
  if (end == std::string::npos) return "no message";
  const auto start = text.find_last_of('\n', end);
  return text.substr(start + 1, end - start);
}

}  // namespace

void require_gnuplot() {
  if (run_shell("gnuplot --version 2>&1").status == 0) return;
  throw EnvironmentError(
      "gnuplot is missing, which draws the pictures: install gnuplot-nox, or use --plots off");
}

void run_gnuplot(const std::string& script, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "plot.gp";
  write_whole_file(file.string(), script);
  const Outcome outcome =
      run_shell(fmt::format("cd {} && gnuplot plot.gp 2>&1", shell_word(folder.string())));
  std::filesystem::remove(file);
  if (outcome.status != 0) throw EnvironmentError("gnuplot failed: " + last_line(outcome.text));
}

}  // namespace palpate::sim
