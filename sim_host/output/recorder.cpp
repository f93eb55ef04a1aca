#include "output/recorder.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

#include "output/interrupt.hpp"
#include "output/output_file.hpp"
#include "output/projection.hpp"
#include "output/vtu_series.hpp"
#include "scenario/errors.hpp"

namespace palpate::sim {
namespace {

/// force.csv: a row a tick.
class ForceLog {
 public:
  ForceLog(const std::filesystem::path& path, bool has_device)
      : file_(path.string()), has_device_(has_device) {
    file_.print(
        "tick,time_ms,tool_x_mm,tool_y_mm,tool_z_mm,displacement_x_mm,displacement_y_mm,displacement_z_mm,"
        "force_x_N,force_y_N,force_z_N,{}tets,rotation_tets,flags\n",
        has_device ? "motor_1_code,motor_2_code,motor_3_code," : "");
  }
  void add(const Sample& sample) {
    file_.print("{},{}", sample.tick, sample.tick);
    for (const double mm : sample.tool_mm) file_.print(",{:.6f}", mm);
    for (const double mm : sample.displacement_mm) file_.print(",{:.6f}", mm);
    for (const double newtons : sample.force_n) file_.print(",{:.9f}", newtons);
    if (has_device_) {
      for (const uint16_t code : sample.motor_codes) file_.print(",{}", code);
    }
    file_.print(",{},{},{}\n", sample.tets, sample.rotation_tets, sample.flags);
  }
  void close() { file_.close(); }

 private:
  OutputFile file_;
  bool has_device_;
};

/// hash.csv: a row every so many ticks, and one for the last tick.
class HashLog {
 public:
  HashLog(const std::filesystem::path& path, const std::vector<std::string>& names) : file_(path.string()) {
    file_.print("tick");
    for (const std::string& name : names) file_.print(",{}", name);
    file_.print("\n");
  }
  void add(uint32_t tick, const std::vector<uint64_t>& hashes) {
    file_.print("{}", tick);
    for (const uint64_t hash : hashes) file_.print(",{:016x}", hash);
    file_.print("\n");
  }
  void close() { file_.close(); }

 private:
  OutputFile file_;
};

void write_nodes(const BodyShape& shape, const std::filesystem::path& path) {
  OutputFile file(path.string());
  file.print("node,rest_x_mm,rest_y_mm,rest_z_mm,x_mm,y_mm,z_mm\n");
  for (std::size_t i = 0; i < shape.rest_mm.size(); ++i) {
    const auto& rest = shape.rest_mm[i];
    const auto& now = shape.now_mm[i];
    file.print("{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}\n", i, rest[0], rest[1], rest[2], now[0], now[1],
               now[2]);
  }
  file.close();
}

/// The farthest shape, up to the encoders' noise; of several the last, which had most time to settle.
void keep_peak(const Simulation& simulation, const Sample& sample, double& farthest_mm,
               Recording& recording) {
  constexpr double kNoiseMm = 0.1;
  const double distance = length(sample.displacement_mm);
  if (distance < farthest_mm - kNoiseMm) return;
  farthest_mm = std::max(distance, farthest_mm);
  recording.at_peak = simulation.shape();
  recording.tool_at_peak_mm = sample.tool_mm;
}

/// Points that a picture can tell apart: a run of millions of ticks stays small.
void keep_path(const std::array<double, 3>& tool_mm, std::vector<std::array<double, 3>>& path) {
  constexpr double kStepMm = 0.1;
  if (path.empty() || length(minus(tool_mm, path.back())) >= kStepMm) path.push_back(tool_mm);
}

}  // namespace

Recording record(Simulation& simulation, const Scenario& scenario, const RunFolder& folder,
                 const std::function<void(const Sample&)>& watch) {
  Recording recording;
  recording.at_peak = simulation.shape();
  ForceLog forces(folder.file("force.csv"), simulation.has_device());
  HashLog hashes(folder.file("hash.csv"), simulation.hash_names());
  std::optional<VtuSeries> bodies;
  if (scenario.vtu_every > 0) {
    bodies.emplace(folder.temporary());
    bodies->add(simulation.fields(), 0);
  }
  const auto start = std::chrono::steady_clock::now();
  double farthest_mm = 0.0;
  for (bool goes_on = true; goes_on;) {
    goes_on = simulation.advance();
    const Sample sample = simulation.sample();
    forces.add(sample);
    const auto is_due = [&](int every) {
      return !goes_on || sample.tick % static_cast<uint32_t>(every) == 0;
    };
    if (is_due(scenario.hash_every)) hashes.add(sample.tick, simulation.hashes());
    if (bodies && is_due(scenario.vtu_every)) bodies->add(simulation.fields(), sample.tick);
    recording.peak_force_n = std::max(recording.peak_force_n, length(sample.force_n));
    recording.all_flags |= sample.flags;
    keep_path(sample.tool_mm, recording.tool_path_mm);
    keep_peak(simulation, sample, farthest_mm, recording);
    recording.last = sample;
    watch(sample);
    if (is_interrupted()) throw Interrupted();
  }
  simulation.end();
  recording.duration_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  recording.state_hash = simulation.hashes().back();
  forces.close();
  hashes.close();
  if (bodies) bodies->close();
  write_nodes(simulation.shape(), folder.file("nodes.csv"));
  return recording;
}

}  // namespace palpate::sim
