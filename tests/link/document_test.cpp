// docs/wire-protocol.md is read: its tables, its example and its bandwidth are those of the code.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "palpate/safety/event.hpp"
#include "palpate/telemetry/frame_source.hpp"
#include "support/link_messages.hpp"
#include "support/link_reference.hpp"

namespace palpate::test {
namespace {

std::string read_page() {
  std::ifstream file(PALPATE_SOURCE_FOLDER "/docs/wire-protocol.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The text from "## title" to the next heading.
std::string section(const std::string& title) {
  const std::string page = read_page();
  const std::size_t begin = page.find("\n## " + title + "\n");
  if (begin == std::string::npos) return {};
  return page.substr(begin, page.find("\n## ", begin + 1) - begin);
}

/// "sensors frame 00 07 ..." under its first two words.
std::map<std::string, Bytes> example() {
  std::map<std::string, Bytes> lines;
  std::istringstream text(section("Example"));
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string message;
    std::string part;
    words >> message >> part;
    if (message != "sensors" && message != "actuators") continue;
    Bytes& bytes = lines[message.append(" ").append(part)];
    for (unsigned value = 0; words >> std::hex >> value;) bytes.push_back(static_cast<uint8_t>(value));
  }
  return lines;
}

const link::SensorsMessage kSensors{1000, {-120, 0, 4660}, {2048, 2048, 2048}, 1, false, false, false};
const link::ActuatorsMessage kActuators{1000, {2048, 2101, 1990}, {true, true, true}, true, 0, 6, 0, 8};

template <class Message>
void expect_example(const std::string& name, const Message& message, uint16_t sequence) {
  std::map<std::string, Bytes> lines = example();
  const link::Payload payload = link::encode(message);
  EXPECT_EQ(lines[name + " body"], reference_body(1, static_cast<uint8_t>(Message::kType), sequence,
                                                  Bytes(payload.begin(), payload.end())));
  EXPECT_EQ(lines[name + " encoded"], reference_cobs(lines[name + " body"]));
  EXPECT_EQ(lines[name + " check"], check_bytes(lines[name + " encoded"]));
  link::FrameWriter writer;
  Bytes frame;
  for (uint32_t i = 0; i <= sequence; ++i) frame = written(writer, Message::kType, payload);
  EXPECT_EQ(lines[name + " frame"], frame);

  const Reading reading = read_stream(lines[name + " frame"]);
  ASSERT_EQ(reading.frames.size(), 1u);
  EXPECT_EQ(reading.frames[0].sequence, sequence);
  Message received{};
  ASSERT_EQ(link::decode(reading.frames[0], received), link::DecodeStatus::kDone);
  EXPECT_TRUE(is_same(received, message));
}

TEST(WireDocument, HasTheBytesOfItsExample) {
  expect_example("sensors", kSensors, 1000);
  expect_example("actuators", kActuators, 997);
}

struct MessageTitle {
  const char* title;
  link::MessageType type;
};
constexpr MessageTitle kMessages[] = {{"Sensors", link::MessageType::kSensors},
                                      {"Actuators", link::MessageType::kActuators},
                                      {"Command", link::MessageType::kCommand},
                                      {"Telemetry", link::MessageType::kTelemetry},
                                      {"Stage cycles", link::MessageType::kStageCycles},
                                      {"Counters", link::MessageType::kCounters},
                                      {"Motors", link::MessageType::kMotors},
                                      {"Inputs", link::MessageType::kInputs}};

struct Row {
  uint32_t offset, bytes;
  std::string type;
  std::string content;  // its first word
};

/// The rows "| offset | bytes | type | content |" of all tables of a section; of those without a type, the
/// content stands in its place.
std::vector<Row> rows(const std::string& title) {
  std::vector<Row> all;
  std::istringstream text(section(title));
  for (std::string line; std::getline(text, line);) {
    if (line.rfind("| ", 0) != 0) continue;
    Row row{};
    char bar = 0;
    std::istringstream words(line);
    if (!(words >> bar >> row.offset >> bar >> row.bytes >> bar >> row.type)) continue;
    words >> bar >> row.content;
    all.push_back(row);
  }
  return all;
}

uint32_t size_of(const std::string& type) {
  if (type == "u8") return 1;
  if (type == "u16" || type == "i16") return 2;
  return type == "u32" || type == "i32" ? 4 : 0;
}

TEST(WireDocument, HasTablesThatCoverThePayload) {
  for (const auto& [title, type] : kMessages) {
    uint32_t next = 0;
    for (const Row& row : rows(title)) {
      EXPECT_EQ(row.offset, next) << title;
      // Reserved bytes stand in one row.
      EXPECT_TRUE(row.bytes == size_of(row.type) || (row.type == "u8" && row.content == "0"))
          << title << " " << row.offset;
      next += row.bytes;
    }
    EXPECT_EQ(next, link::kPayloadSize) << title;
  }
}

TEST(WireDocument, HasEveryMessageWithItsType) {
  for (const auto& [title, type] : kMessages) {
    const std::string number = "\nType " + std::to_string(static_cast<int>(type)) + ", ";
    EXPECT_NE(section(title).find(number), std::string::npos) << title;
  }
  EXPECT_EQ(std::size(kMessages), static_cast<std::size_t>(link::kLastMessageType));
}

/// "bit n" of a request, of the safety layer's names.
TEST(WireDocument, HasTheBitsOfEveryRequest) {
  const std::string text = section("Command");
  for (uint32_t bit = 0; bit < safety::kEventCount; ++bit) {
    const auto event = static_cast<safety::Event>(bit);
    std::string row = "| " + std::to_string(bit);
    row.append(" | ").append(safety::event_name(event)).append(" |\n");
    EXPECT_EQ(text.find(row) != std::string::npos, safety::kRequests.has(event)) << row;
    EXPECT_EQ((link::kRequestBits >> bit & 1u) != 0, safety::kRequests.has(event)) << row;
  }
}

TEST(WireDocument, HasTheBitsOfEveryCondition) {
  std::string all;
  for (uint32_t bit = 0; bit < safety::kConditionCount; ++bit) {
    all.append(bit == 0 ? "" : ", ").append(safety::condition_name(static_cast<safety::Condition>(bit)));
  }
  std::string text = section("Telemetry");
  std::replace(text.begin(), text.end(), '\n', ' ');
  EXPECT_NE(text.find(all), std::string::npos) << all;
}

TEST(WireDocument, HasTheSizesOfAFrame) {
  const std::vector<Row> frame_and_body = rows("A frame");
  ASSERT_EQ(frame_and_body.size(), 8u);
  EXPECT_EQ(frame_and_body[1].bytes, link::kEncodedSize);
  EXPECT_EQ(frame_and_body[2].bytes, link::kCheckSize);
  EXPECT_EQ(frame_and_body[3].offset + 1, link::kWireSize);
  EXPECT_EQ(frame_and_body[7].offset, link::kHeaderSize);
  EXPECT_EQ(frame_and_body[7].bytes, link::kPayloadSize);
}

TEST(WireDocument, HasTheBandwidth) {
  const std::string text = section("Bandwidth");
  const auto says = [&text](std::size_t value, const char* unit) {
    return text.find(std::to_string(value) + unit) != std::string::npos;
  };
  EXPECT_TRUE(says(link::kWireSize, " frame bytes"));
  EXPECT_TRUE(says(link::kWireSize * 1000, " bytes/s"));
  EXPECT_TRUE(says(link::kWireSize * 1000 * 10, " baud"));
  EXPECT_TRUE(says(link::kWireSize * 2 * 10 * 2000, " baud"));
  // Of 100 ticks: a frame each, three more every kMotorsEvery, one more every kCountersEvery.
  const std::size_t frames = 100 + 3 * 100 / telemetry::kMotorsEvery + 100 / telemetry::kCountersEvery;
  EXPECT_TRUE(says(frames, " frames in 100 ticks"));
  EXPECT_TRUE(says(frames * link::kWireSize * 10, " bytes/s"));
}

}  // namespace
}  // namespace palpate::test
