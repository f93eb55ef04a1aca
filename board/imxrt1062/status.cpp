#include "outputs.hpp"
#include "palpate/ports/device_status.hpp"
#include "units.hpp"

namespace palpate::port {

// Every line is low when all is well, and its pull-up makes it high when its wire is broken or the plug is
// out.
uint32_t read_device_status() {
  const uint32_t high = imxrt::InputPort::Input::read();
  const bool is_cut = (high & imxrt::kAmplifiersCutPin) != 0;
  return ((high & imxrt::kEmergencyStopPin) != 0 ? kEmergencyStop : 0) |
         ((high & imxrt::kAmplifierFaultPins) != 0 ? kAmplifierFault : 0) |
         (is_cut && imxrt::g_amplifier_watchdog.must_be_content() ? kAmplifiersCut : 0);
}

bool was_reset_by_watchdog() {
  using ResetStatus = cortex_m::Register<0x400F'8008>;  // SRC_SRSR; a 1 clears
  constexpr uint32_t kWatchdog3 = 1u << 7;              // wdog3_rst_b
  const uint32_t status = ResetStatus::read();
  ResetStatus::write(status);
  return (status & kWatchdog3) != 0;
}

}  // namespace palpate::port
