// `replay` and `inspect`: what is done with a recording.
#include <fmt/format.h>

#include "output/gnuplot.hpp"
#include "output/output_file.hpp"
#include "output/recording_plots.hpp"
#include "output/run_folder.hpp"
#include "program/commands.hpp"
#include "program/model_container.hpp"
#include "recording/mapped_file.hpp"
#include "recording/replay.hpp"

namespace palpate::sim {
namespace {

void require_usable(bool is_usable, const std::string& path, const container::Finding& finding) {
  if (is_usable) return;
  throw BadInput(fmt::format("{}: {}", path, describe(finding)));
}

bool print_and_stop(const recording::Mismatch& mismatch) {
  fmt::print("NOT the same: tick {}, {}: recorded {}, computed {}\n", mismatch.tick, mismatch.what,
             mismatch.recorded, mismatch.computed);
  return false;
}

}  // namespace

int replay_recording(const std::string& path, uint32_t from_tick) {
  const recording::MappedFile file(path);
  const recording::ReplayReport report = recording::replay(file.bytes(), {from_tick}, print_and_stop);
  require_usable(report.is_usable(), path, report.finding);
  fmt::print("{}: ticks {} to {} of {}, profile {}\n", path, report.first_tick + 1, report.last_tick,
             report.start.scenario, report.start.profile);
  if (report.finding.status == container::ReadStatus::kCut) {
    fmt::print("  the recording is cut off at byte {}: what is before it was run\n", report.finding.offset);
  }
  if (report.first) return 1;
  fmt::print("the same: every tick's codes and state, and {} hash points\n", report.hash_points);
  return 0;
}

int inspect_recording(const std::string& path, const std::string& out, bool as_json) {
  const recording::MappedFile file(path);
  const recording::Inspection inspection = recording::inspect(file.bytes());
  require_usable(inspection.is_usable(), path, inspection.finding);
  const std::string json = recording::inspection_json(inspection);
  fmt::print("{}", as_json ? json : recording::inspection_text(inspection));
  if (out.empty()) return 0;
  require_gnuplot();
  RunFolder folder(out, {"inspection.json", "counts.svg", "codes.svg", "state.svg"});
  write_whole_file(folder.file("inspection.json").string(), json);
  draw_recording(recording::read_curves(file.bytes(), inspection), folder.temporary());
  folder.commit();
  if (!as_json) fmt::print("  written to     {}\n", out);
  return 0;
}

}  // namespace palpate::sim
