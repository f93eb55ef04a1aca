// What docs/container-format.md shows is what the code reads and writes.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "palpate/firmware/model_container.hpp"
#include "support/containers.hpp"

namespace palpate::test {
namespace {

std::string read_document() {
  std::ifstream file(PALPATE_SOURCE_FOLDER "/docs/container-format.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The bytes of the block ```hex: lines of an offset, a colon, bytes in hex, and words after more than one
/// space. Every offset must be right.
File example_bytes() {
  const std::string text = read_document();
  const std::string fence = "```hex\n";
  const std::size_t begin = text.find(fence) + fence.size();
  std::istringstream block(text.substr(begin, text.find("```", begin) - begin));
  File file;
  for (std::string line; std::getline(block, line);) {
    std::istringstream words(line.substr(4, line.find("  ", 4) - 4));
    EXPECT_EQ(std::stoul(line.substr(0, 2), nullptr, 16), file.size()) << line;
    for (std::string word; words >> word;) {
      file.push_back(static_cast<uint8_t>(std::stoul(word, nullptr, 16)));
    }
  }
  return file;
}

TEST(Document, HasTheBytesThatAreWritten) {
  EXPECT_EQ(example_bytes(), file_of(Kind::kRecording, {{Tag::of("ROWS"), 1, true, {1, 2, 3, 4, 5}}}));
}

TEST(Document, HasBytesThatAreRead) {
  const File file = example_bytes();
  const Reading reading = read_all(file, Kind::kRecording);
  ASSERT_EQ(reading.last.status, ReadStatus::kEnd);
  ASSERT_EQ(reading.chunks.size(), 1u);
  EXPECT_EQ(as_written(reading.chunks[0]).payload, (File{1, 2, 3, 4, 5}));
}

TEST(Document, HasTheChunksOfAModel) {
  const std::string text = read_document();
  for (const container::ChunkRule& rule : firmware::model_detail::kRules) {
    const std::string tag = {rule.tag.at(0), rule.tag.at(1), rule.tag.at(2), rule.tag.at(3)};
    std::string row = "| `";
    row.append(tag).append("` | ").append(std::to_string(rule.least_length));
    if (rule.least_length != rule.most_length) row.append(" to ").append(std::to_string(rule.most_length));
    row.append(" |");
    EXPECT_NE(text.find(row), std::string::npos) << row;
  }
}

TEST(Document, HasTheLimits) {
  const std::string text = read_document();
  EXPECT_NE(text.find("at most " + std::to_string(container::kMostPayloadBytes) + " |"), std::string::npos);
  EXPECT_NE(text.find("at most " + std::to_string(container::kMostChunks) + " |"), std::string::npos);
}

}  // namespace
}  // namespace palpate::test
