// docs/container-format.md has the recording's tables as the code has them.
#include <fstream>
#include <sstream>

#include "support/recordings.hpp"

namespace palpate::test {
namespace {

std::string recording_section() {
  std::ifstream file(PALPATE_SOURCE_FOLDER "/docs/container-format.md");
  std::stringstream text;
  text << file.rdbuf();
  const std::string page = text.str();
  return page.substr(std::min(page.find("\n## Recording\n"), page.size()));
}

/// The cells of each row whose table begins with this header.
std::vector<std::vector<std::string>> table(const std::string& header) {
  const std::string text = recording_section();
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text.substr(std::min(text.find(header), text.size())));
  std::string line;
  for (int i = 0; i < 2; ++i) std::getline(lines, line);
  while (std::getline(lines, line) && line.rfind("| ", 0) == 0) {
    std::vector<std::string> cells;
    for (std::size_t at = 2; at < line.size();) {
      const std::size_t end = line.find(" |", at);
      if (end == std::string::npos) break;
      cells.push_back(line.substr(at, end - at));
      at = end + 3;
    }
    rows.push_back(cells);
  }
  return rows;
}

TEST(RecordingDocument, HasTheSizesOfTheChunks) {
  const auto rows = table("| chunk | bytes | fields, in order |");
  using std::to_string;
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"`PROF`", "1 to " + to_string(recording::kMostProfileBytes)},
      {"`SAFE`", to_string(recording::kSafetyBytes)},
      {"`TICK`", to_string(recording::kRowsHeadBytes) + " + " + to_string(recording::kRowBytes) + " n"},
      {"`HASH`", to_string(recording::kHashesBytes)},
      {"`CHNG`", to_string(recording::kChangeBytes)},
      {"`SNAP`", to_string(recording::kSnapshotHeadBytes + 1) + " to " +
                     to_string(recording::kSnapshotHeadBytes + recording::kMostPartBytes)}};
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i][0], expected[i].first);
    EXPECT_EQ(rows[i][1], expected[i].second) << rows[i][0];
  }
  EXPECT_NE(recording_section().find("n, 1 to " + to_string(recording::kMostRows) + ";"), std::string::npos);
}

/// A row with another byte at each place: the document says which field that is.
TEST(RecordingDocument, HasTheFieldsOfARow) {
  const auto rows = table("| offset | bytes | type | content |");
  uint32_t next = 0;
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 4u);
    EXPECT_EQ(row[0], std::to_string(next));
    next += static_cast<uint32_t>(std::stoul(row[1]));
  }
  EXPECT_EQ(next, recording::kRowBytes);
  recording::TickRow row{};
  row.encoder_counts = {0x03020100, 0x07060504, 0x0b0a0908};
  row.timing = {0x0f0e0d0c, 0x13121110, true};
  row.requests = safety::EventSet::of_bits(0x07161514);
  row.reported = safety::ConditionSet::of_bits(0x1918);
  row.flags = 0x1f1e1d1c;
  row.gimbal = {0x2120, 0x2322, 0x2524};
  row.motor_codes = {0x0726, 0x0928, 0x0b2a};
  row.raised = safety::ConditionSet::of_bits(0x2d2c);
  row.buttons = 0x2e;
  row.device_status = 7;
  row.amplifiers_enabled = true;
  row.state = safety::State::kFault;
  row.fault = firmware::Fault::kModelRefused;
  MemorySink sink;
  ChunkWriter<MemorySink> writer(sink);
  container::FieldWriter<MemorySink> fields(writer);
  writer.begin(Kind::kRecording);
  writer.begin_chunk(Tag::of("TEST"), 1, 0, recording::kRowBytes);
  recording::row_fields(fields, row);
  writer.end_chunk();
  ASSERT_EQ(writer.end(), WriteStatus::kDone);
  const File expected = {0x00, 0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x07, 0x08, 0x09, 0x0a, 0x0b, 0x0c,
                         0x0d, 0x0e, 0x0f, 0x10, 0x11, 0x12, 0x13, 0x14, 0x15, 0x16, 0x07, 0x18, 0x19,
                         0x00, 0x00, 0x1c, 0x1d, 0x1e, 0x1f, 0x20, 0x21, 0x22, 0x23, 0x24, 0x25, 0x26,
                         0x07, 0x28, 0x09, 0x2a, 0x0b, 0x2c, 0x2d, 0x2e, 7,    1,    1,    7,    2};
  EXPECT_EQ(File(sink.file.begin() + 32, sink.file.begin() + 32 + recording::kRowBytes), expected);
}

TEST(RecordingDocument, HasTheSettings) {
  const auto rows = table("| setting | type | name | unit |");
  ASSERT_EQ(rows.size(), firmware::kSettings);
  for (uint16_t setting = 1; setting <= firmware::kSettings; ++setting) {
    EXPECT_EQ(rows[setting - 1u][0], std::to_string(setting));
    EXPECT_EQ(rows[setting - 1u][2], firmware::setting_name(setting));
  }
}

}  // namespace
}  // namespace palpate::test
