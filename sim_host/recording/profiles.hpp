// What a reader has to know of a profile before it can have one of its states.
#pragma once

#include <string>

#include "simulation/with_profile.hpp"

namespace palpate::recording {

inline bool is_profile(const std::string& name) {
  return name == CuboidPaper::kName || name == CuboidDense::kName || name == Organ::kName ||
         name == Small::kName || name == Tiny::kName || name == Workstation::kName;
}

inline uint8_t deepest_level(const std::string& profile) {
  return sim::with_profile(profile, [](auto chosen) { return decltype(chosen)::kMaxLevel; });
}

}  // namespace palpate::recording
