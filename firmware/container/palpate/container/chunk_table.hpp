// All of a file whose chunks are known by name and there once each, as models and snapshots are: collect()
// reads it to its end and lists them. Nothing of a file is used that is not whole.
#pragma once

#include "palpate/container/chunk_reader.hpp"

namespace palpate::container {

struct ChunkRule {
  Tag tag;
  uint16_t version;  // the only one that the reader knows
  uint32_t least_length, most_length;
  bool may_be_missing;
};

namespace table_detail {

template <std::size_t Rules>
Finding sort_in(const Chunk& chunk, const std::array<ChunkRule, Rules>& rules,
                std::array<Chunk, Rules>& chunks) {
  const auto refuse = [&chunk](ReadStatus status, int64_t expected, int64_t found) {
    return Finding::at(status, chunk.offset, chunk.tag, expected, found);
  };
  for (const uint32_t i : bounded<Rules>(Rules, [] {})) {
    const ChunkRule& rule = rules[i];
    if (chunk.tag != rule.tag) continue;
    if (chunks[i].offset != 0) return refuse(ReadStatus::kDuplicateChunk, chunks[i].offset, chunk.offset);
    if (chunk.version != rule.version) {
      return refuse(ReadStatus::kFutureChunk, rule.version, chunk.version);
    }
    if (chunk.payload.size < rule.least_length || chunk.payload.size > rule.most_length) {
      Finding finding = refuse(ReadStatus::kWrongLength, rule.least_length, chunk.payload.size);
      finding.most = rule.most_length;
      return finding;
    }
    chunks[i] = chunk;
    return Finding::nothing();
  }
  return chunk.is_required ? refuse(ReadStatus::kUnknownChunk, 0, 1) : Finding::nothing();
}

template <std::size_t Rules>
Finding find_missing(const Finding& end, const std::array<ChunkRule, Rules>& rules,
                     const std::array<Chunk, Rules>& chunks) {
  for (const uint32_t i : bounded<Rules>(Rules, [] {})) {
    if (chunks[i].offset != 0 || rules[i].may_be_missing) continue;
    return Finding::at(ReadStatus::kMissingChunk, end.offset, rules[i].tag, 1, 0);
  }
  return Finding::nothing();
}

}  // namespace table_detail

/// kDone with chunks[i] that of rules[i], its offset 0 if it may be missing and is; or the first thing that
/// is wrong. Chunks without a rule are skipped unless they are required. O(bytes + chunks x rules).
template <std::size_t Rules>
[[nodiscard]] Finding collect(Bytes file, Kind kind, const std::array<ChunkRule, Rules>& rules,
                              std::array<Chunk, Rules>& chunks) {
  for (const uint32_t i : bounded<Rules>(Rules, [] {})) chunks[i] = Chunk{};
  ChunkReader reader(file);
  Finding finding = reader.open(kind);
  Finding misfit = Finding::nothing();
  for ([[maybe_unused]] const uint32_t i : bounded<kMostChunks + 1>(kMostChunks + 1, [] {})) {
    if (!finding.is_done()) break;
    Chunk chunk{};
    finding = reader.next(chunk);
    if (finding.is_done() && misfit.is_done()) misfit = table_detail::sort_in(chunk, rules, chunks);
  }
  // A damaged file is called damaged, whatever else may be said of it.
  if (finding.status != ReadStatus::kEnd) return finding;
  return misfit.is_done() ? table_detail::find_missing(finding, rules, chunks) : misfit;
}

}  // namespace palpate::container
