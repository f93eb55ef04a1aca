#include "core_setup.hpp"
#include "registers.hpp"

namespace palpate::mps2 {

void initialize_core() { cortex_m::disable_branch_cache(); }

}  // namespace palpate::mps2
