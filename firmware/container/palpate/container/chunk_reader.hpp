// Reads a container where it lies: nothing is copied, nothing is allocated, and no byte is believed before
// its check holds.
//
//   ChunkReader reader(bytes);
//   Finding finding = reader.open(Kind::kRecording);
//   Chunk chunk{};
//   while (finding.is_done() && (finding = reader.next(chunk)).is_done()) use(chunk);
//   if (!is_usable(Kind::kRecording, finding.status)) refuse(finding);
//
// The chunks of a file are given before its END is seen. Who needs all of it before acting on any of it reads
// twice, or takes collect() of chunk_table.hpp.
#pragma once

#include "palpate/container/crc32c.hpp"
#include "palpate/container/finding.hpp"

namespace palpate::container {

struct Chunk {
  Tag tag;
  uint16_t version;
  bool is_required;
  uint32_t offset;  // in the file, of its header
  Bytes payload;    // 8-byte aligned in the file

  [[nodiscard]] constexpr uint32_t payload_offset() const { return offset + kChunkHeaderBytes; }
};

class ChunkReader {
 public:
  explicit ChunkReader(Bytes file)
      : file_(file), finding_(Finding::at(ReadStatus::kNotAContainer, 0, kNoTag, 1, 0)) {}

  /// kDone, or why this is no container of this kind. Constant time. Again: from the beginning.
  [[nodiscard]] Finding open(Kind kind) {
    at_ = kFileHeaderBytes;
    count_ = 0;
    seal_ = Crc32c();
    finding_ = check_file_header(kind);
    return finding_;
  }

  /// kDone with the next chunk, END (which is never given) as kEnd, or why there is none. What is not kDone
  /// stays. O(payload). Nothing before open() has said kDone.
  [[nodiscard]] Finding next(Chunk& chunk) {
    if (!finding_.is_done()) return finding_;
    Header header{};
    finding_ = read_header(header);
    if (!finding_.is_done()) return finding_;
    finding_ = check_body(header);
    if (!finding_.is_done()) return finding_;
    const Bytes payload = file_.part(at_ + kChunkHeaderBytes, header.length);
    if (header.tag == kEndTag) return finding_ = check_end(header, payload);
    if (count_ == kMostChunks) return finding_ = here(ReadStatus::kTooManyChunks, header, count_, count_ + 1);
    chunk = Chunk{header.tag, header.version, header.flags == kRequiredFlag, at_, payload};
    ++count_;
    at_ += chunk_bytes(header.length);
    seal_.add_u32(get_u32(file_.data + at_ - kCheckBytes));
    return finding_;
  }

  /// Chunks given so far.
  [[nodiscard]] uint32_t count() const { return count_; }

 private:
  struct Header {
    Tag tag;
    uint16_t version, flags;
    uint32_t length;
  };

  [[nodiscard]] Finding here(ReadStatus status, const Header& header, int64_t expected, int64_t found) const {
    return Finding::at(status, at_, header.tag, expected, found);
  }

  /// The first byte of the magic that is another, or 8.
  [[nodiscard]] uint32_t matching_magic() const {
    uint32_t matching = 0;
    for (const uint32_t i : bounded<8>(8, [] {})) {
      if (matching == i && i < file_.size && file_.data[i] == kMagic[i]) ++matching;
    }
    return matching;
  }
  /// Bit 7 gone, CR LF become LF, or the LF become CR LF.
  [[nodiscard]] bool looks_like_text(uint32_t matching) const {
    if (matching == 0)
      return file_.size > 1 && file_.data[0] == (kMagic[0] & 0x7f) && file_.data[1] == kMagic[1];
    const uint8_t found = file_.data[matching];
    return (matching == 4 && found == '\n') || (matching == 5 && found == '\r') ||
           (matching == 7 && found == '\r');
  }

