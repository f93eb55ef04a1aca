// A state from its bytes. They are believed once all checks hold: against accidents, not against intent.
#pragma once

#include <cstring>

#include "palpate/firmware/cycle.hpp"
#include "palpate/firmware/state_layout.hpp"
#include "recording/format.hpp"

namespace palpate::recording {

/// Whether the bytes are of a state as this program has it.
template <class Profile>
[[nodiscard]] Finding check_layout(const SnapshotPart& part) {
  const auto refuse = [&part](const char* field, uint64_t expected, uint64_t found) {
    const auto number = static_cast<int64_t>(expected);
    return Finding{ReadStatus::kContradiction, part.place, kSnapshotTag, field, number, number,
                   static_cast<int64_t>(found)};
  };
  constexpr uint32_t kSize = sizeof(firmware::CycleState<Profile>);
  constexpr uint64_t kLayout = firmware::layout_fingerprint<Profile>();
  if (part.state_bytes != kSize) return refuse("bytes of the state", kSize, part.state_bytes);
  if (part.fingerprint != kLayout) return refuse("layout", kLayout, part.fingerprint);
  return Finding::nothing();
}

/// Takes the parts one after the other, each of which fits check_layout and comes from a reader. kDone after
/// the last one: the state is the one that was recorded; its hash says so.
template <class Profile>
[[nodiscard]] Finding restore(const SnapshotPart& part, firmware::CycleState<Profile>& state) {
  const Finding finding = check_layout<Profile>(part);
  if (!finding.is_done()) return finding;
  std::memcpy(reinterpret_cast<unsigned char*>(&state) + part.offset, part.bytes.data, part.bytes.size);
  if (!part.is_last()) return finding;
  const uint64_t hash = firmware::state_hash(state);
  if (hash == part.state_hash) return finding;
  return {ReadStatus::kContradiction,
          part.place,
          kSnapshotTag,
          "hash of the state",
          static_cast<int64_t>(part.state_hash),
          static_cast<int64_t>(part.state_hash),
          static_cast<int64_t>(hash)};
}

}  // namespace palpate::recording
