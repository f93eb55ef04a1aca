// The simulator's end of a link, against firmwares that behave and ones that do not.
#include "hil/link_controller.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "palpate/link/telemetry_messages.hpp"
#include "scenario/errors.hpp"

namespace palpate::sim {
namespace {

using link::ActuatorsMessage;
using link::SensorsMessage;

/// A thread at the other end of a socket; what it does with each frame is the test's.
class Peer {
 public:
  using Answer = std::function<std::vector<uint8_t>(const link::Frame&, link::FrameWriter&)>;

  explicit Peer(Answer answer) {
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends_.data()), 0);
    std::signal(SIGPIPE, SIG_IGN);
    thread_ = std::thread([this, answer = std::move(answer)] { serve(answer); });
  }
  Peer(const Peer&) = delete;
  Peer(Peer&&) = delete;
  Peer& operator=(const Peer&) = delete;
  Peer& operator=(Peer&&) = delete;
  ~Peer() {
    ::shutdown(ends_[0], SHUT_RDWR);
    thread_.join();
    ::close(ends_[0]);
    ::close(ends_[1]);
  }
  [[nodiscard]] LinkFiles files() const { return {ends_[0], ends_[0]}; }

 private:
  void serve(const Answer& answer) const {
    link::FrameReader reader;
    link::FrameWriter writer;
    uint8_t byte = 0;
    while (::read(ends_[1], &byte, 1) == 1) {
      if (!reader.push(byte)) continue;
      const std::vector<uint8_t> bytes = answer(reader.frame(), writer);
      if (bytes.empty()) {
        ::shutdown(ends_[1], SHUT_RDWR);
        return;
      }
      if (::write(ends_[1], bytes.data(), bytes.size()) < 0) return;
    }
  }

  std::array<int, 2> ends_{};
  std::thread thread_;
};

template <class Message>
void append(const Message& message, link::FrameWriter& writer, std::vector<uint8_t>& bytes) {
  link::WireFrame wire;
  writer.write(Message::kType, link::encode(message), wire);
  bytes.insert(bytes.end(), wire.begin(), wire.end());
}

/// A zero: an idle line, and no end of the stream.
const std::vector<uint8_t> kNothing = {0};

ActuatorsMessage answer_to(const link::Frame& frame, uint32_t ahead = 0) {
  SensorsMessage sensors{};
  EXPECT_EQ(link::decode(frame, sensors), link::DecodeStatus::kDone);
  ActuatorsMessage answer{};
  answer.tick = sensors.tick + ahead;
  answer.motor_codes = {static_cast<uint16_t>(sensors.encoder_counts[0]), 1, 2};
  return answer;
}

TEST(LinkController, GetsTheAnswerOfItsTickAndSeesTheRest) {
  const Peer peer([](const link::Frame& frame, link::FrameWriter& writer) {
    if (frame.type != link::MessageType::kSensors) return kNothing;
    std::vector<uint8_t> bytes = {0x11, 0x22, 0x00};  // noise
    append(link::TelemetryMessage{7, 1, 0, 0, {}, {}, 0}, writer, bytes);
    append(answer_to(frame), writer, bytes);
    return bytes;
  });
  LinkController controller(peer.files());
  uint32_t telemetry = 0;
  controller.on_frame = [&telemetry](const link::Frame& frame) {
    telemetry += frame.type == link::MessageType::kTelemetry ? 1u : 0u;
  };
  for (uint32_t tick = 0; tick < 100; ++tick) {
    SensorsMessage sensors{};
    sensors.tick = tick;
    sensors.encoder_counts[0] = static_cast<int32_t>(3 * tick);
    const auto answer = controller.answer(sensors, {safety::EventSet::of(safety::Event::kEnable)});
    ASSERT_EQ(answer.tick, tick);
    ASSERT_EQ(answer.motor_codes[0], 3 * tick);
  }
  EXPECT_EQ(telemetry, 100u);
  EXPECT_EQ(controller.counters().lost_frames, 0u);
  EXPECT_EQ(controller.counters().bad_lengths, 100u);
}

TEST(LinkController, SendsAWishBeforeTheSensorsOfItsTick) {
  std::vector<link::MessageType> seen;
  std::vector<link::CommandMessage> commands;
  {
    const Peer peer([&](const link::Frame& frame, link::FrameWriter& writer) {
      seen.push_back(frame.type);
      link::CommandMessage command{};
      if (link::decode(frame, command) == link::DecodeStatus::kDone) commands.push_back(command);
      if (frame.type != link::MessageType::kSensors) return kNothing;
      std::vector<uint8_t> bytes;
      append(answer_to(frame), writer, bytes);
      return bytes;
    });
    LinkController controller(peer.files());
    SensorsMessage sensors{};
    (void)controller.answer(sensors, {});
    sensors.tick = 1;
    (void)controller.answer(sensors, {safety::EventSet::of(safety::Event::kDisable)});
    sensors.tick = 2;
    (void)controller.answer(sensors, {{}, {4, -7}});
  }
  using link::MessageType;
  EXPECT_EQ(seen,
            (std::vector<MessageType>{MessageType::kSensors, MessageType::kCommand, MessageType::kSensors,
                                      MessageType::kCommand, MessageType::kSensors}));
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(commands[0].requests, safety::EventSet::of(safety::Event::kDisable).bits());
  EXPECT_EQ(commands[0].setting, 0u);
  EXPECT_EQ(commands[1].requests, 0u);
  EXPECT_EQ(commands[1].setting, 4u);
  EXPECT_EQ(commands[1].value, -7);
}

TEST(LinkController, RefusesTheAnswerOfAnotherTick) {
  const Peer peer([](const link::Frame& frame, link::FrameWriter& writer) {
    std::vector<uint8_t> bytes;
    append(answer_to(frame, 1), writer, bytes);
    return bytes;
  });
  LinkController controller(peer.files());
  EXPECT_THROW((void)controller.answer(SensorsMessage{}, {}), EnvironmentError);
}

TEST(LinkController, SaysThatTheFirmwareIsGone) {
  const Peer peer([](const link::Frame&, link::FrameWriter&) { return std::vector<uint8_t>{}; });
  LinkController controller(peer.files());
  EXPECT_THROW((void)controller.answer(SensorsMessage{}, {}), EnvironmentError);
}

TEST(LinkController, AsksWhetherTheFirmwareLivesWhileItIsSilent) {
  const Peer peer([](const link::Frame&, link::FrameWriter&) { return kNothing; });
  LinkController controller(peer.files());
  controller.on_silence = [] { throw EnvironmentError("it has ended"); };
  EXPECT_THROW((void)controller.answer(SensorsMessage{}, {}), EnvironmentError);
}

}  // namespace
}  // namespace palpate::sim
