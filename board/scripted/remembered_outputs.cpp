// Boards without a device: motors, amplifiers and watchdog keep what they were told, for a debugger to see.
#include "palpate/ports/indicator.hpp"
#include "palpate/ports/motors.hpp"
#include "palpate/ports/watchdog.hpp"

namespace palpate::port {
namespace {

std::array<uint16_t, 3> g_motor_codes{};
bool g_amplifiers_enabled = false;
bool g_watchdog_line = false;

}  // namespace

void write_motors(const std::array<uint16_t, 3>& codes) { g_motor_codes = codes; }

void set_amplifiers(bool enabled) { g_amplifiers_enabled = enabled; }

void show(const Indication&) {}

void feed_watchdogs() { g_watchdog_line = !g_watchdog_line; }

void start_watchdog() {}

}  // namespace palpate::port
