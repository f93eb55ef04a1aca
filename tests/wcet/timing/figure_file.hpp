// The committed figures: what a profile may take by its design, and what it took when the file was written
// last.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flow_network.hpp"

namespace palpate::wcet::timing {

/// Of a design that says nothing of one of them it is nothing.
struct DesignFigures {
  std::optional<Cycles> cycles;
  std::optional<Cycles> goal_cycles;
  std::optional<Cycles> ram_bytes;
  std::optional<Cycles> tick_code_bytes;
  std::optional<Cycles> stack_bytes;
};

struct CommittedFigures {
  Cycles instructions = 0;
  Cycles cycles = 0;
  Cycles ram_bytes = 0;
  Cycles tick_code_bytes = 0;
  Cycles stack_bytes = 0;
};

struct FigureRow {
  std::string profile;  // the type's name
  std::string core;     // m4, m7
  DesignFigures design;
  CommittedFigures committed;
};

struct Board {
  std::string name;
  std::string core;
  double clock_mhz = 0;
  std::string profile;  // of the board's preset: the one that must fit there
  std::string devices;  // the file of its device registers, beside the figures' folder "devices"
};

struct FigureFile {
  std::vector<FigureRow> rows;
  std::vector<Board> boards;
};

/// Throws BadInput.
FigureFile read_figures(const std::string& path);

/// The file's text with other committed figures; everything else stays as it is. Throws BadInput when a row
/// is not found.
std::string with_committed(const std::string& text, const std::vector<FigureRow>& rows);

}  // namespace palpate::wcet::timing
