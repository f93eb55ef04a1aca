// A board with a device of its own, which tells a recorder everything; and what a recording of it is worth.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "hil/closed_loop.hpp"
#include "hil/host_controller.hpp"
#include "hil/touch_task.hpp"
#include "palpate/telemetry/frame_source.hpp"
#include "palpate/tick/profiles.hpp"
#include "program/model_container.hpp"
#include "recording/replay.hpp"
#include "recording/start.hpp"
#include "simulation/capacity.hpp"

namespace palpate::sim {

/// `touch` on a small and coarse body.
inline Scenario small_touch(const std::string& settings = "") {
  Scenario scenario = built_in_scenario("touch");
  scenario.profile = "small";
  scenario.model.level = 2;
  scenario.settings = settings;
  complete_scenario(scenario);
  fit_to_profile(scenario);
  return scenario;
}

/// The frames that the firmware of a board sends, tick by tick, while a hand uses its device.
class TellingBoard {
 public:
  TellingBoard() : scenario_(small_touch()), source_(telemetry::Tells::kDevice) { restart(); }
  [[nodiscard]] recording::Start start() const { return recording::start_of(*state_, "device", true); }
  void plan(const std::vector<PlannedChange>& changes) { loop_->plan(changes); }
  /// From power on.
  void restart() {
    EXPECT_EQ(firmware::start(*state_, cycle_model(scenario_)), Status::kDone);
    EXPECT_TRUE(firmware::guard_device(*state_, safety::kPremium15Parameters));
    plant_.emplace(touch_plant(scenario_));
    controller_.emplace(*state_, probe_);
    loop_.emplace(*plant_, *controller_);
    controller_->on_cycle = [this](const firmware::Sensors& read) { tell(read); };
    source_ = telemetry::FrameSource(telemetry::Tells::kDevice);
  }
  std::vector<link::Frame> tick() {
    frames_.clear();
    bytes_.clear();
    loop_->advance();
    return frames_;
  }
  /// The same as they travel.
  [[nodiscard]] const std::vector<uint8_t>& bytes() const { return bytes_; }
  [[nodiscard]] std::string model() const { return model_container(scenario_); }

 private:
  void tell(const firmware::Sensors& read) {
    telemetry::TickRecord* record = ring_.claim();
    ASSERT_NE(record, nullptr);
    telemetry::fill_record(*record, read, *state_, {}, 0);
    ring_.publish();
    link::WireFrame wire{};
    while (source_.next(ring_, {}, writer_, wire)) {
      bytes_.insert(bytes_.end(), wire.begin(), wire.end());
      for (const uint8_t byte : wire) {
        if (reader_.push(byte)) frames_.push_back(reader_.frame());
      }
    }
  }

  Scenario scenario_;
  std::unique_ptr<firmware::CycleState<Small>> state_ = std::make_unique<firmware::CycleState<Small>>();
  firmware::NoProbe probe_;
  std::optional<plant::Plant> plant_;
  std::optional<HostController<Small, firmware::NoProbe>> controller_;
  std::optional<ClosedLoop> loop_;
  telemetry::Ring<telemetry::TickRecord, 4> ring_;
  telemetry::FrameSource source_;
  link::FrameWriter writer_;
  link::FrameReader reader_;
  std::vector<link::Frame> frames_;
  std::vector<uint8_t> bytes_;
};

/// How many ticks of it are had again, to the bit.
inline uint32_t replayed_ticks(container::Bytes file) {
  const recording::ReplayReport report = recording::replay(file, {}, [](const recording::Mismatch& mismatch) {
    ADD_FAILURE() << "tick " << mismatch.tick << ", " << mismatch.what << ": " << mismatch.recorded << ", "
                  << mismatch.computed;
    return false;
  });
  EXPECT_EQ(report.finding.status, container::ReadStatus::kEnd);
  return report.last_tick;
}

}  // namespace palpate::sim
