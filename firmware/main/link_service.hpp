// The firmware's end of the link, in the background: obeys commands and sends what the ticks left.
#pragma once

#include "palpate/link/frame_reader.hpp"
#include "palpate/link/frame_writer.hpp"
#include "palpate/telemetry/frame_source.hpp"
#include "run.hpp"

namespace palpate::firmware {

enum class LinkRequest : uint8_t { kNone, kEnd };

class LinkService {
 public:
  LinkService();

  /// Takes what has come and sends what the line takes. It never waits.
  LinkRequest serve(Run& run);

 private:
  [[nodiscard]] LinkRequest obey(Run& run, const link::Frame& frame) const;
  LinkRequest take_commands(Run& run);
  void send_telemetry(Run& run);

  link::FrameReader reader_;
  link::FrameWriter writer_;
  telemetry::FrameSource source_;
  link::WireFrame frame_{};
  std::size_t sent_ = link::kWireSize;  // of frame_
};

}  // namespace palpate::firmware
