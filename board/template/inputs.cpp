// A new board starts as a copy of this folder. Every function is a to-do: it compiles, does nothing, and says
// what is required. The contracts are in hal/ports.
#include "palpate/ports/buttons.hpp"
#include "palpate/ports/encoders.hpp"

namespace palpate::port {

// to do: latch the three decoders at one instant and read them; extend 16-bit counters by the difference to
// the last reading. Joint order, no scaling, no signs.
std::array<int32_t, 3> read_encoders() { return {0, 0, 0}; }

// to do: read the port once, make buttons active-high, put the grasp button on bit 0, debounce over ticks.
uint32_t read_buttons() { return 0; }

}  // namespace palpate::port
