// Everything that is known of a profile's timing on a core.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices.hpp"
#include "figure_file.hpp"
#include "formula.hpp"
#include "measurement.hpp"
#include "timing_image.hpp"

namespace palpate::wcet::timing {

struct BoardTiming {
  Board board;
  Cycles device_cycles = 0;  // that accesses to its registers take at most, by the ports' contracts
  Cycles cycles = 0;         // with them

  [[nodiscard]] double microseconds() const { return static_cast<double>(cycles) / board.clock_mhz; }
  /// Of the tick's period; below 0 the bound is longer than it.
  [[nodiscard]] double slack_us() const { return 1000.0 - microseconds(); }
};

struct ProfileTiming {
  FigureRow row;
  std::string name;  // cuboid-paper
  ImageFigures figures;
  std::optional<Formula> formula;  // it takes the images of several profiles
  double formula_error = 0;        // the largest where all quantities are 3/4 or 5/4 of the profile's
  std::optional<Measurement> measured;
  std::vector<BoardTiming> boards;

  [[nodiscard]] CommittedFigures now() const {
    return {figures.instructions, figures.cycles, figures.ram_bytes(), figures.tick_code_bytes,
            figures.stack.bytes()};
  }
  /// Bound over measurement, both in instructions.
  [[nodiscard]] std::optional<double> ratio() const {
    if (!measured) return std::nullopt;
    return static_cast<double>(figures.instructions) /
           static_cast<double>(measured->max_observed_instructions);
  }
};

struct Builds {
  std::map<std::string, std::string> folders;  // by core
  std::string devices;                         // the boards' device files
};

/// Analyses palpate_timing_<profile>.elf of every row's folder and reads worst_case_<profile>.json beside it.
/// Throws BadInput and Refusal.
std::vector<ProfileTiming> time_profiles(const FigureFile& figures, const Builds& builds);

}  // namespace palpate::wcet::timing
