// Writes a recording to a sink, chunk by chunk: what a sink has taken is worth something whatever happens
// next. No memory but this object.
//
//   RecordingWriter writer(sink);
//   writer.begin(start);
//   each tick:       writer.add(row);
//   now and then:    writer.add(hashes);  writer.add(tick, change);  writer.add_snapshot(tick, state);
//   writer.end();
//
// The order of the calls is the order of the file. Rows wait until there are kMostRows, or something else
// comes.
#pragma once

#include <algorithm>
#include <utility>

#include "palpate/firmware/state_layout.hpp"
#include "recording/row.hpp"
#include "recording/start.hpp"
#include "text/bytes_of.hpp"

namespace palpate::recording {

template <class Sink>
class RecordingWriter {
 public:
  explicit RecordingWriter(Sink& sink) : writer_(sink), fields_(writer_) {}

  void begin(const Start& start) {
    writer_.begin(container::Kind::kRecording);
    begin_chunk(kProfileTag, static_cast<uint32_t>(start.profile.size()));
    writer_.put(bytes_of(start.profile));
    writer_.end_chunk();
    firmware::write_model_chunks(writer_, start.model, bytes_of(start.scenario));
    begin_chunk(kSafetyTag, kSafetyBytes);
    safety_fields(fields_, start.is_guarded, start.parameters);
    writer_.end_chunk();
  }

  void add(const TickRow& row) {
    rows_[waiting_] = row;
    ++waiting_;
    if (waiting_ == kMostRows) flush();
  }
  /// What waits becomes a chunk.
  void flush() {
    if (waiting_ == 0) return;
    begin_chunk(kRowsTag, kRowsHeadBytes + kRowBytes * waiting_);
    fields_.number("first tick", written_ + 1);
    fields_.number("rows", waiting_);
    for (uint32_t i = 0; i < waiting_; ++i) row_fields(fields_, std::as_const(rows_[i]));
    writer_.end_chunk();
    written_ += waiting_;
    waiting_ = 0;
  }

  void add(const HashPoint& point) {
    flush();
    begin_chunk(kHashesTag, kHashesBytes);
    hash_fields(fields_, point);
    writer_.end_chunk();
  }
  /// After `tick` ticks, before the next one.
  void add(uint32_t tick, const firmware::SettingChange& change) {
    flush();
    begin_chunk(kChangeTag, kChangeBytes);
    change_fields(fields_, tick, change);
    writer_.end_chunk();
  }
  /// All of the state after `tick` ticks. A recording whose first ticks are not its run's first begins with
  /// one.
  template <class Profile>
  void add_snapshot(uint32_t tick, const firmware::CycleState<Profile>& state) {
    flush();
    if (written_ == 0) written_ = tick;
    const auto* bytes = reinterpret_cast<const uint8_t*>(&state);
    constexpr uint32_t kSize = sizeof(state);
    SnapshotPart part{tick, kSize, firmware::layout_fingerprint<Profile>(), firmware::state_hash(state), 0,
                      {},   0};
    while (part.offset < kSize) {
      part.bytes = {bytes + part.offset, std::min(kSize - part.offset, kMostPartBytes)};
      add_part(part, Profile::kName);
      part.offset += part.bytes.size;
    }
  }

  /// kDone: the sink has taken everything, and the file is sealed.
  [[nodiscard]] container::WriteStatus end() {
    flush();
    return writer_.end();
  }

 private:
  void begin_chunk(Tag tag, uint32_t length) {
    writer_.begin_chunk(tag, kVersion, container::kRequiredFlag, length);
  }
  void add_part(const SnapshotPart& part, const char* profile) {
    begin_chunk(kSnapshotTag, kSnapshotHeadBytes + part.bytes.size);
    snapshot_fields(fields_, part);
    uint8_t name[kMostProfileBytes]{};
    for (uint32_t i = 0; i < kMostProfileBytes && profile[i] != '\0'; ++i) {
      name[i] = static_cast<uint8_t>(profile[i]);
    }
    writer_.put(Bytes{name, kMostProfileBytes});
    writer_.put(part.bytes);
    writer_.end_chunk();
  }

  container::ChunkWriter<Sink> writer_;
  container::FieldWriter<Sink> fields_;
  std::array<TickRow, kMostRows> rows_{};
  uint32_t waiting_ = 0;
  uint32_t written_ = 0;  // ticks, those before the recording too
};

}  // namespace palpate::recording
