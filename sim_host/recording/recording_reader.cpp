#include "recording/recording_reader.hpp"

#include "palpate/container/chunk_table.hpp"
#include "recording/profiles.hpp"

namespace palpate::recording {
namespace {

using container::Chunk;
using container::ChunkRule;
using container::FieldReader;
using firmware::model_detail::kParts;

constexpr std::size_t kProfilePart = kParts;
constexpr std::size_t kSafetyPart = kParts + 1;

/// The model's, and those around it.
constexpr std::array<ChunkRule, kParts + 2> make_rules() {
  std::array<ChunkRule, kParts + 2> rules{};
  for (std::size_t i = 0; i < kParts; ++i) rules[i] = firmware::model_detail::kRules[i];
  rules[kProfilePart] = {kProfileTag, kVersion, 1, kMostProfileBytes, false};
  rules[kSafetyPart] = {kSafetyTag, kVersion, kSafetyBytes, kSafetyBytes, false};
  return rules;
}
constexpr std::array<ChunkRule, kParts + 2> kRules = make_rules();

bool is_of_the_run(Tag tag) {
  return tag == kRowsTag || tag == kHashesTag || tag == kChangeTag || tag == kSnapshotTag;
}

Finding refuse(const Chunk& chunk, ReadStatus status, const char* field, int64_t expected, int64_t found) {
  return {status, chunk.offset, chunk.tag, field, expected, expected, found};
}

std::string text_of(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data), bytes.size}; }

Finding read_safety(const Chunk& chunk, Start& start) {
  FieldReader fields(chunk);
  safety_fields(fields, start.is_guarded, start.parameters);
  const Finding finding = fields.finish();
  if (!finding.is_done() || safety::is_usable(start.parameters)) return finding;
  return refuse(chunk, ReadStatus::kContradiction, "usable thresholds", 1, 0);
}

Finding read_start(const std::array<Chunk, kParts + 2>& chunks, Start& start) {
  start.profile = text_of(chunks[kProfilePart].payload);
  start.scenario = text_of(chunks[firmware::model_detail::kName].payload);
  if (!is_profile(start.profile)) {
    return refuse(chunks[kProfilePart], ReadStatus::kOutOfRange, "profiles of this name", 1, 0);
  }
  std::array<Chunk, kParts> model{};
  for (std::size_t i = 0; i < kParts; ++i) model[i] = chunks[i];
  const Finding finding = firmware::read_model_chunks(model, deepest_level(start.profile), start.model);
  return finding.is_done() ? read_safety(chunks[kSafetyPart], start) : finding;
}

/// What is not about this tick is in the wrong place.
Finding check_tick(const Chunk& chunk, uint32_t expected, uint32_t found) {
  if (found == expected) return Finding::nothing();
  return refuse(chunk, ReadStatus::kContradiction, "tick", expected, found);
}

}  // namespace

Finding RecordingReader::open(Start& start) {
  std::array<Chunk, kParts + 2> chunks{};
  Finding misfit = Finding::nothing();
  finding_ = chunks_.open(container::Kind::kRecording);
  while (finding_.is_done() && (finding_ = chunks_.next(first_)).is_done() && !is_of_the_run(first_.tag)) {
    if (misfit.is_done()) misfit = container::table_detail::sort_in(first_, kRules, chunks);
  }
  // A damaged file is called damaged, whatever else may be said of it.
  if (!finding_.is_done() && finding_.status != ReadStatus::kEnd && finding_.status != ReadStatus::kCut) {
    return finding_;
  }
  if (!misfit.is_done()) return finding_ = misfit;
  Finding end = finding_;
  end.offset = finding_.is_done() ? first_.offset : finding_.offset;
  const Finding missing = container::table_detail::find_missing(end, kRules, chunks);
  if (!missing.is_done()) {
    if (finding_.status != ReadStatus::kCut) finding_ = missing;
    return finding_;
  }
  const Finding wrong = read_start(chunks, start);
  if (!wrong.is_done()) return finding_ = wrong;
  profile_ = start.profile;
  return wrong;
}

Finding RecordingReader::read(Visitor& visitor) {
  Chunk chunk = first_;
  while (finding_.is_done() && visitor.wants_more()) {
    finding_ = take(chunk, visitor);
    if (finding_.is_done()) finding_ = chunks_.next(chunk);
  }
  return finding_;
}

