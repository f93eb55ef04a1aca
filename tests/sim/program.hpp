// The program as a child process, in a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace palpate::test {

struct Outcome {
  int exit_code;
  std::string out, err;
};

/// `arguments` are shell words. `before` is shell text that sets limits or variables.
Outcome run_program(const TemporaryFolder& folder, const std::string& arguments,
                    const std::string& before = "");

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

/// summary.json of the run in this folder.
nlohmann::json summary_of(const TemporaryFolder& folder, const std::string& run = "run");
/// Of a run with these flags or this file, which must succeed. It goes into the folder run, in haste: no
/// plots.
nlohmann::json summary_of_run(const TemporaryFolder& folder, const std::string& arguments);

/// One line that starts with the program's name.
void expect_one_line(const std::string& text);

}  // namespace palpate::test
