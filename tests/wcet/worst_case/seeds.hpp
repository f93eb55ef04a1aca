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
inline constexpr std::array<uint32_t, 3> kWorstSeeds<CuboidPaper>{1391, 27, 1326};
template <>
inline constexpr std::array<uint32_t, 3> kWorstSeeds<CuboidDense>{422, 326, 1048};
template <>
inline constexpr std::array<uint32_t, 3> kWorstSeeds<Organ>{326, 338, 422};
template <>
inline constexpr std::array<uint32_t, 3> kWorstSeeds<Small>{1191, 1916, 1685};

}  // namespace palpate::worst_case
