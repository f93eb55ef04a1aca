#include "palpate/ports/indicator.hpp"
#include "palpate/ports/motors.hpp"
#include "palpate/ports/watchdog.hpp"

namespace palpate::port {

// to do: write the three codes to the converters and latch them together. 2048 is no current.
void write_motors(const std::array<uint16_t, 3>& codes) { static_cast<void>(codes); }

// to do: drive the enable line of each power stage. Off at reset by a pull resistor, not by this function.
void set_amplifiers(bool enabled) { static_cast<void>(enabled); }

// to do: switch the lamp.
void show(const Indication& indication) { static_cast<void>(indication); }

// to do: toggle the line that keeps the amplifiers' watchdog content, and restart the processor's.
void feed_watchdogs() {}

// to do: start the processor's watchdog with 10 ms.
void start_watchdog() {}

}  // namespace palpate::port
