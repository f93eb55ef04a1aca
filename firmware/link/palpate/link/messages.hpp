// The messages of a tick and their bytes; telemetry_messages.hpp has the others. The structs are kept by hand
// (docs/decisions/0010-wire-messages.md); what each byte of a payload means is the table of
// docs/wire-protocol.md and nothing else.
#pragma once

#include "palpate/link/little_endian.hpp"

namespace palpate::link {

/// To the firmware: what the device's sensors read. Each one received is a tick: the plant alone sets time.
struct SensorsMessage {
  static constexpr MessageType kType = MessageType::kSensors;

  uint32_t tick;                          ///< that the firmware is to compute now, modulo 2^32
  std::array<int32_t, 3> encoder_counts;  ///< joint order, extended to 32 bits
  std::array<uint16_t, 3> gimbal_adc;     ///< the converters' raw codes
  uint8_t buttons;                        ///< one bit each, as the port read_buttons
  bool emergency_stop_pressed;
  bool amplifier_fault;
  bool amplifiers_cut;  ///< by their watchdog
};

/// Of `buttons`.
inline constexpr uint8_t kGraspButton = 1;

/// From the firmware: its answer to the sensors of the same tick.
struct ActuatorsMessage {
  static constexpr MessageType kType = MessageType::kActuators;

  uint32_t tick;                             ///< of the sensors that it answers
  std::array<uint16_t, 3> motor_codes;       ///< joint order, 0 .. 4095, 2048 is no current
  std::array<bool, 3> is_amplifier_enabled;  ///< joint order
  bool watchdog_level;                       ///< of the amplifiers' watchdog line; each change is an edge
  uint8_t fault;                             ///< why the firmware stands still; 0: it does not
  uint8_t safety_state;                      ///< safety::State
  uint16_t conditions;                       ///< raised in this tick, bit n is safety::Condition n
  uint32_t flags;                            ///< TickFlag bits of the tick
};

enum class DecodeStatus : uint8_t {
  kDone,
  kOtherType,  ///< a frame of another message
  kBadValue    ///< a value outside its range, or a reserved bit or byte that is not 0
};

inline constexpr uint16_t kHighestMotorCode = 4095;

/// All bytes, reserved ones too. Straight-line code.
constexpr Payload encode(const SensorsMessage& message) {
  Payload payload{};
  store_u32<0>(payload, message.tick);
  store_i32<4>(payload, message.encoder_counts[0]);
  store_i32<8>(payload, message.encoder_counts[1]);
  store_i32<12>(payload, message.encoder_counts[2]);
  store_u16<16>(payload, message.gimbal_adc[0]);
  store_u16<18>(payload, message.gimbal_adc[1]);
  store_u16<20>(payload, message.gimbal_adc[2]);
  store_u8<22>(payload, message.buttons);
  const uint32_t status = (message.emergency_stop_pressed ? 1u : 0u) | (message.amplifier_fault ? 2u : 0u) |
                          (message.amplifiers_cut ? 4u : 0u);
  store_u8<23>(payload, static_cast<uint8_t>(status));
  return payload;
}

/// `message` is written on kDone only. Straight-line code.
[[nodiscard]] constexpr DecodeStatus decode(const Frame& frame, SensorsMessage& message) {
  if (frame.type != SensorsMessage::kType) return DecodeStatus::kOtherType;
  const Payload& payload = frame.payload;
  const uint32_t status = load_u8<23>(payload);
  if (status > 7) return DecodeStatus::kBadValue;
  message.tick = load_u32<0>(payload);
  message.encoder_counts = {load_i32<4>(payload), load_i32<8>(payload), load_i32<12>(payload)};
  message.gimbal_adc = {load_u16<16>(payload), load_u16<18>(payload), load_u16<20>(payload)};
  message.buttons = load_u8<22>(payload);
  message.emergency_stop_pressed = (status & 1u) != 0;
  message.amplifier_fault = (status & 2u) != 0;
  message.amplifiers_cut = (status & 4u) != 0;
  return DecodeStatus::kDone;
}

/// Codes above 4095 are sent as they are: the receiver refuses them. Straight-line code.
constexpr Payload encode(const ActuatorsMessage& message) {
  Payload payload{};
  store_u32<0>(payload, message.tick);
  store_u16<4>(payload, message.motor_codes[0]);
  store_u16<6>(payload, message.motor_codes[1]);
  store_u16<8>(payload, message.motor_codes[2]);
  const std::array<bool, 3>& enabled = message.is_amplifier_enabled;
  const uint32_t enables = (enabled[0] ? 1u : 0u) | (enabled[1] ? 2u : 0u) | (enabled[2] ? 4u : 0u);
  store_u8<10>(payload, static_cast<uint8_t>(enables));
  store_u8<11>(payload, message.watchdog_level ? 1 : 0);
  store_u32<12>(payload, message.flags);
  store_u8<16>(payload, message.fault);
  store_u8<17>(payload, message.safety_state);
  store_u16<18>(payload, message.conditions);
  return payload;
}

/// `message` is written on kDone only. Straight-line code.
[[nodiscard]] constexpr DecodeStatus decode(const Frame& frame, ActuatorsMessage& message) {
  if (frame.type != ActuatorsMessage::kType) return DecodeStatus::kOtherType;
  const Payload& payload = frame.payload;
  const std::array<uint16_t, 3> codes = {load_u16<4>(payload), load_u16<6>(payload), load_u16<8>(payload)};
  const uint32_t enables = load_u8<10>(payload);
  const uint32_t level = load_u8<11>(payload);
  const uint32_t reserved = load_u32<20>(payload);
  const bool is_code_high =
      codes[0] > kHighestMotorCode || codes[1] > kHighestMotorCode || codes[2] > kHighestMotorCode;
  if (is_code_high || enables > 7 || level > 1 || reserved != 0) return DecodeStatus::kBadValue;
  message.tick = load_u32<0>(payload);
  message.motor_codes = codes;
  message.is_amplifier_enabled = {(enables & 1u) != 0, (enables & 2u) != 0, (enables & 4u) != 0};
  message.watchdog_level = level != 0;
  message.flags = load_u32<12>(payload);
  message.fault = load_u8<16>(payload);
  message.safety_state = load_u8<17>(payload);
  message.conditions = load_u16<18>(payload);
  return DecodeStatus::kDone;
}

}  // namespace palpate::link
