// The messages beside the tick: a command to the firmware, and what it tells of itself. Units are the wire's;
// the tables are in docs/wire-protocol.md.
#pragma once

#include "palpate/link/messages.hpp"

namespace palpate::link {

/// To the firmware: what the user asks for. Nothing acknowledges it; the telemetry shows what came of it.
struct CommandMessage {
  static constexpr MessageType kType = MessageType::kCommand;

  uint32_t requests;  ///< bits of kRequestBits
  uint16_t setting;   ///< number of a setting to change; 0: none
  int32_t value;      ///< its new raw value; 0 where setting is 0
  bool ends_run;      ///< motors off, and no tick any more until a new start
};

/// Bit n is event n of the safety layer, of those that may be asked for (safety::kRequests).
inline constexpr uint32_t kRequestBits = 0x01fc3000u;

/// From the firmware, once a tick.
struct TelemetryMessage {
  static constexpr MessageType kType = MessageType::kTelemetry;

  uint32_t tick;
  uint8_t state;                      ///< of the safety layer: 0 .. kHighestState
  uint8_t fault;                      ///< why the cycle stands still; 0: it does not
  uint16_t raised;                    ///< bit n is condition n
  std::array<int16_t, 3> tool_20_um;  ///< in the device's frame, in 20 um: +-655 mm
  std::array<int16_t, 3> force_mn;    ///< on the handle, as the body asks for it, in mN: +-32.8 N
  uint32_t flags;                     ///< TickFlag bits
};
inline constexpr uint8_t kHighestState = 7;

/// From the firmware: how long four stages took in a tick.
struct StageCyclesMessage {
  static constexpr MessageType kType = MessageType::kStageCycles;

  uint32_t tick;
  uint8_t part;                    ///< stages 4 part .. 4 part + 3; below kStageParts
  std::array<uint32_t, 4> cycles;  ///< of the processor
};
inline constexpr uint32_t kStagesInPart = 4;
inline constexpr uint32_t kStageParts = 2;

/// From the firmware: what went wrong since the start, each modulo 2^32.
struct CountersMessage {
  static constexpr MessageType kType = MessageType::kCounters;

  uint32_t tick;
  uint32_t dropped_records;  ///< ticks without telemetry, since nobody took it in time
  uint32_t overruns;         ///< cycles that ended after the next one was due
  uint32_t rejected_frames;  ///< pieces that were no frame: lengths, checks, blocks, versions, types
  uint32_t lost_frames;      ///< numbers skipped between accepted frames
  uint32_t discarded_bytes;
};

/// From the firmware: what its motors do.
struct MotorsMessage {
  static constexpr MessageType kType = MessageType::kMotors;

  uint32_t tick;
  std::array<uint16_t, 3> codes;  ///< joint order, 0 .. 4095, 2048 is no current
  bool amplifiers_enabled;
  std::array<int16_t, 3> winding_centi_celsius;  ///< as the thermal model has it
  std::array<uint16_t, 3> limit_ma;              ///< of |I|
};

/// From the firmware: what entered a tick beside the sensors, when it is not what follows from the tick
/// before: no requests, no change, nobody late, both numbers one more.
struct InputsMessage {
  static constexpr MessageType kType = MessageType::kInputs;

