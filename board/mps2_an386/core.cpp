#include "registers.hpp"

namespace palpate::mps2 {

void initialize_core() {}  // a Cortex-M4 has no branch cache to turn off

}  // namespace palpate::mps2
