#include "chip.hpp"
#include "setup.hpp"

namespace palpate::stm32 {

// Numbers of alternate functions: the data sheet's table 9. Encoders get no
// pull-ups: these pins bear 5 V only without them.
void initialize_pins() {
  constexpr uint32_t kTimers3To5 = 2;
  constexpr uint32_t kUsarts1To3 = 7;
  Pin<PortB, 12>::make_low_output();
  Pin<PortB, 13>::make_low_output();
  Pin<PortB, 14>::make_low_output();
  WatchdogLine::make_low_output();
  Lamp::make_low_output();
  Pin<PortB, 4>::make_alternate(kTimers3To5);
  Pin<PortB, 5>::make_alternate(kTimers3To5);
  Pin<PortA, 0>::make_alternate(kTimers3To5);
  Pin<PortA, 1>::make_alternate(kTimers3To5);
  Pin<PortB, 6>::make_alternate(kTimers3To5);
  Pin<PortB, 7>::make_alternate(kTimers3To5);
  AmplifiersCut::make_input_with_pull_up();
  SecondButton::make_input_with_pull_up();
  GraspButton::make_input_with_pull_up();
  EmergencyStop::make_input_with_pull_up();
  Pin<PortC, 9>::make_input_with_pull_up();
  Pin<PortC, 11>::make_input_with_pull_up();
  Pin<PortC, 12>::make_input_with_pull_up();
  Pin<PortC, 1>::make_analog();
  Pin<PortC, 2>::make_analog();
  Pin<PortB, 1>::make_analog();
  Pin<PortA, 2>::make_alternate(kUsarts1To3);
  Pin<PortA, 3>::make_alternate_with_pull_up(kUsarts1To3);
  Pin<PortB, 10>::make_alternate(kUsarts1To3);
  Pin<PortB, 11>::make_alternate_with_pull_up(kUsarts1To3);
}

void connect_motors() {
  constexpr uint32_t kTimers8To11 = 3;
  Pin<PortC, 6>::make_alternate(kTimers8To11);
  Pin<PortC, 7>::make_alternate(kTimers8To11);
  Pin<PortC, 8>::make_alternate(kTimers8To11);
}

// Regular conversions go round without anybody who reads them, and after each of them the three injected ones
// follow by themselves (RM0090, 13.3.9), into a register each. Without DMA an unread regular result is no
// error (13.8.1). A round takes 94 us.
bool start_gimbal_converter() {
  using Converter = GimbalConverter;
  constexpr uint32_t kClockByFour = 1u << 16;                  // ADCPRE: 21 MHz of the 36 allowed
  constexpr uint32_t kScanAndFollow = (1u << 10) | (1u << 8);  // JAUTO, SCAN
  constexpr uint32_t kOn = 1u << 0;                            // ADON
  constexpr uint32_t kContinuous = 1u << 1;                    // CONT
  constexpr uint32_t kStart = 1u << 30;                        // SWSTART
  constexpr uint32_t kSlowest = 0x3FFF'FFFF;                   // 480 cycles for every channel
  // Three conversions are the last three of the four places (13.13.12): channels 11, 12 and 9.
  constexpr uint32_t kSequence = (2u << 20) | (9u << 15) | (12u << 10) | (11u << 5);
  Converter::CommonControl::write(kClockByFour);
  Converter::Control1::write(kScanAndFollow);
  Converter::SampleTimes1::write(kSlowest & 0x07FF'FFFF);
  Converter::SampleTimes2::write(kSlowest);
  Converter::RegularLength::write(0);  // one
  Converter::RegularFirst::write(11);
  Converter::InjectedSequence::write(kSequence);
  Converter::Control2::write(kContinuous | kOn);
  // It is ready 3 us after ADON (data sheet, t_STAB): a few hundred reads of a register.
  for (uint32_t reads = 0; reads < 1000; ++reads) static_cast<void>(Converter::Control2::read());
  Converter::Control2::write(kContinuous | kOn | kStart);
  return (Converter::Control2::read() & kOn) != 0;
}

// The code runs at address 0, where reset has left the flash; its copy is in SRAM1. From here on that is what
// answers at address 0, without wait states and apart from the data's bus (RM0090, 9.2.1: MEM_MODE = 11).
void initialize_core() {
  using MemoryRemap = cortex_m::Register<0x4001'3800>;  // SYSCFG_MEMRMP
  constexpr uint32_t kSram1 = 3;
  MemoryRemap::write(kSram1);
  cortex_m::synchronize();
}

}  // namespace palpate::stm32
