// The stages of a tick, compiled once for every profile. Each takes a compiler seconds, and most of all under
// sanitizers: who includes this file leaves them to compiled_stages.cpp, whatever its probe.
#pragma once

#include "palpate/firmware/cycle.hpp"
#include "palpate/tick/hash.hpp"
#include "palpate/tick/profiles.hpp"

/// `keyword` is extern for the declarations and nothing for the definitions: it can have no parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define PALPATE_STAGES(keyword, Profile)                                                                  \
  keyword template Status start(State<Profile>&, const Model&);                                           \
  keyword template void tick_stages::touch(State<Profile>&, const TickInput&);                            \
  keyword template void tick_stages::remesh<Slot::kMesh>(State<Profile>&);                                \
  keyword template void tick_stages::remesh<Slot::kFront>(State<Profile>&);                               \
  keyword template void tick_stages::remesh<Slot::kJudgement>(State<Profile>&);                           \
  keyword template void tick_stages::rotations<true>(State<Profile>&);                                    \
  keyword template void tick_stages::rotations<false>(State<Profile>&);                                   \
  keyword template void tick_stages::forces<Observe::kYes>(State<Profile>&);                              \
  keyword template void tick_stages::forces<Observe::kNo>(State<Profile>&);                               \
  keyword template void tick_stages::aim(State<Profile>&, const TickInput&);                              \
  keyword template void tick_stages::integrate<tick_stages::Substep::kFirst>(State<Profile>&,             \
                                                                             const TickInput&, uint32_t); \
  keyword template void tick_stages::integrate<tick_stages::Substep::kNext>(State<Profile>&,              \
                                                                            const TickInput&, uint32_t);  \
  keyword template void tick_stages::reaction(State<Profile>&, const TickInput&, const ClampCounters&,    \
                                              TickOutput&);                                               \
  keyword template uint64_t stage_hash(const State<Profile>&, const TickOutput&, CoreStage);              \
  keyword template void firmware::cycle_stages::motor_codes(firmware::CycleState<Profile>&,               \
                                                            safety::Observation&);
// NOLINTEND(bugprone-macro-parentheses)

namespace palpate {

PALPATE_STAGES(extern, CuboidPaper)
PALPATE_STAGES(extern, CuboidDense)
PALPATE_STAGES(extern, Organ)
PALPATE_STAGES(extern, Small)
PALPATE_STAGES(extern, Tiny)
PALPATE_STAGES(extern, Workstation)

}  // namespace palpate
