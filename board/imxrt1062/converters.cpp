// What makes the motors' references and reads the gimbal, set up (IMXRT1060RM, chapters eFlexPWM and ADC).
#include "units.hpp"

namespace palpate::imxrt {

// 4096 steps of 150 MHz: 36.6 kHz.
void start_motor_modulator() {
  constexpr uint32_t kZeroCode = 2048;
  MotorModulator::MasterControl::write(0);
  MotorModulator::FaultControl::write(0xF000);  // FLVL: a high level would be a fault
  MotorModulator::FaultStatus::write(0x000F);
  Motor1::set_up(kZeroCode);
  Motor2::set_up(kZeroCode);
  Motor3::set_up(kZeroCode);
  MotorModulator::MasterControl::write(MotorModulator::kSubmodules);  // LDOK before RUN
  MotorModulator::MasterControl::write(MotorModulator::kLoad);
  MotorModulator::Outputs::write(MotorModulator::kSubmodules << 8);  // PWMA_EN
}

bool start_gimbal_converter() {
  using Converter = GimbalConverter;
  // ADICLK = 01: half the bus clock; ADIV = 11: by 8, so 9.4 MHz; MODE = 10: 12 bits; ADLSMP and ADSTS = 11:
  // the longest sample; OVWREN: a new result replaces one that nobody took.
  constexpr uint32_t kSettings = (1u << 16) | (3u << 8) | (3u << 5) | (1u << 4) | (2u << 2) | 1;
  constexpr uint32_t kCalibrate = 1u << 7;
  constexpr uint32_t kCalibrationFailed = 1u << 1;
  Converter::Configuration::write(kSettings);
  Converter::GeneralStatus::write(kCalibrationFailed);
  Converter::GeneralControl::write(kCalibrate);
  if (!cortex_m::wait_until<Converter::GeneralControl>(kCalibrate, 0)) return false;
  Converter::Request::write(Converter::channel_of(0));
  return (Converter::GeneralStatus::read() & kCalibrationFailed) == 0;
}

}  // namespace palpate::imxrt
