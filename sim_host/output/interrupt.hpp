// Ctrl-C and termination end a run between two ticks, so that it can remove what it has written.
#pragma once

namespace palpate::sim {

/// From now on SIGINT and SIGTERM are remembered, and a file that grows too large is a failed write.
void watch_signals();
[[nodiscard]] bool is_interrupted();
/// Ends the process as the remembered signal would have.
void end_by_signal();

}  // namespace palpate::sim
