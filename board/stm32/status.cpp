#include "chip.hpp"
#include "outputs.hpp"
#include "palpate/ports/device_status.hpp"
#include "palpate/ports/gimbal.hpp"

namespace palpate::port {

// Every line is low when all is well, and its pull-up makes it high when its wire is broken or the plug is
// out.
uint32_t read_device_status() {
  const uint32_t high = stm32::InputPort::Input::read();
  const bool is_cut = (high & stm32::AmplifiersCut::kMask) != 0;
  return ((high & stm32::EmergencyStop::kMask) != 0 ? kEmergencyStop : 0) |
         ((high & stm32::kAmplifierFaultPins) != 0 ? kAmplifierFault : 0) |
         (is_cut && stm32::g_amplifier_watchdog.must_be_content() ? kAmplifiersCut : 0);
}

bool was_reset_by_watchdog() {
  const bool was = (stm32::ResetCause::read() & stm32::kResetByWatchdog) != 0;
  stm32::ResetCause::set(stm32::kForgetResets);
  return was;
}

// The converter goes round by itself: three results wait in three registers.
std::array<uint32_t, 3> read_gimbal() {
  return {static_cast<uint16_t>(stm32::GimbalConverter::Injected1::read()),
          static_cast<uint16_t>(stm32::GimbalConverter::Injected2::read()),
          static_cast<uint16_t>(stm32::GimbalConverter::Injected3::read())};
}

}  // namespace palpate::port
