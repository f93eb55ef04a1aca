// Time in lockstep: a message of the sensors is a tick, and nothing else is. Frames of other messages are the
// background's: their bytes wait for receive_byte.
#include "exchange.hpp"

#include "palpate/link/frame_reader.hpp"
#include "palpate/link/frame_writer.hpp"
#include "palpate/ports/link.hpp"
#include "palpate/ports/lockstep_stream.hpp"
#include "palpate/ports/tick_timer.hpp"

namespace palpate::lockstep {

Exchange g_exchange{};

namespace {

link::FrameReader g_reader;
link::FrameWriter g_writer;
bool g_is_running = false;

/// The piece that is being read, for the background if it is not for us.
struct Piece {
  link::WireFrame bytes{};
  uint32_t count = 0;
  uint32_t taken = 0;

  void add(uint8_t byte) {
    if (taken != 0) *this = Piece{};
    if (count < bytes.size()) bytes[count++] = byte;
  }
};
Piece g_piece;

void answer() {
  g_exchange.actuators.tick = g_exchange.sensors.tick;
  link::WireFrame wire;
  g_writer.write(link::ActuatorsMessage::kType, link::encode(g_exchange.actuators), wire);
  port::write_lockstep_stream(wire.data(), wire.size());
}

/// Whether the frame was a tick.
bool compute_tick(const link::Frame& frame) {
  if (link::decode(frame, g_exchange.sensors) != link::DecodeStatus::kDone) return false;
  port::on_tick();
  answer();
  return true;
}

}  // namespace
}  // namespace palpate::lockstep

namespace palpate::port {

namespace lockstep = palpate::lockstep;

void start_ticks(uint32_t) {
  open_lockstep_stream();
  lockstep::g_is_running = true;
}

void hold_ticks() { lockstep::g_is_running = false; }

void resume_ticks() { lockstep::g_is_running = true; }

bool tick_pending() { return false; }

uint32_t tick_number() { return lockstep::g_exchange.sensors.tick; }

void wait_for_tick() {
  while (lockstep::g_is_running) {
    const uint8_t byte = read_lockstep_stream();
    lockstep::g_piece.add(byte);
    const bool is_tick = lockstep::g_reader.push(byte) && lockstep::compute_tick(lockstep::g_reader.frame());
    if (is_tick) lockstep::g_piece = lockstep::Piece{};
    // A whole frame or a broken one; but a zero alone is only the line's idling.
    if (is_tick || (byte == 0 && lockstep::g_piece.count > 1)) return;
  }
}

bool receive_byte(uint8_t& byte) {
  lockstep::Piece& piece = lockstep::g_piece;
  if (piece.taken == piece.count) return false;
  byte = piece.bytes[piece.taken];
  ++piece.taken;
  return true;
}

bool link_carries_device() { return true; }

bool send_byte(uint8_t byte) {
  write_lockstep_stream(&byte, 1);
  return true;
}

}  // namespace palpate::port
