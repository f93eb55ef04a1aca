// Accesses are aligned: an unaligned one takes longer than a model says, or traps.
#pragma once

#include "call_graph.hpp"

namespace palpate::wcet {

/// Throws Refusal when the program was compiled with unaligned accesses allowed (Addenda to the ABI for the
/// Arm architecture, Tag_CPU_unaligned_access), or a block shows an access that is not at a multiple of its
/// size.
void refuse_unaligned(const Program& program, const CallGraph& calls);

}  // namespace palpate::wcet
