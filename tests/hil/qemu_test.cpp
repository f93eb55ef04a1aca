// The firmware's own binary in QEMU, with the simulated device around it. Run as
//   palpate_qemu_tests <ELF> <profile>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "hil/device_log.hpp"
#include "hil/link_run.hpp"
#include "hil/plant_simulation.hpp"
#include "hil/qemu_firmware.hpp"
#include "hil/touch_task.hpp"
#include "palpate/link/telemetry_messages.hpp"
#include "palpate/safety/state.hpp"
#include "program/model_container.hpp"
#include "program/run_record.hpp"
#include "recording/mapped_file.hpp"
#include "recording/replay.hpp"
#include "simulation/capacity.hpp"
#include "support/temporary_folder.hpp"

namespace palpate::sim {
namespace {

std::string g_firmware;
std::string g_profile;

Scenario touch_scenario() {
  Scenario scenario = built_in_scenario("touch");
  scenario.profile = g_profile;
  scenario.firmware = g_firmware;
  if (g_profile == "small") scenario.model.level = 3;  // what its one substep a tick is enough for
  complete_scenario(scenario);
  fit_to_profile(scenario);
  return scenario;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string hex(uint64_t value) { return fmt::format("{:016x}", value); }

void expect_same_bits(const std::string& link, int ticks) {
  Scenario scenario = touch_scenario();
  scenario.link = link;
  scenario.ticks = ticks;
  scenario.settings = "900: continuous current = 1.2; 1600: contact force = 0.2; 2500: max velocity = 0.0015";
  const test::TemporaryFolder folder;
  scenario.record = (folder / "recording").string();
  const RunFolder run_folder(folder / "run");
  (void)run_over_link(scenario, run_folder, [](uint32_t) {});
  const RunRecord target = read_run(run_folder.temporary().string());

  DeviceLog log(folder / "device.csv");
  scenario.record.clear();
  const auto here = make_plant_simulation(scenario, [&log](const ClosedLoop& loop) { log.add(loop); });
  std::size_t compared = 0;
  for (bool goes_on = true; goes_on;) {
    goes_on = here->advance();
    const auto row = target.hashes.find(here->sample().tick);
    if (row == target.hashes.end()) continue;
    const auto hashes = here->hashes();
    for (std::size_t i = 0; i < hashes.size(); ++i) {
      ASSERT_EQ(row->second[i], hex(hashes[i]))
          << "tick " << row->first << ", stage " << here->hash_names()[i];
    }
    ++compared;
  }
  log.close();
  EXPECT_EQ(compared, static_cast<std::size_t>(ticks) / 100);
  EXPECT_TRUE(text_of(folder / "device.csv") == text_of(run_folder.file("device.csv")))
      << "the device moved otherwise";

  const recording::MappedFile file((folder / "recording").string());
  const recording::ReplayReport replayed =
      recording::replay(file.bytes(), {}, [](const recording::Mismatch& mismatch) {
        ADD_FAILURE() << "tick " << mismatch.tick << ", " << mismatch.what;
        return false;
      });
  EXPECT_EQ(replayed.finding.status, container::ReadStatus::kEnd);
  EXPECT_EQ(replayed.last_tick, static_cast<uint32_t>(ticks));
  EXPECT_EQ(replayed.hash_points, static_cast<uint32_t>(ticks) / 100);
}

TEST(FirmwareInQemu, HasTheBitsOfThisMachineOverPipes) { expect_same_bits("fifo", 6500); }
TEST(FirmwareInQemu, HasTheBitsOfThisMachineOverASerialLine) { expect_same_bits("uart", 3000); }

/// A firmware and a device, a tick at a time.
class Bench {
 public:
  explicit Bench(const std::string& model)
      : scenario_(touch_scenario()),
        firmware_(request(model)),
        controller_(firmware_.files()),
        plant_(touch_plant(scenario_)),
        loop_(plant_, controller_) {
    controller_.on_silence = [this] { firmware_.require_alive(); };
  }
  LinkController& controller() { return controller_; }
  const link::ActuatorsMessage& tick() {
    loop_.advance();
    return loop_.answer();
  }
  std::string end() {
    controller_.end_run();
    (void)firmware_.wait();
    return text_of(folder_ / "console.csv");
  }

 private:
  QemuRequest request(const std::string& model) {
    std::ofstream(folder_ / "model", std::ios::binary) << model;
    const char* machine = g_profile == "small" ? "mps2-an386" : "mps2-an500";
    return {g_firmware, machine, folder_ / "model", folder_ / "console.csv", LinkKind::kFifo};
  }

  test::TemporaryFolder folder_;
  Scenario scenario_;
  QemuFirmware firmware_;
  LinkController controller_;
  plant::Plant plant_;
  ClosedLoop loop_;
};

void expect_refused(const std::string& model) {
  Bench bench(model);
  for (int i = 0; i < 50; ++i) {
    const link::ActuatorsMessage& answer = bench.tick();
    ASSERT_EQ(answer.fault, 2u);
    ASSERT_EQ(answer.safety_state, static_cast<uint8_t>(safety::State::kFault));
    ASSERT_EQ(answer.motor_codes, (std::array<uint16_t, 3>{2048, 2048, 2048}));
    ASSERT_EQ(answer.is_amplifier_enabled, (std::array<bool, 3>{false, false, false}));
  }
  EXPECT_NE(bench.end().find("refused,container,"), std::string::npos);
}

TEST(FirmwareInQemu, NeverMovesWithADamagedModel) {
  std::string model = model_container(touch_scenario());
  for (const std::size_t place : {std::size_t{3}, model.size() / 2, model.size() - 1}) {
    std::string damaged = model;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x10);
    expect_refused(damaged);
  }
}

TEST(FirmwareInQemu, NeverMovesWithoutAModel) { expect_refused("no model"); }

TEST(FirmwareInQemu, StreamsTelemetryOfEachTick) {
  Bench bench(model_container(touch_scenario()));
  std::vector<link::TelemetryMessage> telemetry;
  link::CountersMessage counters{};
  bench.controller().on_frame = [&](const link::Frame& frame) {
    link::TelemetryMessage message{};
    if (link::decode(frame, message) == link::DecodeStatus::kDone) telemetry.push_back(message);
    (void)link::decode(frame, counters);
  };
  for (int i = 0; i < 250; ++i) (void)bench.tick();
  (void)bench.end();
  ASSERT_GE(telemetry.size(), 249u);
  for (std::size_t i = 0; i < telemetry.size(); ++i) ASSERT_EQ(telemetry[i].tick, i + 1);
  EXPECT_EQ(counters.dropped_records, 0u);
  EXPECT_EQ(bench.controller().counters().lost_frames, 0u);
}

}  // namespace
}  // namespace palpate::sim

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  if (argc != 3) {
    std::fprintf(stderr, "usage: palpate_qemu_tests <ELF> <profile>\n");
    return 2;
  }
  palpate::sim::g_firmware = argv[1];
  palpate::sim::g_profile = argv[2];
  return RUN_ALL_TESTS();
}
