// Containers in memory: written piece by piece, damaged on purpose, read to their end.
#pragma once

#include <string>
#include <vector>

#include "palpate/container/chunk_reader.hpp"
#include "palpate/container/chunk_writer.hpp"

namespace palpate::container {

/// As gtest prints it.
inline std::ostream& operator<<(std::ostream& out, ReadStatus status) {
  return out << read_status_text(status);
}

}  // namespace palpate::container

namespace palpate::test {

using container::Bytes;
using container::Chunk;
using container::ChunkReader;
using container::ChunkWriter;
using container::Finding;
using container::Kind;
using container::ReadStatus;
using container::Tag;
using container::WriteStatus;

using File = std::vector<uint8_t>;

/// For chunks that a test makes up.
inline constexpr Tag kRows = Tag::of("ROWS");
inline constexpr Tag kNode = Tag::of("NODE");

inline Bytes bytes_of(const File& file) { return Bytes{file.data(), static_cast<uint32_t>(file.size())}; }
inline Bytes bytes_of(const std::string& text) {
  return Bytes{reinterpret_cast<const uint8_t*>(text.data()), static_cast<uint32_t>(text.size())};
}

/// Takes up to so many bytes.
class MemorySink {
 public:
  explicit MemorySink(std::size_t room = SIZE_MAX) : room_(room) {}
  bool operator()(const uint8_t* bytes, uint32_t size) {
    if (size > room_ - file.size()) return false;
    file.insert(file.end(), bytes, bytes + size);
    return true;
  }
  File file;

 private:
  std::size_t room_;
};

/// A chunk as a test says it.
struct Written {
  Tag tag;
  uint16_t version;
  bool is_required;
  File payload;
};

inline File file_of(Kind kind, const std::vector<Written>& chunks) {
  MemorySink sink;
  ChunkWriter<MemorySink> writer(sink);
  writer.begin(kind);
  for (const Written& chunk : chunks) {
    writer.begin_chunk(chunk.tag, chunk.version, chunk.is_required ? container::kRequiredFlag : uint16_t{0},
                       static_cast<uint32_t>(chunk.payload.size()));
    writer.put(bytes_of(chunk.payload));
    writer.end_chunk();
  }
  return writer.end() == WriteStatus::kDone ? sink.file : File{};
}

/// What a reader gives of a file, and what it says in the end.
struct Reading {
  std::vector<Chunk> chunks;
  Finding last;
};

inline Reading read_all(const File& file, Kind kind) {
  Reading reading{{}, Finding::nothing()};
  ChunkReader reader(bytes_of(file));
  reading.last = reader.open(kind);
  Chunk chunk{};
  while (reading.last.is_done() && (reading.last = reader.next(chunk)).is_done()) {
    reading.chunks.push_back(chunk);
  }
  return reading;
}

inline Written as_written(const Chunk& chunk) {
  return {chunk.tag, chunk.version, chunk.is_required,
          File(chunk.payload.data, chunk.payload.data + chunk.payload.size)};
}
inline bool operator==(const Written& a, const Written& b) {
  return a.tag == b.tag && a.version == b.version && a.is_required == b.is_required && a.payload == b.payload;
}

/// Makes the checks of the chunk at `offset` right again, and the file header's where it is 0.
inline void renew_checks(File& file, uint32_t offset) {
  uint8_t* at = file.data() + offset;
  container::put_u32(at + 12, container::crc32c(container::Bytes{at, 12}));
  if (offset == 0) return;
  const uint32_t before_check = container::chunk_bytes(container::get_u32(at + 8)) - container::kCheckBytes;
  container::Crc32c crc;
  crc.add(container::Bytes{at, 12});
  crc.add(container::Bytes{at + 16, before_check - 16});
  container::put_u32(at + before_check, crc.value());
}

}  // namespace palpate::test
