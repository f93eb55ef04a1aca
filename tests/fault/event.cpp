#include "event.hpp"

#include <fmt/format.h>

#include <array>

namespace palpate::fault {
namespace {

using safety::Condition;

constexpr auto kNoCondition = static_cast<Condition>(safety::kConditionCount);

struct Row {
  const char* name;
  const char* text;
  Condition expected;
};

constexpr std::array<Row, kEventKinds> kRows = {{
    {"emergency_stop", "the emergency stop is pressed", Condition::kEmergencyStop},
    {"amplifier_fault", "an amplifier reports a fault", Condition::kAmplifierFault},
    {"lost_edges", "the amplifiers' watchdog sees no edges and cuts them", Condition::kWatchdog},
    {"silence", "the sensors' message stays the same", Condition::kCommunicationLost},
    {"skipped_ticks", "ticks without a cycle", Condition::kCycleSlip},
    {"late_cycles", "cycles longer than a tick", Condition::kTickOverrun},
    {"count_range", "a count outside 16 bits", Condition::kEncoderRange},
    {"count_jump", "a count 300 off", Condition::kEncoderJump},
    {"count_stuck", "a count stands still", Condition::kEncoderStuck},
    {"mesh_link", "a leaf names a wrong neighbour", Condition::kInvariantBroken},
    {"overheated", "a winding at 105 degC", Condition::kMotorOverheated},
    {"force_limit", "max_newtons lowered to 0.1 N", Condition::kMaxForce},
    {"impulse_limit", "impulse_newtons_per_tick lowered to 2 mN", Condition::kForceImpulse},
    {"body_moved", "the body stands 5 mm elsewhere", kNoCondition},
    {"yank", "a strong hand pulls the tool aside", Condition::kMaxVelocity},
    {"warm_motors", "a winding at 85 degC", Condition::kWarmMotors},
    {"disable", "the user disables", kNoCondition},
    {"enable", "the user enables, enabled or not", kNoCondition},
    {"calibrate", "the user asks for a calibration", kNoCondition},
    {"abort_calibration", "the user aborts a calibration", kNoCondition},
    {"acknowledge", "the user acknowledges, fault or not", kNoCondition},
    {"grasp_glitch", "the grasp button reads the other way", kNoCondition},
}};

const Row& row(EventKind kind) { return kRows[static_cast<std::size_t>(kind)]; }

}  // namespace

const char* event_name(EventKind kind) { return row(kind).name; }
const char* event_text(EventKind kind) { return row(kind).text; }

std::string describe(const std::vector<Event>& events) {
  std::string text;
  for (const Event& event : events) {
    text += fmt::format("{{EventKind::{}, start {}, length {}, detail {}}} ", event_name(event.kind),
                        event.start, event.length, event.detail);
  }
  return text;
}

safety::ConditionSet expected_of(EventKind kind) {
  const Condition expected = row(kind).expected;
  return expected == kNoCondition ? safety::ConditionSet() : safety::ConditionSet::of(expected);
}

}  // namespace palpate::fault
