// The seeds whose scenes were the worst, of some thousand that a search ran for each profile:
//
//   board/mps2/run_in_qemu mps2-an386 build/m4/palpate_worst_case_Small.elf -append "search 1 1000"
//
// prints tick,<seed>,<tick>,<instructions>. A change of the core may make others worse.
#pragma once

#include "scene.hpp"

namespace palpate::worst_case {

template <class AProfile>
inline constexpr std::array<uint32_t, 1> kWorstSeeds{1};
template <>
inline constexpr std::array<uint32_t, 3> kWorstSeeds<CuboidPaper>{1799, 1929, 1884};
template <>
inline constexpr std::array<uint32_t, 3> kWorstSeeds<CuboidDense>{1580, 1220, 1363};
template <>
inline constexpr std::array<uint32_t, 3> kWorstSeeds<Organ>{1265, 1010, 1704};
template <>
inline constexpr std::array<uint32_t, 3> kWorstSeeds<Small>{12781, 10940, 12267};

}  // namespace palpate::worst_case
