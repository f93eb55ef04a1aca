// Settings of the processor itself, made once at start-up.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::cortex_m {

/// Unaligned accesses, divisions by zero and a stack that grows out of its memory become faults.
void trap_mistakes();

/// Of a Cortex-M7: static branch prediction, because the model behind the timing bound knows no branch target
/// cache.
void disable_branch_cache();

/// Lets the processor's cycle counter run.
void start_cycle_counter();

}  // namespace palpate::cortex_m
