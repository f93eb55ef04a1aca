// What is done to the device: every cause of every condition as it really happens, and what users do.
#pragma once

#include <string>
#include <vector>

#include "palpate/safety/conditions.hpp"

namespace palpate::fault {

enum class EventKind : uint8_t {
  kEmergencyStop,
  kAmplifierFault,
  kLostEdges,     // the amplifiers' watchdog sees no edges, and cuts them
  kSilence,       // the sensors' last message again and again
  kSkippedTicks,  // cycles that were not run
  kLateCycles,    // cycles longer than a tick
  kCountRange,    // a count outside 16 bits
  kCountJump,     // 300 counts off
  kCountStuck,    // a joint's count stands still
  kMeshLink,      // a leaf names a wrong neighbour
  kOverheated,    // a winding at 105 degC
  kForceLimit,    // the body's force passes a limit: lowered to 0.1 N
  kImpulseLimit,  // lowered to 2 mN a tick
  kBodyMoved,     // the body is 5 mm elsewhere
  kYank,          // a strong hand pulls aside
  kWarmMotors,    // a winding at 85 degC
  kDisable,
  kEnable,
  kCalibrate,
  kAbortCalibration,
  kAcknowledge,
  kGraspGlitch  // the button reads the other way
};
inline constexpr uint32_t kEventKinds = 22;

struct Event {
  EventKind kind;
  uint32_t start;   ///< the plant's tick that the first changed cycle answers
  uint32_t length;  ///< ticks
  uint32_t detail;  ///< which joint, motor, leaf or direction

  [[nodiscard]] uint32_t end() const { return start + length; }
};

const char* event_name(EventKind kind);
/// In the words of docs/safety.md.
const char* event_text(EventKind kind);
/// To reproduce it.
std::string describe(const std::vector<Event>& events);

/// The condition that the event is a cause of; none for what users do.
safety::ConditionSet expected_of(EventKind kind);

/// Whether the tool may move faster than any hand, so that nodes may be clamped.
constexpr bool may_clamp(EventKind kind) {
  return kind == EventKind::kSilence || kind == EventKind::kCountJump || kind == EventKind::kCountStuck ||
         kind == EventKind::kMeshLink || kind == EventKind::kBodyMoved || kind == EventKind::kYank;
}

}  // namespace palpate::fault