Finding RecordingReader::take(const Chunk& chunk, Visitor& visitor) {
  if (!is_of_the_run(chunk.tag)) {
    // Of the start, too late and so for the second time; or unknown.
    for (const ChunkRule& rule : kRules) {
      if (rule.tag == chunk.tag) return refuse(chunk, ReadStatus::kDuplicateChunk, nullptr, 1, 2);
    }
    return chunk.is_required ? refuse(chunk, ReadStatus::kUnknownChunk, nullptr, 0, 1) : Finding::nothing();
  }
  if (chunk.version != kVersion) {
    return refuse(chunk, ReadStatus::kFutureChunk, nullptr, kVersion, chunk.version);
  }
  if (chunk.tag != kSnapshotTag && !part_.is_last()) {
    return refuse(chunk, ReadStatus::kContradiction, "bytes of the snapshot before", part_.state_bytes,
                  part_.offset + part_.bytes.size);
  }
  Finding finding = Finding::nothing();
  if (chunk.tag == kRowsTag) finding = take_rows(chunk, visitor);
  if (chunk.tag == kHashesTag) finding = take_hashes(chunk, visitor);
  if (chunk.tag == kChangeTag) finding = take_change(chunk, visitor);
  if (chunk.tag == kSnapshotTag) finding = take_snapshot(chunk, visitor);
  is_at_start_ = false;
  return finding;
}

Finding RecordingReader::take_rows(const Chunk& chunk, Visitor& visitor) {
  FieldReader fields(chunk);
  uint32_t first = 0;
  uint32_t count = 0;
  fields.number("first tick", first, tick_ + 1, tick_ + 1);
  fields.number("rows", count, 1, kMostRows);
  for (uint32_t i = 0; fields.is_right() && i < count; ++i) row_fields(fields, rows_[i]);
  const Finding finding = fields.finish();
  if (!finding.is_done()) return finding;
  for (uint32_t i = 0; i < count && visitor.wants_more(); ++i) visitor.see_row(first + i, rows_[i]);
  tick_ += count;
  return finding;
}

Finding RecordingReader::take_hashes(const Chunk& chunk, Visitor& visitor) const {
  FieldReader fields(chunk);
  HashPoint point{};
  hash_fields(fields, point);
  Finding finding = fields.finish();
  if (finding.is_done()) finding = check_tick(chunk, tick_, point.tick);
  if (finding.is_done()) visitor.see_hashes(point);
  return finding;
}

Finding RecordingReader::take_change(const Chunk& chunk, Visitor& visitor) const {
  FieldReader fields(chunk);
  uint32_t tick = 0;
  firmware::SettingChange change{};
  change_fields(fields, tick, change);
  Finding finding = fields.finish();
  if (finding.is_done()) finding = check_tick(chunk, tick_, tick);
  if (finding.is_done()) visitor.see_change(tick, change);
  return finding;
}

Finding RecordingReader::take_snapshot(const Chunk& chunk, Visitor& visitor) {
  if (chunk.payload.size <= kSnapshotHeadBytes) {
    return refuse(chunk, ReadStatus::kWrongLength, nullptr, kSnapshotHeadBytes + 1, chunk.payload.size);
  }
  Chunk head = chunk;
  head.payload.size = kSnapshotHeadBytes - kMostProfileBytes;
  FieldReader fields(head);
  SnapshotPart part{};
  snapshot_fields(fields, part);
  part.bytes = chunk.payload.part(kSnapshotHeadBytes, chunk.payload.size - kSnapshotHeadBytes);
  part.place = chunk.offset;
  Finding finding = fields.finish();
  if (finding.is_done()) finding = check_part(chunk, part);
  if (!finding.is_done()) return finding;
  if (is_at_start_) tick_ = part.tick;
  part_ = part;
  visitor.see_snapshot(part);
  return finding;
}

Finding RecordingReader::check_part(const Chunk& chunk, const SnapshotPart& part) const {
  std::string name = text_of(chunk.payload.part(kSnapshotHeadBytes - kMostProfileBytes, kMostProfileBytes));
  name.erase(std::min(name.find('\0'), name.size()));
  if (name != profile_) return refuse(chunk, ReadStatus::kContradiction, "name of the profile", 1, 0);
  const bool goes_on = !part_.is_last();
  const uint32_t offset = goes_on ? part_.offset + part_.bytes.size : 0;
  if (part.offset != offset) {
    return refuse(chunk, ReadStatus::kContradiction, "offset of the bytes", offset, part.offset);
  }
  if (part.bytes.size > part.state_bytes - offset || part.state_bytes < offset) {
    return refuse(chunk, ReadStatus::kContradiction, "bytes of the state", offset + part.bytes.size,
                  part.state_bytes);
  }
  const bool is_other = part.state_bytes != part_.state_bytes || part.fingerprint != part_.fingerprint ||
                        part.state_hash != part_.state_hash;
  if (goes_on && is_other) {
    return refuse(chunk, ReadStatus::kContradiction, "parts of one snapshot", 1, 0);
  }
  if (is_at_start_) return Finding::nothing();
  return check_tick(chunk, tick_, part.tick);
}

}  // namespace palpate::recording
