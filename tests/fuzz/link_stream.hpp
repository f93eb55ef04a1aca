// Bytes as a script of what comes over a wire: noise, frames of any kind, damaged ones. A fuzzer that only
// threw bytes would never meet a right check.
#pragma once

#include "support/link_reference.hpp"

namespace palpate::test {

/// Reads the script; beyond its end, zeros.
class Script {
 public:
  Script(const uint8_t* data, std::size_t size) : data_(data), left_(size) {}
  [[nodiscard]] bool is_over() const { return left_ == 0; }
  uint8_t byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  Bytes bytes(std::size_t count) {
    Bytes taken(count);
    for (uint8_t& one : taken) one = byte();
    return taken;
  }

 private:
  const uint8_t* data_;
  std::size_t left_;
};

/// One step of the script, by its first byte.
inline Bytes wire_bytes(Script& script, link::FrameWriter& writer) {
  const uint8_t step = script.byte();
  const std::size_t length = step / 8u;
  switch (step % 8u) {
    case 0:
      return script.bytes(length);
    case 1:
      return Bytes(length * 9u, script.byte());
    case 2:  // a body of any length
      return between_zeros(reference_piece(script.bytes(length)));
    case 3: {  // any distances under a right check
      Bytes piece = script.bytes(link::kEncodedSize);
      append(piece, check_bytes(piece));
      return between_zeros(piece);
    }
    case 4: {  // a header of any kind
      Bytes header = script.bytes(link::kHeaderSize);
      header[0] = static_cast<uint8_t>(header[0] % 4u);
      header[1] = static_cast<uint8_t>(header[1] % 10u);
      Bytes body(link::kBodySize, step);
      std::copy(header.begin(), header.end(), body.begin());
      return between_zeros(reference_piece(body));
    }
    case 5: {  // one wrong byte
      Bytes frame = written(writer, link::MessageType::kSensors, {});
      frame[script.byte() % frame.size()] ^= script.byte();
      return frame;
    }
    default: {
      const auto type = static_cast<link::MessageType>(1 + script.byte() % 7u);
      link::Payload payload{};
      for (uint8_t& one : payload) one = script.byte();
      return written(writer, type, payload);
    }
  }
}

inline Bytes wire_stream(const uint8_t* data, std::size_t size) {
  Script script(data, size);
  link::FrameWriter writer;
  Bytes stream;
  while (!script.is_over()) append(stream, wire_bytes(script, writer));
  return stream;
}

}  // namespace palpate::test
