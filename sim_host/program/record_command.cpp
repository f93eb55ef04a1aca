// `record`: listens to a device on a bench.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "hil/line_recorder.hpp"
#include "hil/serial_line.hpp"
#include "output/interrupt.hpp"
#include "output/recording_file.hpp"
#include "palpate/link/frame_reader.hpp"
#include "program/commands.hpp"
#include "program/model_container.hpp"
#include "recording/mapped_file.hpp"
#include "scenario/errors.hpp"
#include "simulation/with_profile.hpp"

namespace palpate::sim {
namespace {

recording::Start start_with(const RecordRequest& request) {
  const recording::MappedFile file(request.model);
  const uint8_t deepest =
      with_profile(request.profile, [](auto profile) { return decltype(profile)::kMaxLevel; });
  recording::Start start{request.profile, "device", {}, true, safety::kPremium15Parameters};
  const container::Finding finding = firmware::read_model(file.bytes(), deepest, start.model);
  if (!finding.is_done()) throw BadInput(fmt::format("{}: {}", request.model, describe(finding)));
  return start;
}

/// What has come; nothing when the user stops.
std::size_t read_some(int file, std::array<uint8_t, 4096>& bytes) {
  const ssize_t count = ::read(file, bytes.data(), bytes.size());
  if (count >= 0) return static_cast<std::size_t>(count);
  if (errno == EINTR) return 0;
  throw EnvironmentError(fmt::format("the line is lost: {}", std::strerror(errno)));
}

}  // namespace

int record_device(const RecordRequest& request) {
  const recording::Start start = start_with(request);
  const SerialLine line(request.port);
  RecordingFile file(request.out);
  LineRecorder recorder(file, start);
  using Phase = typename decltype(recorder)::Phase;
  link::FrameReader reader;
  std::array<uint8_t, 4096> bytes{};
  fmt::print("listening on {}; restart the firmware to begin, Ctrl-C ends\n", request.port);
  const auto is_done = [&] {
    return recorder.phase() == Phase::kEnded || (request.ticks != 0 && recorder.ticks() >= request.ticks);
  };
  while (!is_done() && !is_interrupted()) {
    const std::size_t count = read_some(line.file(), bytes);
    if (count == 0) break;
    for (std::size_t i = 0; i < count && !is_done(); ++i) {
      if (reader.push(bytes[i])) recorder.push(reader.frame());
    }
  }
  file.close(recorder.end());
  fmt::print("{} ticks in {}; {} frames lost on the line\n", recorder.ticks(), request.out,
             reader.counters().lost_frames);
  if (recorder.phase() == Phase::kWaiting) throw EnvironmentError("no firmware has started on the line");
  if (recorder.phase() != Phase::kEnded) return 0;
  fmt::print(stderr, "palpate: a tick is missing after tick {}: the recording ends there\n",
             recorder.ticks());
  return 1;
}

}  // namespace palpate::sim
