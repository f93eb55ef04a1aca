// A firmware at the other end of a link (docs/wire-protocol.md).
#pragma once

#include <functional>

#include "hil/controller.hpp"
#include "palpate/link/frame_reader.hpp"
#include "palpate/link/frame_writer.hpp"

namespace palpate::sim {

/// The two ends of a link, as files that are open.
struct LinkFiles {
  int to_firmware;
  int from_firmware;
};

class LinkController final : public Controller {
 public:
  explicit LinkController(const LinkFiles& files);

  /// The wish goes before the sensors, so that it is of the same tick. Throws EnvironmentError when the
  /// firmware is gone or does not answer.
  link::ActuatorsMessage answer(const link::SensorsMessage& sensors, const UserWish& wish) override;

  /// Asks the firmware to end its run.
  void end_run();

  /// Called now and then while nothing comes; may throw.
  std::function<void()> on_silence = [] {};
  /// Sees frames of other messages than answers: telemetry.
  std::function<void(const link::Frame&)> on_frame = [](const link::Frame&) {};

  [[nodiscard]] const link::ReaderCounters& counters() const { return reader_.counters(); }

 private:
  template <class Message>
  void send(const Message& message);
  link::Frame receive();

  LinkFiles files_;
  link::FrameReader reader_;
  link::FrameWriter writer_;
  std::array<uint8_t, 4096> buffer_{};
  std::size_t received_ = 0;  // of buffer_
  std::size_t taken_ = 0;
};

}  // namespace palpate::sim
