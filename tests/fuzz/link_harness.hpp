// What must hold whatever comes over the wire. The fuzzer and the seeded tests call the same function.
#pragma once

#include "link_stream.hpp"
#include "support/link_messages.hpp"

namespace palpate::test {

/// A message that a frame decodes to has these bytes and no others.
template <class Message>
bool is_one_encoding(const link::Frame& frame) {
  Message message{};
  return link::decode(frame, message) != link::DecodeStatus::kDone || link::encode(message) == frame.payload;
}

template <class... Messages>
bool are_one_encoding(const link::Frame& frame) {
  return (is_one_encoding<Messages>(frame) && ...);
}

/// Bytes other than 0: each is in an accepted frame, discarded, or in the piece that has not ended.
inline bool are_all_bytes_counted(const Bytes& stream, const link::ReaderCounters& counters) {
  const auto is_nonzero = [](uint8_t byte) { return byte != 0; };
  const auto bytes = static_cast<std::size_t>(std::count_if(stream.begin(), stream.end(), is_nonzero));
  const std::size_t counted = counters.accepted * link::kPieceSize + counters.discarded_bytes;
  return counted <= bytes && bytes - counted <= link::kPieceSize;
}

/// The reader agrees with the protocol's other implementation on the script's stream, in all frames and
/// counters, and reads on after it.
inline bool reads_rightly(const uint8_t* script, std::size_t size) {
  Bytes stream = wire_stream(script, size);
  link::FrameReader reader;
  const Reading reading = read_on(reader, stream);
  bool holds = is_same(reading, reference_read(stream)) && are_all_bytes_counted(stream, reading.counters);
  for (const link::Frame& frame : reading.frames) {
    holds = holds && are_one_encoding<link::SensorsMessage, link::ActuatorsMessage, link::CommandMessage,
                                      link::TelemetryMessage, link::StageCyclesMessage, link::CountersMessage,
                                      link::MotorsMessage, link::InputsMessage>(frame);
  }
  link::FrameWriter writer;
  const Reading after = read_on(reader, written(writer, link::MessageType::kActuators, link::Payload{}));
  return holds && !after.frames.empty() && after.frames.back().sequence == 0;
}

}  // namespace palpate::test
