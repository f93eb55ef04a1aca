// What outputs and inputs share.
#pragma once

#include "amplifier_watchdog.hpp"

namespace palpate::stm32 {

extern device::AmplifierWatchdog g_amplifier_watchdog;

}  // namespace palpate::stm32