  [[nodiscard]] Finding check_file_header(Kind kind) {
    const auto refuse = [](ReadStatus status, uint32_t offset, int64_t expected, int64_t found) {
      return Finding::at(status, offset, kNoTag, expected, found);
    };
    const uint32_t matching = matching_magic();
    if (matching < 8 && matching < file_.size) {
      const ReadStatus status =
          looks_like_text(matching) ? ReadStatus::kTextMode : ReadStatus::kNotAContainer;
      return refuse(status, matching, kMagic[matching], file_.data[matching]);
    }
    if (file_.size < kFileHeaderBytes) return refuse(ReadStatus::kCut, 0, kFileHeaderBytes, file_.size);
    const uint32_t check = get_u32(file_.data + 12);
    const uint32_t right_check = crc32c(file_.part(0, 12));
    if (check != right_check) return refuse(ReadStatus::kHeaderDamaged, 12, right_check, check);
    const uint16_t version = get_u16(file_.data + 8);
    if (version != kFormatVersion) return refuse(ReadStatus::kFutureFormat, 8, kFormatVersion, version);
    const auto expected = static_cast<uint8_t>(kind);
    if (file_.data[10] != expected) return refuse(ReadStatus::kWrongKind, 10, expected, file_.data[10]);
    if (file_.data[11] != 0) return refuse(ReadStatus::kPaddingNotZero, 11, 0, file_.data[11]);
    seal_.add_u32(check);
    return Finding::nothing();
  }

  [[nodiscard]] Finding read_header(Header& header) const {
    const uint32_t left = file_.size - at_;
    if (left < kChunkHeaderBytes) {
      return Finding::at(ReadStatus::kCut, at_, kNoTag, kChunkHeaderBytes, left);
    }
    const uint8_t* bytes = file_.data + at_;
    header = Header{Tag{get_u32(bytes)}, get_u16(bytes + 4), get_u16(bytes + 6), get_u32(bytes + 8)};
    const uint32_t check = get_u32(bytes + 12);
    const uint32_t right_check = crc32c(Bytes{bytes, 12});
    if (check != right_check) return here(ReadStatus::kChunkHeaderDamaged, header, right_check, check);
    if ((header.flags & ~kRequiredFlag) != 0) {
      return here(ReadStatus::kUnknownFlags, header, header.flags & kRequiredFlag, header.flags);
    }
    if (header.length > kMostPayloadBytes) {
      return here(ReadStatus::kTooLong, header, kMostPayloadBytes, header.length);
    }
    if (left < chunk_bytes(header.length)) {
      return here(ReadStatus::kCut, header, chunk_bytes(header.length), left);
    }
    return Finding::nothing();
  }

  [[nodiscard]] Finding check_body(const Header& header) const {
    const uint32_t before_check = chunk_bytes(header.length) - kCheckBytes;
    const uint32_t check = get_u32(file_.data + at_ + before_check);
    Crc32c right_check;
    right_check.add(file_.part(at_, kChunkHeaderBytes - kCheckBytes));
    right_check.add(file_.part(at_ + kChunkHeaderBytes, before_check - kChunkHeaderBytes));
    if (check != right_check.value()) {
      return here(ReadStatus::kChunkDamaged, header, right_check.value(), check);
    }
    const uint32_t padding = at_ + kChunkHeaderBytes + header.length;
    for (const uint32_t i : bounded<7>(padding_bytes(header.length), [] {})) {
      const uint8_t byte = file_.data[padding + i];
      if (byte != 0) return here(ReadStatus::kPaddingNotZero, header, 0, byte);
    }
    return Finding::nothing();
  }

  [[nodiscard]] Finding check_end(const Header& end, Bytes payload) const {
    if (end.version != kEndVersion) return here(ReadStatus::kFutureChunk, end, kEndVersion, end.version);
    if (end.flags != kRequiredFlag) return here(ReadStatus::kUnknownFlags, end, kRequiredFlag, end.flags);
    if (end.length != kEndPayloadBytes) {
      return here(ReadStatus::kWrongLength, end, kEndPayloadBytes, end.length);
    }
    const uint32_t count = get_u32(payload.data);
    if (count != count_) return here(ReadStatus::kChunksMissing, end, count, count_);
    const uint32_t seal = get_u32(payload.data + 4);
    if (seal != seal_.value()) return here(ReadStatus::kChunksReplaced, end, seal, seal_.value());
    const uint32_t size = at_ + chunk_bytes(end.length);
    if (size != file_.size) return Finding::at(ReadStatus::kBytesAfterEnd, size, end.tag, size, file_.size);
    return here(ReadStatus::kEnd, end, count, count_);
  }

  Bytes file_;
  uint32_t at_ = 0;     // of the next chunk
  uint32_t count_ = 0;  // of chunks before it
  Crc32c seal_;
  Finding finding_;
};

}  // namespace palpate::container
