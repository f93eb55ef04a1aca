// What a command of the wire asks a tick for.
#pragma once

#include "palpate/firmware/sensors.hpp"
#include "palpate/link/telemetry_messages.hpp"

namespace palpate::telemetry {

static_assert(link::kRequestBits == safety::kRequests.bits(), "palpate: the wire has every request");

/// Of the safety layer.
constexpr safety::EventSet requests_of(const link::CommandMessage& command) {
  return safety::EventSet::of_bits(command.requests) & safety::kRequests;
}

/// Whether there is such a setting the tick knows.
constexpr firmware::SettingChange change_of(const link::CommandMessage& command) {
  return {command.setting, command.value};
}

}  // namespace palpate::telemetry
