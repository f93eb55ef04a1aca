#include "chip.hpp"
#include "core_setup.hpp"
#include "setup.hpp"

namespace palpate::stm32 {
namespace {

// DMAMUX1, channel 0, serves DMA1's stream 0 (RM0433, chapter 17).
void connect_link_receiver() {
  using Channel0 = cortex_m::Register<0x4002'0800>;
  constexpr uint32_t kUsart2Receives = 43;  // table of DMAMUX1's requests
  Channel0::write(kUsart2Receives);
}

}  // namespace

// Numbers of alternate functions: the data sheet's tables 10 to 14. Encoders get no
// pull-ups: these pins bear 5 V only without them.
void initialize_pins() {
  constexpr uint32_t kTimers3And4 = 2;
  constexpr uint32_t kTimer8 = 3;
  constexpr uint32_t kUsarts1To3 = 7;
  Pin<PortE, 10>::make_low_output();
  Pin<PortE, 12>::make_low_output();
  Pin<PortE, 14>::make_low_output();
  WatchdogLine::make_low_output();
  Lamp::make_low_output();
  Pin<PortB, 4>::make_alternate(kTimers3And4);
  Pin<PortB, 5>::make_alternate(kTimers3And4);
  Pin<PortD, 12>::make_alternate(kTimers3And4);
  Pin<PortD, 13>::make_alternate(kTimers3And4);
  Pin<PortC, 6>::make_alternate(kTimer8);
  Pin<PortC, 7>::make_alternate(kTimer8);
  EmergencyStop::make_input_with_pull_up();
  AmplifiersCut::make_input_with_pull_up();
  Pin<PortE, 4>::make_input_with_pull_up();
  Pin<PortE, 5>::make_input_with_pull_up();
  Pin<PortE, 6>::make_input_with_pull_up();
  GraspButton::make_input_with_pull_up();
  SecondButton::make_input_with_pull_up();
  Pin<PortA, 3>::make_analog();
  Pin<PortC, 0>::make_analog();
  Pin<PortB, 1>::make_analog();
  Pin<PortD, 8>::make_alternate(kUsarts1To3);
  Pin<PortD, 9>::make_alternate_with_pull_up(kUsarts1To3);
  Pin<PortD, 5>::make_alternate(kUsarts1To3);
  Pin<PortD, 6>::make_alternate_with_pull_up(kUsarts1To3);
  connect_link_receiver();
}

void connect_motors() {
  constexpr uint32_t kTimer1 = 1;
  Pin<PortE, 9>::make_alternate(kTimer1);
  Pin<PortE, 11>::make_alternate(kTimer1);
  Pin<PortE, 13>::make_alternate(kTimer1);
}

// Regular conversions go round without anybody who reads them, each overwriting the last, and after each of
// them the three injected ones follow by themselves (JAUTO), into a register each. A round takes 0.4 ms at
// most.
bool start_gimbal_converter() {
  using Converter = GimbalConverter;
  constexpr uint32_t kClockByFour = 2u << 18;    // PRESC: 16 MHz, of which revision V makes 8
  constexpr uint32_t kRegulator = 1u << 28;      // ADVREGEN; DEEPPWD, bit 29, is off
  constexpr uint32_t kFasterThan6Mhz = 1u << 8;  // BOOST
  constexpr uint32_t kSettings = kRegulator | kFasterThan6Mhz;
  constexpr uint32_t kCalibrate = 1u << 31;  // ADCAL, single-ended
  constexpr uint32_t kOn = 1u << 0;          // ADEN, and ADRDY of the status
  constexpr uint32_t kStart = 1u << 2;       // ADSTART
  // JQDIS, JAUTO, CONT, OVRMOD, RES = 010: 12 bits.
  constexpr uint32_t kRounds = (1u << 31) | (1u << 25) | (1u << 13) | (1u << 12) | (2u << 2);
  constexpr uint32_t kSlowest = 0x3FFF'FFFF;  // 810.5 cycles for every channel
  // JL: three; channels 15, 10 and 5.
  constexpr uint32_t kSequence = (5u << 21) | (10u << 15) | (15u << 9) | 2;
  Converter::CommonControl::write(kClockByFour);
  Converter::Control::write(kSettings);
  // The regulator is ready after 10 us: a few thousand reads of a register.
  for (uint32_t reads = 0; reads < 10'000; ++reads) static_cast<void>(Converter::Control::read());
  Converter::Control::write(kSettings | kCalibrate);
  if (!cortex_m::wait_until<Converter::Control>(kCalibrate, 0)) return false;
  Converter::Status::write(kOn);
  Converter::Control::write(kSettings | kOn);
  if (!cortex_m::wait_until<Converter::Status>(kOn, kOn)) return false;
  Converter::Configuration::write(kRounds);
  Converter::SampleTimes1::write(kSlowest);
  Converter::SampleTimes2::write(kSlowest);
  Converter::Preselection::write((1u << 15) | (1u << 10) | (1u << 5));
  Converter::RegularSequence::write(15u << 6);
  Converter::InjectedSequence::write(kSequence);
  Converter::Control::write(kSettings | kOn | kStart);
  return true;
}

void initialize_core() { cortex_m::disable_branch_cache(); }

}  // namespace palpate::stm32
