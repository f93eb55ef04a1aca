// `replay` and `inspect` as a user calls them.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "program.hpp"
#include "support/recordings.hpp"

namespace palpate::test {
namespace {

void write_file(const std::filesystem::path& path, const File& file) {
  write_text(path, std::string(file.begin(), file.end()));
}

File with_a_changed_count() {
  auto chunks = chunks_of_recording(recorded_drag(50, {20, 0}));
  chunks[find_chunk(chunks, "TICK", 3)].payload[8 + recording::kRowBytes * 7] ^= 1;
  return recording_of(chunks);
}

TEST(ReplayCommand, SaysThatItIsTheSame) {
  const TemporaryFolder folder;
  write_file(folder / "drag.plp", recorded_drag(50, {20, 40}));
  const Outcome whole = run_program(folder, "replay drag.plp");
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_NE(whole.out.find("ticks 1 to 142 of drag, profile small"), std::string::npos) << whole.out;
  EXPECT_NE(whole.out.find("the same: every tick's codes and state, and 8 hash points"), std::string::npos);
  const Outcome part = run_program(folder, "replay drag.plp --from-tick 90");
  EXPECT_EQ(part.exit_code, 0) << part.err;
  EXPECT_NE(part.out.find("ticks 81 to 142 of drag"), std::string::npos) << part.out;
}

TEST(ReplayCommand, NamesTheFirstDifference) {
  const TemporaryFolder folder;
  write_file(folder / "drag.plp", with_a_changed_count());
  const Outcome outcome = run_program(folder, "replay drag.plp");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("NOT the same: tick 69, "), std::string::npos) << outcome.out;
}

TEST(ReplayCommand, SaysThatTheRecordingIsCut) {
  const TemporaryFolder folder;
  File file = recorded_drag(50, {20, 0});
  file.resize(file.size() - 500);
  write_file(folder / "drag.plp", file);
  const Outcome outcome = run_program(folder, "replay drag.plp");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("the recording is cut off at byte "), std::string::npos) << outcome.out;
}

TEST(RecordingCommands, RefuseADamagedFileWithItsPlace) {
  const TemporaryFolder folder;
  File file = recorded_drag(5);
  file[100] ^= 1;
  write_file(folder / "damaged.plp", file);
  write_text(folder / "other.plp", "no recording");
  write_file(folder / "empty.plp", {});
  for (const char* command : {"replay", "inspect"}) {
    for (const auto& [name, part] : {std::pair{"damaged.plp", "at byte 72 in chunk BLCK: chunk damaged"},
                                     {"other.plp", "at byte 0: not a container"},
                                     {"empty.plp", "at byte 0: cut off"},
                                     {"none.plp", "cannot read 'none.plp': No such file or directory"},
                                     {".", "cannot read '.': it is not a file"}}) {
      const Outcome outcome = run_program(folder, fmt::format("{} {}", command, name));
      EXPECT_EQ(outcome.exit_code, 2) << name;
      EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
      expect_one_line(outcome.err);
    }
  }
}

TEST(InspectCommand, PrintsTextOrJson) {
  const TemporaryFolder folder;
  write_file(folder / "drag.plp", recorded_drag(50, {20, 40}));
  const Outcome text = run_program(folder, "inspect drag.plp");
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("drag: 142 ticks, 0.142 s, whole"), std::string::npos) << text.out;
  const Outcome json = run_program(folder, "inspect drag.plp --json");
  EXPECT_EQ(json.exit_code, 0) << json.err;
  EXPECT_EQ(nlohmann::json::parse(json.out)["ticks"], 142);
}

TEST(InspectCommand, WritesPictures) {
  const TemporaryFolder folder;
  write_file(folder / "drag.plp", recorded_drag(50, {20, 40}));
  const Outcome outcome = run_program(folder, "inspect drag.plp --out pictures");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* name : {"counts.svg", "codes.svg", "state.svg"}) {
    EXPECT_NE(read_text(folder / "pictures" / name).find("</svg>"), std::string::npos) << name;
  }
  EXPECT_EQ(nlohmann::json::parse(read_text(folder / "pictures" / "inspection.json"))["snapshots"], 3);
}

}  // namespace
}  // namespace palpate::test
