// What the background does in every firmware, whatever moves the tool.
#pragma once

#include "palpate/firmware/condition.hpp"
#include "run.hpp"

namespace palpate::firmware {

/// Board and static objects, before anything else.
Run& begin_run();

/// After the cycle has held the ticks: prints the hashes, examines the state, and lets the ticks go on.
/// Returns what does not hold.
Integrity answer_hold(Run& run);

/// Motors off, the run's figures, and the end.
[[noreturn]] void end_run(const Run& run, const char* scenario, bool is_whole);
/// The same, when there is nothing to tell.
[[noreturn]] void give_up();

}  // namespace palpate::firmware
