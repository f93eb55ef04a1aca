#include "program.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace palpate::test {

Outcome run_program(const TemporaryFolder& folder, const std::string& arguments, const std::string& before) {
  const TemporaryFolder streams;
  const std::string out = (streams / "out").string();
  const std::string err = (streams / "err").string();
  const std::string command = "cd " + folder.path().string() + " && { " + before + " " +
                              PALPATE_PROGRAM_PATH + " " + arguments + "; } >" + out + " 2>" + err;
  const int status =
      std::system(command.c_str());  // NOLINT(bugprone-command-processor): the tests' own words
  return Outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(out), read_text(err)};
}

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_text(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }

nlohmann::json summary_of(const TemporaryFolder& folder, const std::string& run) {
  return nlohmann::json::parse(read_text(folder / (run + "/summary.json")));
}

nlohmann::json summary_of_run(const TemporaryFolder& folder, const std::string& arguments) {
  const Outcome outcome = run_program(folder, arguments + " --plots off --out run");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return summary_of(folder);
}

void expect_one_line(const std::string& text) {
  EXPECT_EQ(text.rfind("palpate: ", 0), 0U) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

}  // namespace palpate::test
