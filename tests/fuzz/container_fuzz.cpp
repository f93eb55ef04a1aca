// Any bytes as a container. The reader may only say what it thinks of them: it reads nothing outside of them,
// it ends, what it takes is written again as the very same bytes, and a model that it takes can be started.
//
// Random bytes never pass a check, so most inputs get right checks before they are read. The first byte of an
// input says how it is used.
#include <memory>

#include "palpate/firmware/cycle.hpp"
#include "palpate/tick/profiles.hpp"
#include "support/containers.hpp"
#include "support/repair.hpp"
#include "support/sample_model.hpp"

namespace palpate::test {
namespace {

using container::kChunkHeaderBytes;
using container::kFileHeaderBytes;

/// Stops the fuzzer with this input.
void require(bool holds) {
  if (!holds) __builtin_trap();
}

void require_inside(const File& file, const Chunk& chunk) {
  require(chunk.payload.data >= file.data() + kFileHeaderBytes + kChunkHeaderBytes);
  require(chunk.payload.data + chunk.payload.size <= file.data() + file.size());
  require(chunk.payload.data == file.data() + chunk.payload_offset());
}

void examine(const File& file, Kind kind) {
  const Reading reading = read_all(file, kind);
  require(reading.last.status != ReadStatus::kDone);
  require(reading.last.offset <= file.size());
  std::vector<Written> chunks;
  for (const Chunk& chunk : reading.chunks) {
    require_inside(file, chunk);
    chunks.push_back(as_written(chunk));
  }
  if (reading.last.status == ReadStatus::kEnd) require(file_of(kind, chunks) == file);
}

File encoded(const CycleModel& model) {
  MemorySink sink;
  require(firmware::write_model(sink, model, Bytes{nullptr, 0}) == WriteStatus::kDone);
  return sink.file;
}

void examine_model(const File& file, bool starts) {
  CycleModel model{};
  if (!firmware::read_model(bytes_of(file), Small::kMaxLevel, model).is_done()) return;
  CycleModel again{};
  require(firmware::read_model(bytes_of(encoded(model)), Small::kMaxLevel, again).is_done());
  require(encoded(again) == encoded(model));
  if (!starts) return;
  static const auto kState = std::make_unique<firmware::CycleState<Small>>();
  if (firmware::start(*kState, model) != Status::kDone) return;
  firmware::NoProbe probe;
  firmware::Actuators actuators{};
  for (const int32_t count : {0, 300})
    firmware::cycle(*kState, {{count, count, -count}, true}, actuators, probe);
}

/// The sample model with other bytes: triples of a place, two bytes, and what is added there.
File changed_model(const uint8_t* data, std::size_t size) {
  static const File kSample = encoded(sample_model());
  File file = kSample;
  for (std::size_t i = 0; i + 3 <= size; i += 3) {
    uint8_t& byte = file[container::get_u16(data + i) % file.size()];
    byte = static_cast<uint8_t>(byte + data[i + 2]);
  }
  return file;
}

/// Chunks as the input says: a byte of flags, a byte of length, the payload.
File written_chunks(const uint8_t* data, std::size_t size) {
  std::vector<Written> chunks;
  for (std::size_t at = 0; at + 2 <= size;) {
    const std::size_t length = std::min<std::size_t>(data[at + 1], size - at - 2);
    const uint8_t* payload = data + at + 2;
    chunks.push_back({Tag::of("ROWS"), data[at], data[at] % 2 != 0, File(payload, payload + length)});
    at += 2 + length;
  }
  const File file = file_of(Kind::kRecording, chunks);
  const Reading reading = read_all(file, Kind::kRecording);
  require(reading.last.status == ReadStatus::kEnd && reading.chunks.size() == chunks.size());
  return file;
}

void try_input(uint8_t use, const uint8_t* data, std::size_t size) {
  File file(data, data + size);
  if (use % 4 == 1) file = changed_model(data, size);
  if (use % 4 == 2) file = written_chunks(data, size);
  if (use % 4 == 3) {
    // The magic is right, so that what is behind it is seen.
    file.insert(file.begin(), container::kMagic, container::kMagic + 8);
  }
  if (use % 4 != 0) repair(file);
  for (const Kind kind : {Kind::kModel, Kind::kSnapshot, Kind::kRecording}) examine(file, kind);
  examine_model(file, use >= 128);
}

}  // namespace
}  // namespace palpate::test

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  if (size > 0) palpate::test::try_input(data[0], data + 1, size - 1);
  return 0;
}
