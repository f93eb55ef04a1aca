// What must hold of the figures, and what is only said.
#pragma once

#include <string>
#include <vector>

#include "profile_timing.hpp"

namespace palpate::wcet::timing {

struct Finding {
  bool is_failure = false;
  std::string text;
};

/// A bound of the design is
///   met;
///   not met yet, when the committed figure is above it too;
///   passed, a failure, when the committed figure is not.
/// Bounds in instructions and cycles fail when they are more than 2 % above the committed ones, unless the
/// newest section of the change log says so (find_announced). A measurement above its bound fails, since the
/// bound is none, and so does a formula that misses by more than 1 %.
std::vector<Finding> judge(const ProfileTiming& timing, const std::string& changelog);

struct Announced {
  Cycles cycles = 0;
  Cycles instructions = 0;
};

/// From a line of the newest section, "## ...", of the form
///   - Timing: cuboid-paper on m7: 8 210 483 cycles, 3 918 658 instructions
/// with or without spaces between digits, and anything before and behind.
std::optional<Announced> find_announced(const std::string& changelog, const std::string& profile,
                                        const std::string& core);

}  // namespace palpate::wcet::timing
