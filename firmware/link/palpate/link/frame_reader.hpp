// Bytes to frames, one at a time, for the interrupt that receives them.
#pragma once

#include "palpate/link/cobs.hpp"
#include "palpate/link/frame.hpp"

namespace palpate::link {

/// Since the reader's start, each modulo 2^32. A piece is what stands between two zeros; it adds 1 to
/// `accepted` or to one of the next five, which are told apart in this order.
struct ReaderCounters {
  uint32_t accepted;
  uint32_t bad_lengths;   ///< not a frame's length; so is the rest of a frame that began before the reader
  uint32_t crc_failures;  ///< the length is right, the check is wrong
  uint32_t bad_blocks;    ///< a right check over distances that miss the end: a faulty sender
  uint32_t bad_versions;  ///< whole, of another version of the protocol
  uint32_t bad_types;     ///< whole, of this version, a message that it does not have
  uint32_t lost_frames;   ///< numbers skipped between accepted frames of a type
  uint32_t restarts;      ///< a number that is up to 2^15 back: the sender began anew, nothing counts as lost
  uint32_t discarded_bytes;  ///< other than 0 and in no accepted frame
};

/// A byte costs one step of COBS and one of the CRC, the one that ends a frame as well: some 60 instructions
/// at most on a Cortex-M7. The background may read the counters while the interrupt runs: each is one word.
class FrameReader {
 public:
  /// True when this byte completed a valid frame: frame() holds it until the next push.
  [[nodiscard]] bool push(uint8_t byte) {
    if (byte == 0) {
      const bool is_frame = length_ != 0 && end_piece();
      length_ = 0;
      return is_frame;
    }
    if (length_ == 0) begin_piece();
    if (length_ < kPieceSize) {
      if (length_ >= kCheckSize) take(static_cast<uint8_t>(late_ >> 16));
      late_ = (late_ << 8 | byte) & 0xffffffu;
      ++length_;
    } else {
      // Too long already. Its bytes are discarded, these as they come.
      is_too_long_ = true;
      ++counters_.discarded_bytes;
    }
    return false;
  }
  [[nodiscard]] const Frame& frame() const { return frame_; }
  [[nodiscard]] const ReaderCounters& counters() const { return counters_; }

 private:
  struct Expected {
    uint16_t sequence;
    bool is_known;  // a frame of the type was accepted before
  };

  void begin_piece() {
    decoder_ = CobsDecoder();
    crc_ = Crc16();
    late_ = 0;
    decoded_ = 0;
    is_too_long_ = false;
  }

  /// An encoded byte: one that three others have followed, so it is not of the check.
  void take(uint8_t encoded) {
    crc_.add(encoded);
    if (decoder_.push(encoded) != CobsEvent::kByte) return;
    const uint8_t byte = decoder_.byte();
    // 29 encoded bytes make at most 28, since the first of them is none.
    check(decoded_ < kBodySize, "a frame decoded to more than its body");
    if (decoded_ < kHeaderSize) {
      header_[decoded_] = byte;
    } else {
      frame_.payload[decoded_ - kHeaderSize] = byte;
    }
    ++decoded_;
  }

  bool end_piece() {
    uint32_t& count = verdict();
    ++count;
    if (&count != &counters_.accepted) {
      counters_.discarded_bytes += length_;
      return false;
    }
    frame_.type = static_cast<MessageType>(header_[1]);
    frame_.sequence = sequence();
    note_sequence();
    return true;
  }

  /// The counter that the piece adds to.
  uint32_t& verdict() {
    if (length_ != kPieceSize || is_too_long_) return counters_.bad_lengths;
    if (late_ != check_field(crc_.value())) return counters_.crc_failures;
    if (decoder_.push(0) != CobsEvent::kEnd) return counters_.bad_blocks;
    if (header_[0] != kVersion) return counters_.bad_versions;
    if (!is_known(static_cast<MessageType>(header_[1]))) return counters_.bad_types;
    return counters_.accepted;
  }

  [[nodiscard]] uint16_t sequence() const {
    return static_cast<uint16_t>(uint32_t{header_[2]} | uint32_t{header_[3]} << 8);
  }

  void note_sequence() {
    Expected& expected = expected_[header_[1]];
    const auto skipped = static_cast<uint16_t>(sequence() - expected.sequence);
    if (expected.is_known) {
      if (skipped < 0x8000u) {
        counters_.lost_frames += skipped;
      } else {
        ++counters_.restarts;
      }
    }
    expected = {static_cast<uint16_t>(sequence() + 1u), true};
  }

  CobsDecoder decoder_;
  Crc16 crc_;
  uint32_t late_ = 0;     // the last three bytes, the newest lowest: the check, if a 0 comes now
  uint32_t length_ = 0;   // of the piece, at most kPieceSize
  uint32_t decoded_ = 0;  // bytes of the body
  bool is_too_long_ = false;
  std::array<Expected, kTypePlaces> expected_{};
  std::array<uint8_t, kHeaderSize> header_{};
  Frame frame_{};
  ReaderCounters counters_{};
};

}  // namespace palpate::link
