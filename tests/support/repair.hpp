// Makes a damaged container look whole again, so that what is behind its checks is seen.
#pragma once

#include "support/containers.hpp"

namespace palpate::test {

/// Right checks wherever there is a chunk, and a seal that fits.
inline void repair(File& file) {
  if (file.size() < container::kFileHeaderBytes) return;
  renew_checks(file, 0);
  container::Crc32c seal;
  seal.add_u32(container::get_u32(file.data() + 12));
  uint32_t at = container::kFileHeaderBytes;
  for (uint32_t count = 0; file.size() - at >= container::kChunkHeaderBytes; ++count) {
    uint8_t* chunk = file.data() + at;
    const uint32_t length = container::get_u32(chunk + 8);
    container::put_u32(chunk + 12, container::crc32c(Bytes{chunk, 12}));
    if (length > container::kMostPayloadBytes || file.size() - at < container::chunk_bytes(length)) return;
    if (Tag{container::get_u32(chunk)} == container::kEndTag && length >= container::kEndPayloadBytes) {
      container::put_u32(chunk + container::kChunkHeaderBytes, count);
      container::put_u32(chunk + container::kChunkHeaderBytes + 4, seal.value());
    }
    renew_checks(file, at);
    at += container::chunk_bytes(length);
    seal.add_u32(container::get_u32(file.data() + at - container::kCheckBytes));
  }
}

}  // namespace palpate::test
