// Writes a container to a sink, piece by piece in the order of the file: no memory but this object, no way
// back. A sink is anything that is called as `bool sink(const uint8_t* bytes, uint32_t size)` and says
// whether it took them all: a serial line, a string.
//
//   ChunkWriter writer(sink);
//   writer.begin(Kind::kSnapshot);
//   writer.begin_chunk(Tag::of("NODE"), 1, kRequiredFlag, size);
//   writer.put(bytes);
//   writer.end_chunk();
//   const WriteStatus status = writer.end();
//
// After the first call that fails nothing more is written, and end() says why.
#pragma once

#include "palpate/container/crc32c.hpp"
#include "palpate/container/layout.hpp"

namespace palpate::container {

enum class WriteStatus : uint8_t {
  kDone,
  kSinkFull,      // the sink did not take what it was given
  kWrongOrder,    // a call that has no place here, or the tag END
  kTooLong,       // a payload above kMostPayloadBytes
  kWrongLength,   // more or fewer bytes than begin_chunk announced
  kTooManyChunks  // above kMostChunks
};

template <class Sink>
class ChunkWriter {
 public:
  explicit ChunkWriter(Sink& sink) : sink_(sink) {}

  void begin(Kind kind) {
    if (!must_be(Place::kStart)) return;
    uint8_t header[kFileHeaderBytes]{};
    for (const uint32_t i : bounded<8>(8, [] {})) header[i] = kMagic[i];
    put_u16(header + 8, kFormatVersion);
    header[10] = static_cast<uint8_t>(kind);
    const uint32_t check = crc32c(Bytes{header, 12});
    put_u32(header + 12, check);
    seal_.add_u32(check);
    place_ = Place::kBetweenChunks;
    send(Bytes{header, kFileHeaderBytes});
  }

  /// `flags`: 0 or kRequiredFlag. `length` bytes must follow.
  void begin_chunk(Tag tag, uint16_t version, uint16_t flags, uint32_t length) {
    if (!must_be(Place::kBetweenChunks)) return;
    if (tag == kEndTag || flags > kRequiredFlag) return fail(WriteStatus::kWrongOrder);
    if (count_ == kMostChunks) return fail(WriteStatus::kTooManyChunks);
    begin_any(tag, version, flags, length);
  }

  void put(Bytes bytes) {
    if (!must_be(Place::kInChunk)) return;
    if (bytes.size > left_) return fail(WriteStatus::kWrongLength);
    left_ -= bytes.size;
    send_checked(bytes);
  }

  void end_chunk() {
    if (!must_be(Place::kInChunk)) return;
    if (left_ != 0) return fail(WriteStatus::kWrongLength);
    constexpr uint8_t kZeros[8]{};
    send_checked(Bytes{kZeros, padding_});
    const uint32_t check = crc_.value();
    uint8_t bytes[kCheckBytes]{};
    put_u32(bytes, check);
    send(Bytes{bytes, kCheckBytes});
    seal_.add_u32(check);
    ++count_;
    place_ = Place::kBetweenChunks;
  }

  /// Seals the file. kDone: the sink has all of it.
  [[nodiscard]] WriteStatus end() {
    if (must_be(Place::kBetweenChunks)) {
      uint8_t payload[kEndPayloadBytes]{};
      put_u32(payload, count_);
      put_u32(payload + 4, seal_.value());
      begin_any(kEndTag, kEndVersion, kRequiredFlag, kEndPayloadBytes);
      put(Bytes{payload, kEndPayloadBytes});
      end_chunk();
      place_ = Place::kEnded;
    }
    return status_;
  }

  [[nodiscard]] WriteStatus status() const { return status_; }

 private:
  enum class Place : uint8_t { kStart, kBetweenChunks, kInChunk, kEnded };

  void begin_any(Tag tag, uint16_t version, uint16_t flags, uint32_t length) {
    if (length > kMostPayloadBytes) return fail(WriteStatus::kTooLong);
    uint8_t header[kChunkHeaderBytes]{};
    put_u32(header, tag.word);
    put_u16(header + 4, version);
    put_u16(header + 6, flags);
    put_u32(header + 8, length);
    put_u32(header + 12, crc32c(Bytes{header, 12}));
    crc_ = Crc32c();
    crc_.add(Bytes{header, kChunkHeaderBytes - kCheckBytes});
    left_ = length;
    padding_ = padding_bytes(length);
    place_ = Place::kInChunk;
    send(Bytes{header, kChunkHeaderBytes});
  }

  [[nodiscard]] bool must_be(Place place) {
    if (place_ != place) fail(WriteStatus::kWrongOrder);
    return status_ == WriteStatus::kDone;
  }
  /// The first reason stays.
  void fail(WriteStatus why) {
    if (status_ == WriteStatus::kDone) status_ = why;
  }
  void send(Bytes bytes) {
    if (status_ != WriteStatus::kDone || bytes.size == 0) return;
    if (!sink_(bytes.data, bytes.size)) fail(WriteStatus::kSinkFull);
  }
  void send_checked(Bytes bytes) {
    crc_.add(bytes);
    send(bytes);
  }

  Sink& sink_;
  Crc32c crc_, seal_;  // of this chunk, and over the checks of all
  uint32_t count_ = 0;
  uint32_t left_ = 0;  // of this chunk's payload
  uint32_t padding_ = 0;
  Place place_ = Place::kStart;
  WriteStatus status_ = WriteStatus::kDone;
};

}  // namespace palpate::container
