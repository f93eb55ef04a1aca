// The firmware's own binary in QEMU, tick by tick beside the same cycle in this process: 100 events that a
// message of the sensors or a command can carry, one after the other in one run.
//   palpate_fault_qemu_test <palpate_lockstep.elf> <QEMU's machine>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "checks.hpp"
#include "hil/qemu_firmware.hpp"
#include "injector.hpp"
#include "palpate/firmware/model_container.hpp"
#include "palpate/telemetry/sensors_message.hpp"
#include "support/containers.hpp"
#include "support/random.hpp"

namespace palpate::fault {
namespace {

std::filesystem::path g_firmware;
std::string g_machine;

constexpr uint32_t kEvents = 100;
constexpr uint32_t kGoesRoundTicks = 1000;
constexpr uint32_t kLongTicks = 3300;  // home, the ramp of 2 s, and more

constexpr std::array<EventKind, 13> kCarried = {
    EventKind::kEmergencyStop, EventKind::kAmplifierFault, EventKind::kLostEdges,
    EventKind::kSkippedTicks,  EventKind::kCountJump,      EventKind::kCountStuck,
    EventKind::kYank,          EventKind::kDisable,        EventKind::kEnable,
    EventKind::kCalibrate,     EventKind::kAcknowledge,    EventKind::kAbortCalibration,
    EventKind::kGraspGlitch};

/// Home, press, grasp, pull, home, every second anew.
plant::Hand hand_that_goes_round(uint32_t rounds) {
  std::vector<plant::Knot> knots;
  for (uint32_t i = 0; i < rounds; ++i) {
    const double start = i * kGoesRoundTicks * 1e-3;
    knots.push_back({start, home()});
    knots.push_back({start + 0.2, home()});
    knots.push_back({start + 0.35, point_at_surface(-0.003)});
    knots.push_back({start + 0.45, point_at_surface(0.008)});
    knots.push_back({start + 0.55, point_at_surface(-0.003), true, 1});
    knots.push_back({start + 0.75, point_at_surface(-0.02)});
    knots.push_back({start + 0.95, home()});
  }
  return hand_with(std::move(knots));
}

/// One event after the other: mostly before the ramp is over, every tenth time after it.
std::vector<Event> draw_events() {
  test::Random random(11);
  std::vector<Event> events;
  uint32_t tick = 0;
  for (uint32_t i = 0; i + 1 < kEvents; ++i) {
    tick += i % 10 == 0 ? kLongTicks : 150 + random.below(400);
    const uint32_t length = i % 3 == 0 ? 1 : 1 + random.below(60);
    events.push_back({kCarried[random.below(kCarried.size())], tick, length, random.below(1u << 20)});
    tick += length;
  }
  events.push_back({EventKind::kCountRange, tick + kLongTicks, 1, 0});
  return events;
}

std::filesystem::path write_model() {
  test::MemorySink sink;
  EXPECT_EQ(firmware::write_model(sink, body_model(), test::bytes_of(std::string("fault"))),
            container::WriteStatus::kDone);
  auto path = std::filesystem::temp_directory_path() / ("palpate-fault-" + std::to_string(::getpid()));
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(sink.file.data()), static_cast<std::streamsize>(sink.file.size()));
  return path;
}

/// The firmware answers what the cycle beside it does, to the bit.
void expect_same(const link::ActuatorsMessage& answer, const Loop& twin) {
  ASSERT_EQ(answer.motor_codes, twin.given.motor_codes);
  ASSERT_EQ(answer.is_amplifier_enabled[0], twin.given.amplifiers_enabled);
  ASSERT_EQ(answer.safety_state, static_cast<uint8_t>(twin.state()));
  ASSERT_EQ(answer.conditions, twin.cycle.safety.raised.bits());
  ASSERT_EQ(answer.flags, twin.cycle.output.flags);
}

class FaultInQemu : public ::testing::Test {
 protected:
  FaultInQemu()
      : model_(write_model()),
        firmware_({g_firmware, g_machine, model_, "/dev/null", sim::LinkKind::kFifo}),
        controller_(firmware_.files()),
        twin_(hand_that_goes_round(150), safety::kPremium15Parameters) {
    controller_.on_silence = [this] { firmware_.require_alive(); };
    checks_.allow_clamps();
  }
  void TearDown() override { std::filesystem::remove(model_); }

  void advance(Injector& injector) {
    twin_.advance([&](TickCase& now, Loop& loop) {
      injector(now, loop);
      now.sensors.report.timing.message_number = now.sensors.report.timing.tick_number;
    });
    const firmware::Sensors& sensors = twin_.now.sensors;
    const auto answer = controller_.answer(telemetry::message_of(sensors), {sensors.report.requests});
    ASSERT_NO_FATAL_FAILURE(expect_same(answer, twin_)) << "tick " << twin_.tick();
    ASSERT_NE(answer.watchdog_level, watchdog_level_) << "a cycle in time did not feed the watchdogs";
    watchdog_level_ = answer.watchdog_level;
    ASSERT_EQ(checks_.see(twin_), "") << describe({injector.event()});
  }

  std::filesystem::path model_;
  sim::QemuFirmware firmware_;
  sim::LinkController controller_;
  Loop twin_;
  Checks checks_;
  bool watchdog_level_ = false;
};

TEST_F(FaultInQemu, ManyEventsInOneRunAreAnsweredAsOnTheHost) {
  uint32_t from_active = 0;
  uint32_t faults = 0;
  for (const Event& event : draw_events()) {
    Injector injector(event);
    while (twin_.tick() < event.start) ASSERT_NO_FATAL_FAILURE(advance(injector));
    from_active += twin_.state() == safety::State::kActive ? 1u : 0u;
    bool is_fault = false;
    while (twin_.tick() <= event.end()) {
      ASSERT_NO_FATAL_FAILURE(advance(injector));
      is_fault = is_fault || twin_.state() == safety::State::kFault;
    }
    faults += is_fault ? 1u : 0u;
  }
  EXPECT_EQ(twin_.state(), safety::State::kFault);
  EXPECT_GE(from_active, 8u);
  EXPECT_GE(faults, 30u);
  std::printf("%u events in %u ticks, %u from Active, %u with a fault\n", kEvents, twin_.tick(), from_active,
              faults);
  controller_.end_run();
  EXPECT_EQ(firmware_.wait(), 0);
}

}  // namespace
}  // namespace palpate::fault

int main(int count, char** words) {
  ::testing::InitGoogleTest(&count, words);
  if (count != 3) {
    std::fprintf(stderr, "palpate_fault_qemu_test <palpate_lockstep.elf> <QEMU's machine>\n");
    return 2;
  }
  palpate::fault::g_firmware = words[1];
  palpate::fault::g_machine = words[2];
  return RUN_ALL_TESTS();
}
