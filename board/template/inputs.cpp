// A new board starts as a copy of this folder. Every function is a to-do: it compiles, does nothing, and says
// what is required. The contracts are in hal/ports.
#include "palpate/ports/buttons.hpp"
#include "palpate/ports/device_status.hpp"
#include "palpate/ports/encoders.hpp"
#include "palpate/ports/gimbal.hpp"

namespace palpate::port {

// to do: latch the three decoders at one instant and read them; extend 16-bit counters by the difference to
// the last reading. Joint order, no scaling, no signs.
std::array<int32_t, 3> read_encoders() { return {0, 0, 0}; }

// to do: count the readings that the decoders delivered.
uint32_t encoder_reading_number() { return 0; }

// to do: read the port once, make buttons active-high, put the grasp button on bit 0, debounce over ticks.
uint32_t read_buttons() { return 0; }

// to do: read the codes that the converters finished last; 2048 without a gimbal.
std::array<uint32_t, 3> read_gimbal() { return {2048, 2048, 2048}; }

// to do: read the stop and the fault lines, wired so that a broken wire reads as pressed.
uint32_t read_device_status() { return kEmergencyStop | kAmplifierFault; }

// to do: ask the reset controller, and clear its answer.
bool was_reset_by_watchdog() { return false; }

}  // namespace palpate::port
