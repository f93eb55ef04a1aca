// The program as a child process, in a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace palpate::test {

struct Outcome {
  int exit_code;
  std::string out, err;
};

/// An empty folder that goes with its owner.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder(TemporaryFolder&&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  ~TemporaryFolder();

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Names of everything below, hidden files too.
  [[nodiscard]] std::vector<std::string> contents() const;

 private:
  std::filesystem::path path_;
};

/// `arguments` are shell words. `before` is shell text that sets limits or variables.
Outcome run_program(const TemporaryFolder& folder, const std::string& arguments,
                    const std::string& before = "");

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

/// One line that starts with the program's name.
void expect_one_line(const std::string& text);

}  // namespace palpate::test
