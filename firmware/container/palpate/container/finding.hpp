// What a reader says of a container: how it ended, and when it refuses, the place, what it expected there and
// what it found.
#pragma once

#include "palpate/container/layout.hpp"

namespace palpate::container {

enum class ReadStatus : uint8_t {
  kDone,                // what was asked for is there
  kEnd,                 // no chunk is left, and the file is whole
  kCut,                 // the bytes end before END: whole chunks before it are good
  kNotAContainer,       // the magic is another
  kTextMode,            // the magic as it looks after a transfer as text
  kHeaderDamaged,       // of the file
  kFutureFormat,        // a newer format version than this reader's, or zero
  kWrongKind,           // not the kind that was asked for
  kChunkHeaderDamaged,  // its check does not hold
  kUnknownFlags,
  kTooLong,  // a payload above kMostPayloadBytes
  kChunkDamaged,
  kPaddingNotZero,
  kTooManyChunks,
  kChunksMissing,   // END counts others than there are
  kChunksReplaced,  // END seals others than there are, or another order
  kBytesAfterEnd,
  kUnknownChunk,  // required, but this reader does not know it
  kFutureChunk,   // a version of a chunk that this reader does not know
  kWrongLength,   // of a chunk's payload
  kDuplicateChunk,
  kMissingChunk,
  kOutOfRange,    // a field's value
  kContradiction  // between fields, each of which is in its range
};
inline constexpr uint32_t kReadStatusCount = 24;

static_assert(static_cast<uint32_t>(ReadStatus::kContradiction) + 1 == kReadStatusCount);

/// For messages, in the order of ReadStatus.
inline constexpr const char* kReadStatusText[kReadStatusCount] = {
    "done",
    "whole",
    "cut off",
    "not a container",
    "damaged by a transfer as text",
    "file header damaged",
    "unknown format version",
    "wrong kind",
    "chunk header damaged",
    "unknown flags",
    "payload too long",
    "chunk damaged",
    "padding is not zero",
    "too many chunks",
    "chunks are missing or too many",
    "chunks replaced or in another order",
    "bytes after the end",
    "required chunk is not known",
    "chunk version is not known",
    "wrong length of payload",
    "chunk is there twice",
    "chunk is missing",
    "out of range",
    "contradiction",
};

constexpr const char* read_status_text(ReadStatus status) {
  return kReadStatusText[static_cast<std::size_t>(status)];
}

/// Expected is everything from `least` to `most`.
struct Finding {
  ReadStatus status;
  uint32_t offset;    // in the file: of the chunk, of the field, or of what is damaged
  Tag tag;            // of the chunk there; kNoTag in the file header
  const char* field;  // name of a field of its payload, or nullptr
  int64_t least, most, found;

  /// One value was expected.
  static constexpr Finding at(ReadStatus status, uint32_t offset, Tag tag, int64_t expected, int64_t found) {
    return Finding{status, offset, tag, nullptr, expected, expected, found};
  }
  static constexpr Finding nothing() { return at(ReadStatus::kDone, 0, kNoTag, 0, 0); }
  [[nodiscard]] constexpr bool is_done() const { return status == ReadStatus::kDone; }
};

/// Whether a file of which a reader said this at last may be used: only a recording that was cut off is worth
/// something without its end.
constexpr bool is_usable(Kind kind, ReadStatus last) {
  return last == ReadStatus::kEnd || (kind == Kind::kRecording && last == ReadStatus::kCut);
}

}  // namespace palpate::container
