// What outputs and inputs share.
#pragma once

#include "amplifier_watchdog.hpp"

namespace palpate::imxrt {

extern device::AmplifierWatchdog g_amplifier_watchdog;

}  // namespace palpate::imxrt
