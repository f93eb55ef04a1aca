#include "hil/link_run.hpp"

#include <fmt/format.h>

#include <chrono>

#include "hil/closed_loop.hpp"
#include "hil/device_log.hpp"
#include "hil/link_rows.hpp"
#include "hil/qemu_firmware.hpp"
#include "hil/serial_line.hpp"
#include "hil/setting_plan.hpp"
#include "hil/touch_task.hpp"
#include "output/interrupt.hpp"
#include "output/output_file.hpp"
#include "output/recording_file.hpp"
#include "palpate/safety/state.hpp"
#include "program/model_container.hpp"
#include "program/run_record.hpp"
#include "scenario/errors.hpp"

namespace palpate::sim {
namespace {

struct Target {
  const char* machine;
  const char* firmware;
};

/// The builds that carry a profile: `cmake --preset m7`, `m4`.
Target target_of(const std::string& profile) {
  if (profile == "cuboid-paper") return {"mps2-an500", "build/m7/palpate_lockstep.elf"};
  if (profile == "small") return {"mps2-an386", "build/m4/palpate_lockstep.elf"};
  throw BadInput(
      fmt::format("board qemu has firmware for the profiles cuboid-paper and small, not for {}", profile));
}

std::filesystem::path firmware_of(const Scenario& scenario) {
  std::filesystem::path path =
      scenario.firmware.empty() ? target_of(scenario.profile).firmware : scenario.firmware.c_str();
  if (std::filesystem::is_regular_file(path)) return path;
  throw BadInput(
      fmt::format("there is no firmware '{}': build it with cmake --preset {} and cmake --build, or name one "
                  "with --firmware",
                  path.string(), scenario.profile == "small" ? "m4" : "m7"));
}

recording::HashPoint hash_point(uint32_t tick, const std::vector<std::string>& row) {
  recording::HashPoint point{tick, {}, std::stoull(row.back(), nullptr, 16)};
  for (std::size_t i = 0; i < point.stages.size(); ++i) point.stages[i] = std::stoull(row[i], nullptr, 16);
  return point;
}

/// All that the firmware was given, with the hashes that it printed.
void write_recording(const Scenario& scenario, const std::vector<LinkTick>& ticks,
                     const std::map<uint32_t, std::vector<std::string>>& hashes) {
  RecordingFile file(scenario.record);
  recording::RecordingWriter writer(file);
  writer.begin({scenario.profile, scenario.name, cycle_model(scenario), true, safety::kPremium15Parameters});
  for (uint32_t tick = 1; tick <= ticks.size(); ++tick) {
    record_after(tick - 1, ticks[tick - 1], writer);
    const auto row = hashes.find(tick);
    if (row != hashes.end()) writer.add(hash_point(tick, row->second));
  }
  file.close(writer.end());
}

/// The device's side of the run. The answer to the last tick is the firmware's last word.
LinkRun drive(const Scenario& scenario, const RunFolder& folder, LinkController& controller,
              const std::function<void(uint32_t)>& watch, std::vector<LinkTick>& told) {
  plant::Plant plant = touch_plant(scenario);
  ClosedLoop loop(plant, controller);
  loop.plan(planned_changes(scenario));
  DeviceLog log(folder.file("device.csv"));
  const auto start = std::chrono::steady_clock::now();
  const uint32_t ticks = touch_ticks(scenario);
  for (uint32_t tick = 1; tick <= ticks; ++tick) {
    loop.advance();
    log.add(loop);
    told.push_back(link_tick(sensors_of(loop.sensors(), loop.wish()), loop.answer()));
    watch(tick);
    if (is_interrupted()) throw Interrupted();
  }
  controller.end_run();
  log.close();
  const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - start;
  return {ticks, log.peak_hand_force_n(), duration.count(),
          safety::state_name(static_cast<safety::State>(loop.answer().safety_state)), "unknown"};
}

LinkRun drive_qemu(const Scenario& scenario, const RunFolder& folder,
                   const std::function<void(uint32_t)>& watch) {
  QemuFirmware firmware({firmware_of(scenario), target_of(scenario.profile).machine,
                         folder.file("model.palpate"), folder.file("console.csv"),
                         scenario.link == "uart" ? LinkKind::kUart : LinkKind::kFifo});
  LinkController controller(firmware.files());
  controller.on_silence = [&firmware] { firmware.require_alive(); };
  std::vector<LinkTick> told;
  LinkRun run = drive(scenario, folder, controller, watch, told);
  const int status = firmware.wait();
  if (status != 0) throw EnvironmentError(fmt::format("the firmware in QEMU ended with status {}", status));
  const RunRecord record = read_run(folder.temporary().string());
  if (!record.problem.empty()) throw EnvironmentError(record.problem);
  run.state_hash = record.hashes.rbegin()->second.back();
  if (!scenario.record.empty()) write_recording(scenario, told, record.hashes);
  return run;
}

}  // namespace

LinkRun run_over_link(const Scenario& scenario, const RunFolder& folder,
                      const std::function<void(uint32_t)>& watch) {
  write_whole_file(folder.file("model.palpate").string(), model_container(scenario));
  if (scenario.port.empty()) return drive_qemu(scenario, folder, watch);
  const SerialLine line(scenario.port);
  LinkController controller({line.file(), line.file()});
  std::vector<LinkTick> told;
  LinkRun run = drive(scenario, folder, controller, watch, told);
  if (!scenario.record.empty()) write_recording(scenario, told, {});
  return run;
}

}  // namespace palpate::sim
