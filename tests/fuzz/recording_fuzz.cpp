// Any bytes as a recording. The reader may only say what it thinks of them: it reads nothing outside of them,
// it ends, rows come in order, and a look at it and a run of a few ticks end too.
//
// Random bytes never pass a check, so the input changes bytes of a good recording, whose checks are then made
// right: triples of a place, two bytes, and what is added there. The first byte says how it is used. Bytes of
// snapshots are believed, so the sample has none that a replay could take.
#include "recording/inspection.hpp"
#include "recording/replay.hpp"
#include "support/recordings.hpp"
#include "support/repair.hpp"

namespace palpate::test {
namespace {

/// Stops the fuzzer with this input.
void require(bool holds) {
  if (!holds) __builtin_trap();
}

/// Rows that go on, and nothing outside of the file.
class Examiner final : public recording::Visitor {
 public:
  explicit Examiner(const File& file) : file_(file) {}
  void see_row(uint32_t tick, const recording::TickRow& /*row*/) override {
    require(!has_rows_ || tick == last_ + 1);
    last_ = tick;
    has_rows_ = true;
  }
  void see_snapshot(const recording::SnapshotPart& part) override {
    require(part.bytes.data >= file_.data() &&
            part.bytes.data + part.bytes.size <= file_.data() + file_.size());
    require(part.offset + part.bytes.size <= part.state_bytes);
  }

 private:
  const File& file_;
  uint32_t last_ = 0;
  bool has_rows_ = false;
};

void examine(const File& file, bool runs) {
  recording::RecordingReader reader(bytes_of(file));
  recording::Start start;
  Finding finding = reader.open(start);
  Examiner examiner(file);
  if (finding.is_done()) finding = reader.read(examiner);
  require(finding.status != ReadStatus::kDone);
  require(finding.offset <= file.size());
  const recording::Inspection inspection = recording::inspect(bytes_of(file));
  require(inspection.finding.status == finding.status);
  if (inspection.is_usable()) require(!recording::inspection_text(inspection).empty());
  // A run takes long, and with larger profiles too long.
  if (!runs || !inspection.is_usable() || inspection.snapshots != 0 || start.profile != "small") return;
  const auto go_on = [](const recording::Mismatch&) { return true; };
  require(recording::replay(bytes_of(file), {}, go_on).finding.status == finding.status);
}

const File& sample() {
  static const File file = [] {
    RecordedRun run(true, {3, 0});
    run.run(3);
    run.change({3, 7});
    run.run(3);
    // A snapshot as it might be, but for its bytes.
    auto chunks = chunks_of_recording(run.end());
    Written snapshot{Tag::of("SNAP"), 1, true, File(recording::kSnapshotHeadBytes + 8, 0)};
    container::put_u32(snapshot.payload.data(), 6);
    container::put_u32(snapshot.payload.data() + 4, 8);
    const std::string name = Small::kName;
    std::copy(name.begin(), name.end(), snapshot.payload.begin() + 32);
    chunks.push_back(snapshot);
    return recording_of(chunks);
  }();
  return file;
}

void try_input(uint8_t use, const uint8_t* data, std::size_t size) {
  File file = sample();
  for (std::size_t i = 0; i + 3 <= size; i += 3) {
    uint8_t& byte = file[container::get_u16(data + i) % file.size()];
    byte = static_cast<uint8_t>(byte + data[i + 2]);
  }
  if (use % 2 != 0) {
    auto chunks = chunks_of_recording(sample());
    chunks.pop_back();
    file = recording_of(chunks);
    for (std::size_t i = 0; i + 3 <= size; i += 3) {
      uint8_t& byte = file[container::get_u16(data + i) % file.size()];
      byte = static_cast<uint8_t>(byte + data[i + 2]);
    }
  }
  if (use % 4 < 3) repair(file);
  if (use % 8 >= 6) file.resize(file.size() * use / 256);
  examine(file, use == 1);
}

}  // namespace
}  // namespace palpate::test

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  if (size > 0) palpate::test::try_input(data[0], data + 1, size - 1);
  return 0;
}
