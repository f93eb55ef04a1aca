#include "link_service.hpp"

#include "palpate/ports/link.hpp"
#include "palpate/telemetry/command.hpp"

namespace palpate::firmware {

LinkService::LinkService()
    : source_(port::link_carries_device() ? telemetry::Tells::kBody : telemetry::Tells::kDevice) {}

LinkRequest LinkService::obey(Run& run, const link::Frame& frame) const {
  link::CommandMessage command{};
  if (link::decode(frame, command) != link::DecodeStatus::kDone) return LinkRequest::kNone;
  leave(run.requests, telemetry::requests_of(command));
  if (command.setting != 0) leave(run.changes, telemetry::change_of(command));
  return command.ends_run ? LinkRequest::kEnd : LinkRequest::kNone;
}

LinkRequest LinkService::take_commands(Run& run) {
  LinkRequest request = LinkRequest::kNone;
  uint8_t byte = 0;
  while (port::receive_byte(byte)) {
    if (reader_.push(byte) && obey(run, reader_.frame()) == LinkRequest::kEnd) request = LinkRequest::kEnd;
  }
  return request;
}

void LinkService::send_telemetry(Run& run) {
  for (;;) {
    while (sent_ < frame_.size()) {
      if (!port::send_byte(frame_[sent_])) return;
      ++sent_;
    }
    if (!source_.next(run.telemetry, reader_.counters(), writer_, frame_)) return;
    sent_ = 0;
  }
}

LinkRequest LinkService::serve(Run& run) {
  const LinkRequest request = take_commands(run);
  send_telemetry(run);
  return request;
}

}  // namespace palpate::firmware
