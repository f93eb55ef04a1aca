// What a command of the wire asks the safety layer for.
#pragma once

#include "palpate/link/telemetry_messages.hpp"
#include "palpate/safety/event.hpp"

namespace palpate::telemetry {

static_assert(link::kRequestBits == safety::kRequests.bits(), "palpate: the wire has every request");

/// For the observation of one tick (safety::Observation::requests).
constexpr safety::EventSet requests_of(const link::CommandMessage& command) {
  return safety::EventSet::of_bits(command.requests) & safety::kRequests;
}

}  // namespace palpate::telemetry