  uint32_t tick;            ///< of the timer
  uint32_t message_number;  ///< of the sensors' last message
  uint32_t requests;        ///< bits of kRequestBits
  uint32_t findings;        ///< of the firmware's background, bit n is condition n
  bool is_late;             ///< the last cycle ended after this one was due
  bool is_refused;          ///< the change
  uint16_t setting;         ///< number of the setting that a command changed; 0: none
  int32_t value;            ///< its new raw value; 0 where setting is 0
};

/// Straight-line code, as all that follow. Other bits are sent as they are: the receiver refuses them.
constexpr Payload encode(const CommandMessage& message) {
  Payload payload{};
  store_u32<0>(payload, message.requests);
  store_u16<4>(payload, message.setting);
  store_u8<6>(payload, message.ends_run ? 1 : 0);
  store_i32<8>(payload, message.value);
  return payload;
}

/// `message` is written on kDone only, as by all that follow.
[[nodiscard]] constexpr DecodeStatus decode(const Frame& frame, CommandMessage& message) {
  if (frame.type != CommandMessage::kType) return DecodeStatus::kOtherType;
  const Payload& payload = frame.payload;
  const uint32_t requests = load_u32<0>(payload);
  const uint16_t setting = load_u16<4>(payload);
  const int32_t value = load_i32<8>(payload);
  const uint32_t ends_run = load_u8<6>(payload);
  // Bytes 7 and 12 .. 23.
  const uint32_t reserved =
      load_u8<7>(payload) | load_u32<12>(payload) | load_u32<16>(payload) | load_u32<20>(payload);
  const bool is_stray_value = setting == 0 && value != 0;
  if ((requests & ~kRequestBits) != 0 || is_stray_value || ends_run > 1 || reserved != 0)
    return DecodeStatus::kBadValue;
  message = CommandMessage{requests, setting, value, ends_run != 0};
  return DecodeStatus::kDone;
}

constexpr Payload encode(const TelemetryMessage& message) {
  Payload payload{};
  store_u32<0>(payload, message.tick);
  store_u8<4>(payload, message.state);
  store_u8<5>(payload, message.fault);
  store_u16<6>(payload, message.raised);
  store_i16<8>(payload, message.tool_20_um[0]);
  store_i16<10>(payload, message.tool_20_um[1]);
  store_i16<12>(payload, message.tool_20_um[2]);
  store_i16<14>(payload, message.force_mn[0]);
  store_i16<16>(payload, message.force_mn[1]);
  store_i16<18>(payload, message.force_mn[2]);
  store_u32<20>(payload, message.flags);
  return payload;
}

[[nodiscard]] constexpr DecodeStatus decode(const Frame& frame, TelemetryMessage& message) {
  if (frame.type != TelemetryMessage::kType) return DecodeStatus::kOtherType;
  const Payload& payload = frame.payload;
  const uint8_t state = load_u8<4>(payload);
  if (state > kHighestState) return DecodeStatus::kBadValue;
  message.tick = load_u32<0>(payload);
  message.state = state;
  message.fault = load_u8<5>(payload);
  message.raised = load_u16<6>(payload);
  message.tool_20_um = {load_i16<8>(payload), load_i16<10>(payload), load_i16<12>(payload)};
  message.force_mn = {load_i16<14>(payload), load_i16<16>(payload), load_i16<18>(payload)};
  message.flags = load_u32<20>(payload);
  return DecodeStatus::kDone;
}

constexpr Payload encode(const StageCyclesMessage& message) {
  Payload payload{};
  store_u32<0>(payload, message.tick);
  store_u8<4>(payload, message.part);
  store_u32<8>(payload, message.cycles[0]);
  store_u32<12>(payload, message.cycles[1]);
  store_u32<16>(payload, message.cycles[2]);
  store_u32<20>(payload, message.cycles[3]);
  return payload;
}

[[nodiscard]] constexpr DecodeStatus decode(const Frame& frame, StageCyclesMessage& message) {
  if (frame.type != StageCyclesMessage::kType) return DecodeStatus::kOtherType;
  const Payload& payload = frame.payload;
  const uint8_t part = load_u8<4>(payload);
  const uint32_t reserved = load_u8<5>(payload) | load_u16<6>(payload);
  if (part >= kStageParts || reserved != 0) return DecodeStatus::kBadValue;
  message.tick = load_u32<0>(payload);
  message.part = part;
  message.cycles = {load_u32<8>(payload), load_u32<12>(payload), load_u32<16>(payload),
                    load_u32<20>(payload)};
  return DecodeStatus::kDone;
}

constexpr Payload encode(const CountersMessage& message) {
  Payload payload{};
  store_u32<0>(payload, message.tick);
  store_u32<4>(payload, message.dropped_records);
  store_u32<8>(payload, message.overruns);
  store_u32<12>(payload, message.rejected_frames);
  store_u32<16>(payload, message.lost_frames);
  store_u32<20>(payload, message.discarded_bytes);
  return payload;
}

[[nodiscard]] constexpr DecodeStatus decode(const Frame& frame, CountersMessage& message) {
  if (frame.type != CountersMessage::kType) return DecodeStatus::kOtherType;
  const Payload& payload = frame.payload;
  message = CountersMessage{load_u32<0>(payload),  load_u32<4>(payload),  load_u32<8>(payload),
                            load_u32<12>(payload), load_u32<16>(payload), load_u32<20>(payload)};
  return DecodeStatus::kDone;
}

/// Codes above 4095 are sent as they are: the receiver refuses them.
constexpr Payload encode(const MotorsMessage& message) {
  Payload payload{};
  store_u32<0>(payload, message.tick);
  store_u16<4>(payload, message.codes[0]);
  store_u16<6>(payload, message.codes[1]);
  store_u16<8>(payload, message.codes[2]);
  store_u8<10>(payload, message.amplifiers_enabled ? 1 : 0);
  store_i16<12>(payload, message.winding_centi_celsius[0]);
  store_i16<14>(payload, message.winding_centi_celsius[1]);
  store_i16<16>(payload, message.winding_centi_celsius[2]);
  store_u16<18>(payload, message.limit_ma[0]);
  store_u16<20>(payload, message.limit_ma[1]);
  store_u16<22>(payload, message.limit_ma[2]);
  return payload;
}

[[nodiscard]] constexpr DecodeStatus decode(const Frame& frame, MotorsMessage& message) {
  if (frame.type != MotorsMessage::kType) return DecodeStatus::kOtherType;
  const Payload& payload = frame.payload;
  const std::array<uint16_t, 3> codes = {load_u16<4>(payload), load_u16<6>(payload), load_u16<8>(payload)};
  const uint32_t enabled = load_u8<10>(payload);
  const bool is_code_high =
      codes[0] > kHighestMotorCode || codes[1] > kHighestMotorCode || codes[2] > kHighestMotorCode;
  if (is_code_high || enabled > 1 || load_u8<11>(payload) != 0) return DecodeStatus::kBadValue;
  message.tick = load_u32<0>(payload);
  message.codes = codes;
  message.amplifiers_enabled = enabled != 0;
  message.winding_centi_celsius = {load_i16<12>(payload), load_i16<14>(payload), load_i16<16>(payload)};
  message.limit_ma = {load_u16<18>(payload), load_u16<20>(payload), load_u16<22>(payload)};
  return DecodeStatus::kDone;
}

constexpr Payload encode(const InputsMessage& message) {
  Payload payload{};
  store_u32<0>(payload, message.tick);
  store_u32<4>(payload, message.message_number);
  store_u32<8>(payload, message.requests);
  store_u32<12>(payload, message.findings);
  store_u8<16>(payload, message.is_late ? 1 : 0);
  store_u8<17>(payload, message.is_refused ? 1 : 0);
  store_u16<18>(payload, message.setting);
  store_i32<20>(payload, message.value);
  return payload;
}

[[nodiscard]] constexpr DecodeStatus decode(const Frame& frame, InputsMessage& message) {
  if (frame.type != InputsMessage::kType) return DecodeStatus::kOtherType;
  const Payload& payload = frame.payload;
  const uint32_t requests = load_u32<8>(payload);
  const uint32_t late = load_u8<16>(payload);
  const uint32_t refused = load_u8<17>(payload);
  const uint16_t setting = load_u16<18>(payload);
  const int32_t value = load_i32<20>(payload);
  const bool is_stray = setting == 0 && (value != 0 || refused != 0);
  if ((requests & ~kRequestBits) != 0 || late > 1 || refused > 1 || is_stray) return DecodeStatus::kBadValue;
  message = InputsMessage{load_u32<0>(payload),
                          load_u32<4>(payload),
                          requests,
                          load_u32<12>(payload),
                          late != 0,
                          refused != 0,
                          setting,
                          value};
  return DecodeStatus::kDone;
}

}  // namespace palpate::link
