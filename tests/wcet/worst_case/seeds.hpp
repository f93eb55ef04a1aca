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
inline constexpr std::array<uint32_t, 3> kWorstSeeds<CuboidPaper>{32, 27, 1391};
template <>
inline constexpr std::array<uint32_t, 3> kWorstSeeds<CuboidDense>{338, 326, 480};
template <>
inline constexpr std::array<uint32_t, 3> kWorstSeeds<Organ>{326, 422, 338};
template <>
inline constexpr std::array<uint32_t, 3> kWorstSeeds<Small>{429, 971, 1012};
template <>
inline constexpr std::array<uint32_t, 3> kWorstSeeds<Tiny>{196, 276, 810};

}  // namespace palpate::worst_case
