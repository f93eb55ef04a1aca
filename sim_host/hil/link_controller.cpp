#include "hil/link_controller.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "palpate/link/telemetry_messages.hpp"
#include "scenario/errors.hpp"

namespace palpate::sim {
namespace {

constexpr int kSilenceMs = 500;
/// Only a firmware that hangs is silent for a minute: an emulated tick takes a few ms.
constexpr int kMostSilences = 120;

}  // namespace

LinkController::LinkController(const LinkFiles& files) : files_(files) {}

template <class Message>
void LinkController::send(const Message& message) {
  link::WireFrame wire;
  writer_.write(Message::kType, link::encode(message), wire);
  std::size_t sent = 0;
  while (sent < wire.size()) {
    const ssize_t count = ::write(files_.to_firmware, wire.data() + sent, wire.size() - sent);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      throw EnvironmentError(fmt::format("the link to the firmware is closed: {}", std::strerror(errno)));
    }
    sent += static_cast<std::size_t>(count);
  }
}

link::Frame LinkController::receive() {
  int silences = 0;
  for (;;) {
    while (taken_ < received_) {
      if (reader_.push(buffer_[taken_++])) return reader_.frame();
    }
    pollfd ready{files_.from_firmware, POLLIN, 0};
    const int count = ::poll(&ready, 1, kSilenceMs);
    if (count < 0 && errno == EINTR) continue;
    if (count == 0) {
      on_silence();
      if (++silences == kMostSilences) throw EnvironmentError("the firmware does not answer");
      continue;
    }
    silences = 0;
    const ssize_t size = ::read(files_.from_firmware, buffer_.data(), buffer_.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) throw EnvironmentError("the firmware has closed the link");
    received_ = static_cast<std::size_t>(size);
    taken_ = 0;
  }
}

link::ActuatorsMessage LinkController::answer(const link::SensorsMessage& sensors, const UserWish& wish) {
  if (!wish.is_nothing()) {
    send(link::CommandMessage{wish.requests.bits(), wish.change.setting, wish.change.value, false});
  }
  send(sensors);
  for (;;) {
    const link::Frame frame = receive();
    link::ActuatorsMessage answer{};
    if (link::decode(frame, answer) != link::DecodeStatus::kDone) {
      on_frame(frame);
      continue;
    }
    if (answer.tick == sensors.tick) return answer;
    throw EnvironmentError(
        fmt::format("the firmware answers tick {} instead of {}", answer.tick, sensors.tick));
  }
}

void LinkController::end_run() { send(link::CommandMessage{0, 0, 0, true}); }

}  // namespace palpate::sim
