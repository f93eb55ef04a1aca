// What all experiments of the report share.
#pragma once

#include <filesystem>

#include "paper/traced_run.hpp"

namespace palpate::sim {

inline constexpr const char* kPaperTheta = "1.8";
/// theta_max at which the 90 degree bend has as many rotation tets as in the paper's row of 1.8 degrees: 696.
inline constexpr const char* kPaperRowTheta = "0.2";
inline constexpr uint32_t kPaperRowRotationTets = 696;

struct Experiment {
  std::filesystem::path folder;  // of the report: pictures and tables
  bool is_quick;  // a few ticks of everything: shows that it works, and no figure means anything

  [[nodiscard]] std::filesystem::path runs() const { return folder / "runs"; }

  /// A run that ends after kQuickTicks when in haste.
  [[nodiscard]] RunRequest request(const std::string& name, const std::string& scenario,
                                   std::vector<std::pair<std::string, std::string>> parameters) const {
    constexpr const char* kQuickTicks = "100";
    if (is_quick) parameters.emplace_back("ticks", kQuickTicks);
    return RunRequest{name, scenario, std::move(parameters)};
  }
};

}  // namespace palpate::sim
