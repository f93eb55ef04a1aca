// Pads and their functions (IMXRT1060RM, chapter IOMUXC, and GPR26, GPR27; XBAR for the decoders' inputs).
#include "units.hpp"

namespace palpate::imxrt {
namespace {

// Pads count from GPIO_EMC_00 on, in the order of the registers.
constexpr uint32_t kEmc = 0;
constexpr uint32_t kAdB0 = 42;
constexpr uint32_t kAdB1 = 58;
constexpr uint32_t kB0 = 74;
constexpr uint32_t kB1 = 90;

// SW_PAD_CTL: hysteresis, pull-up of 100 kOhm; drive of R0 / 6; keeper off for what is analog.
constexpr uint32_t kPullUp = (1u << 16) | (2u << 14) | (1u << 13) | (1u << 12);
constexpr uint32_t kDrive = (2u << 6) | (6u << 3);
constexpr uint32_t kAnalog = 0;
constexpr uint32_t kGpio = 5;  // ALT5

template <uint32_t Pad>
void make(uint32_t function, uint32_t settings) {
  Register<0x401F'8014 + 4 * Pad>::write(function);
  Register<0x401F'8204 + 4 * Pad>::write(settings);
}

// XBARA1: an output takes this input; two outputs a register.
template <uint32_t Output>
void connect(uint32_t input) {
  constexpr uint32_t kShift = Output % 2 * 8;
  HalfRegister<0x403B'C000 + Output / 2 * 2>::change(0x7Fu << kShift, input << kShift);
}

void make_encoders() {
  make<kAdB0 + 3>(1, kPullUp);      // XBAR1_INOUT17
  make<kAdB0 + 2>(1, kPullUp);      // 16
  make<kEmc + 4>(3, kPullUp);       // 6
  make<kEmc + 5>(3, kPullUp);       // 7
  make<kEmc + 37>(1, kPullUp);      // 23
  make<kEmc + 36>(1, kPullUp);      // 22
  Register<0x401F'862C>::write(1);  // XBAR1_IN17_SELECT_INPUT: AD_B0_03; of the others 0 is right
  // ENC1 to ENC3, phases A and B.
  connect<66>(17);
  connect<67>(16);
  connect<71>(6);
  connect<72>(7);
  connect<76>(23);
  connect<77>(22);
}

void make_inputs() {
  make<kAdB1 + 2>(kGpio, kPullUp);
  make<kAdB1 + 3>(kGpio, kPullUp);
  make<kAdB1 + 6>(kGpio, kPullUp);
  make<kAdB1 + 7>(kGpio, kPullUp);
  make<kAdB1 + 8>(kGpio, kPullUp);
  make<kAdB1 + 9>(kGpio, kPullUp);
  make<kAdB1 + 11>(kGpio, kPullUp);
  make<kAdB1 + 0>(kGpio, kAnalog);
  make<kAdB1 + 1>(kGpio, kAnalog);
  make<kAdB1 + 10>(kGpio, kAnalog);
}

void make_outputs() {
  constexpr uint32_t kPins = kEnablePins | kWatchdogLine | kLamp;
  AmplifierPort::Clear::write(kPins);
  AmplifierPort::Direction::set(kPins);
  make<kB0 + 0>(kGpio, kDrive);
  make<kB0 + 1>(kGpio, kDrive);
  make<kB0 + 2>(kGpio, kDrive);
  make<kB0 + 3>(kGpio, kDrive);
  make<kB0 + 11>(kGpio, kDrive);
}

void make_uarts() {
  constexpr uint32_t kUart = 2;  // ALT2
  make<kAdB0 + 12>(kUart, kDrive);
  make<kAdB0 + 13>(kUart, kPullUp);
  make<kB1 + 0>(kUart, kDrive);
  make<kB1 + 1>(kUart, kPullUp);
  Register<0x401F'8540>::write(2);  // LPUART4_RX_SELECT_INPUT: B1_01
  Register<0x401F'8544>::write(2);  // LPUART4_TX_SELECT_INPUT: B1_00
}

}  // namespace

void initialize_pins() {
  // GPR26 and GPR27: pins of GPIO1 and GPIO2 belong to their fast twins, GPIO6 and GPIO7.
  Register<0x400A'C068>::write(0xFFFF'FFFF);
  Register<0x400A'C06C>::write(0xFFFF'FFFF);
  make_outputs();
  make_inputs();
  make_encoders();
  make_uarts();
}

void connect_motors() {
  make<kEmc + 6>(1, kDrive);  // FLEXPWM2_PWMA00
  make<kEmc + 8>(1, kDrive);  // FLEXPWM2_PWMA01
  make<kB0 + 10>(2, kDrive);  // FLEXPWM2_PWMA02
}

}  // namespace palpate::imxrt
