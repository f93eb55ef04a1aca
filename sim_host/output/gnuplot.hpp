// gnuplot as a child process.
#pragma once

#include <filesystem>
#include <string>

namespace palpate::sim {

/// Throws EnvironmentError when gnuplot cannot be run.
void require_gnuplot();

/// Runs a script in a folder. Throws EnvironmentError with gnuplot's reason when it fails.
void run_gnuplot(const std::string& script, const std::filesystem::path& folder);

}  // namespace palpate::sim
