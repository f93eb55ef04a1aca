// Reads a recording where it lies, from its beginning to its end: rows and what stands between them go to a
// visitor as they come, and nothing is kept.
//
//   RecordingReader reader(file);
//   Start start;
//   Finding finding = reader.open(start);
//   if (finding.is_done()) finding = reader.read(visitor);
//   if (!container::is_usable(container::Kind::kRecording, finding.status)) refuse(finding);
//
// Each chunk is checked before anything of it is given, but not those behind it: who must not act on a part
// of a damaged file reads twice.
#pragma once

#include "palpate/container/chunk_reader.hpp"
#include "recording/format.hpp"
#include "recording/start.hpp"

namespace palpate::recording {

/// What a recording tells, in the order in which it happened.
class Visitor {
 public:
  Visitor() = default;
  Visitor(const Visitor&) = delete;
  Visitor(Visitor&&) = delete;
  Visitor& operator=(const Visitor&) = delete;
  Visitor& operator=(Visitor&&) = delete;
  virtual ~Visitor() = default;

  /// `tick`: the cycles done, this one included.
  virtual void see_row(uint32_t /*tick*/, const TickRow& /*row*/) {}
  virtual void see_hashes(const HashPoint& /*point*/) {}
  virtual void see_change(uint32_t /*tick*/, const firmware::SettingChange& /*change*/) {}
  /// Its bytes are gone with the file.
  virtual void see_snapshot(const SnapshotPart& /*part*/) {}
  /// False: nothing more is given.
  [[nodiscard]] virtual bool wants_more() const { return true; }
};

class RecordingReader {
 public:
  explicit RecordingReader(Bytes file) : chunks_(file) {}

  /// kDone with how the run began. A file that ends before that is of no use.
  [[nodiscard]] Finding open(Start& start);

  /// All of the rest: kEnd, kCut, or what is wrong and where. kDone when the visitor wants no more.
  [[nodiscard]] Finding read(Visitor& visitor);

  /// Chunks that were given so far, of the model too.
  [[nodiscard]] uint32_t chunk_count() const { return chunks_.count(); }

 private:
  [[nodiscard]] Finding take(const container::Chunk& chunk, Visitor& visitor);
  [[nodiscard]] Finding take_rows(const container::Chunk& chunk, Visitor& visitor);
  [[nodiscard]] Finding take_hashes(const container::Chunk& chunk, Visitor& visitor) const;
  [[nodiscard]] Finding take_change(const container::Chunk& chunk, Visitor& visitor) const;
  [[nodiscard]] Finding take_snapshot(const container::Chunk& chunk, Visitor& visitor);
  [[nodiscard]] Finding check_part(const container::Chunk& chunk, const SnapshotPart& part) const;

  container::ChunkReader chunks_;
  container::Chunk first_{};  // behind the start
  Finding finding_ = Finding::nothing();
  std::string profile_;
  uint32_t tick_ = 0;
  bool is_at_start_ = true;
  SnapshotPart part_{};  // the last one; complete unless state_bytes is above its end
  std::array<TickRow, kMostRows> rows_{};
};

}  // namespace palpate::recording
