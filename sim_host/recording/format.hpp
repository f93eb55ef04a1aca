// What is in a recording beside its model: the chunks' tags, their sizes, and their fields once for reading
// and writing (palpate/container/field_reader.hpp). docs/container-format.md has them as tables.
#pragma once

#include "palpate/firmware/model_container.hpp"
#include "palpate/firmware/settings.hpp"
#include "palpate/firmware/stage.hpp"

namespace palpate::recording {

using container::Bytes;
using container::Finding;
using container::ReadStatus;
using container::Tag;

inline constexpr Tag kProfileTag = Tag::of("PROF");
inline constexpr Tag kSafetyTag = Tag::of("SAFE");
inline constexpr Tag kRowsTag = Tag::of("TICK");
inline constexpr Tag kHashesTag = Tag::of("HASH");
inline constexpr Tag kChangeTag = Tag::of("CHNG");
inline constexpr Tag kSnapshotTag = Tag::of("SNAP");
inline constexpr uint16_t kVersion = 1;

/// Before the chunks of the model, and behind them.
inline constexpr uint32_t kMostProfileBytes = 16;
inline constexpr uint32_t kSafetyBytes = 4 + firmware::safety_fields::kThresholdBytes + 4;

/// What went into a cycle, and beside it what came out.
struct TickRow {
  std::array<int32_t, 3> encoder_counts;
  safety::TimingReport timing;
  safety::EventSet requests;
  safety::ConditionSet reported;
  std::array<uint16_t, 3> gimbal;
  uint8_t buttons;        // bit 0: grasp
  uint8_t device_status;  // bits of the port device_status.hpp

  std::array<uint16_t, 3> motor_codes;
  safety::ConditionSet raised;
  uint32_t flags;  // TickFlag bits
  bool amplifiers_enabled;
  safety::State state;
  firmware::Fault fault;
};
inline constexpr uint32_t kRowBytes = 52;
inline constexpr uint32_t kRowsHeadBytes = 8;
/// In a chunk: what is lost when a recording ends without warning is at most 0.1 s.
inline constexpr uint32_t kMostRows = 100;

/// The state after so many ticks.
struct HashPoint {
  uint32_t tick;
  std::array<uint64_t, firmware::kStageCount> stages;
  uint64_t state;
};
inline constexpr uint32_t kHashesBytes = 8 + 8 * (firmware::kStageCount + 1);

inline constexpr uint32_t kChangeBytes = 12;

/// Some of the bytes of a state, after so many ticks: they come in order, in one chunk or in several.
struct SnapshotPart {
  uint32_t tick;
  uint32_t state_bytes;  // of all parts
  uint64_t fingerprint;  // firmware::layout_fingerprint
  uint64_t state_hash;
  uint32_t offset;  // of this part in the state
  Bytes bytes;
  uint32_t place;  // of its chunk in the file

  [[nodiscard]] bool is_last() const { return offset + bytes.size == state_bytes; }
};
inline constexpr uint32_t kSnapshotHeadBytes = 32 + kMostProfileBytes;
inline constexpr uint32_t kMostPartBytes = 1u << 19;

/// SAFE. `is_guarded`: a hand holds the device (firmware::guard_device); otherwise a script drives it.
template <class Fields, class Guarded, class AParameters>
void safety_fields(Fields& fields, Guarded& is_guarded, AParameters& parameters) {
  fields.truth("guarded", is_guarded);
  fields.zeros(3);
  firmware::safety_fields::thresholds(fields, parameters);
  firmware::safety_fields::ignored(fields, parameters);
}

/// One row of TICK.
template <class Fields, class Row>
void row_fields(Fields& fields, Row& row) {
  for (auto& counts : row.encoder_counts) fields.number("encoder counts", counts);
  fields.number("timer's tick", row.timing.tick_number);
  fields.number("message", row.timing.message_number);
  fields.bits("requests", row.requests, safety::EventSet::of_bits(~0u).bits());
  fields.bits("reported conditions", row.reported, safety::ConditionSet::all().bits());
  fields.number("flags", row.flags);
  for (auto& code : row.gimbal) fields.number("gimbal", code);
  for (auto& code : row.motor_codes) fields.number("motor code", code, 0, 2 * phantom::kZeroCode - 1);
  fields.bits("raised conditions", row.raised, static_cast<uint16_t>(safety::ConditionSet::all().bits()));
  fields.number("buttons", row.buttons);
  fields.number("device status", row.device_status, 0, 7);
  fields.truth("late", row.timing.is_late);
  fields.truth("amplifiers", row.amplifiers_enabled);
  fields.choice("state", row.state, safety::State::kFault);
  fields.choice("fault", row.fault, firmware::kLastFault);
}

/// HASH.
template <class Fields, class Point>
void hash_fields(Fields& fields, Point& point) {
  fields.number("tick", point.tick);
  fields.zeros(4);
  for (auto& hash : point.stages) fields.number("hash of a stage", hash);
  fields.number("hash of the state", point.state);
}

/// CHNG.
template <class Fields, class Change>
void change_fields(Fields& fields, uint32_t& tick, Change& change) {
  fields.number("tick", tick);
  fields.number("setting", change.setting, 1, firmware::kSettings);
  fields.zeros(2);
  fields.number("value", change.value);
}

/// What stands before the bytes in SNAP, but the profile's name, which ends it.
template <class Fields, class Part>
void snapshot_fields(Fields& fields, Part& part) {
  fields.number("tick", part.tick);
  fields.number("bytes of the state", part.state_bytes);
  fields.number("layout", part.fingerprint);
  fields.number("hash of the state", part.state_hash);
  fields.number("offset of the bytes", part.offset);
  fields.zeros(4);
}

}  // namespace palpate::recording
