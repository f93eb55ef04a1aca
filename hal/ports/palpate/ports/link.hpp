// Port: the byte stream to whoever commands and watches the device (docs/wire-protocol.md).
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

/// Takes the next byte that has come, or returns false at once. Bytes that came while nobody took them may be
/// lost: the frames that they belong to then fail their check.
///
/// Called by: the background only.
bool receive_byte(uint8_t& byte);

/// Whether the link is also what the device's sensors come by and its actuators are told by: in lockstep.
/// Whoever listens then knows them already.
///
/// Called by: the background, once.
bool link_carries_device();

/// Hands over one byte to be sent, or returns false at once when there is no room for it.
///
/// Called by: the background only.
bool send_byte(uint8_t byte);

}  // namespace palpate::port
