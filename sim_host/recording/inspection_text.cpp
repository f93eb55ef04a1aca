#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "recording/inspection.hpp"
#include "recording/setting_table.hpp"

namespace palpate::recording {
namespace {

/// Lists in a text end after so many lines.
constexpr std::size_t kMostLines = 20;

std::string hidden(std::size_t shown, std::size_t all) {
  return all > shown ? fmt::format("                 and {} more\n", all - shown) : "";
}

/// "  name           first\n                 second\n"
std::string list(const char* name, const std::vector<std::string>& lines, std::size_t all) {
  if (lines.empty()) return fmt::format("  {:<15}none\n", name);
  const std::size_t shown = std::min(lines.size(), kMostLines);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    text += fmt::format("  {:<15}{}\n", i == 0 ? name : "", lines[i]);
  }
  return text + hidden(shown, all);
}

std::vector<std::string> state_lines(const Inspection& inspection) {
  std::vector<std::string> lines;
  for (const StateChange& change : inspection.state_changes) {
    lines.push_back(fmt::format("tick {}: {} -> {} by {}", change.tick, safety::state_name(change.from),
                                safety::state_name(change.to), change.cause));
  }
  return lines;
}

std::vector<std::string> condition_lines(const Inspection& inspection) {
  std::vector<std::string> lines;
  for (const ConditionUse& use : inspection.conditions) {
    lines.push_back(fmt::format("{} in {} ticks, {} to {}", safety::condition_name(use.condition), use.ticks,
                                use.first_tick, use.last_tick));
  }
  return lines;
}

std::vector<std::string> change_lines(const Inspection& inspection) {
  std::vector<std::string> lines;
  for (const RecordedChange& one : inspection.changes) {
    lines.push_back(fmt::format("from tick {} on: {} = {:g}", one.tick + 1,
                                firmware::setting_name(one.change.setting), value_of(one.change)));
  }
  return lines;
}

std::string joint_text(const Inspection& inspection) {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    const Span& counts = inspection.counts[i];
    const PeakCode& peak = inspection.peak_codes[i];
    text += fmt::format("  joint {}        counts {} to {}, peak code {} at tick {}\n", i + 1, counts.least,
                        counts.most, peak.code, peak.tick);
  }
  return text;
}

std::string end_text(const Inspection& inspection) {
  if (!inspection.is_cut()) return "whole";
  return fmt::format("cut off at byte {}: what is before it is whole", inspection.finding.offset);
}

nlohmann::json states_json(const Inspection& inspection) {
  auto all = nlohmann::json::array();
  for (const StateChange& change : inspection.state_changes) {
    all.push_back({{"tick", change.tick},
                   {"from", safety::state_name(change.from)},
                   {"to", safety::state_name(change.to)},
                   {"cause", change.cause}});
  }
  return all;
}

nlohmann::json conditions_json(const Inspection& inspection) {
  auto all = nlohmann::json::array();
  for (const ConditionUse& use : inspection.conditions) {
    all.push_back({{"condition", safety::condition_name(use.condition)},
                   {"first_tick", use.first_tick},
                   {"last_tick", use.last_tick},
                   {"ticks", use.ticks}});
  }
  return all;
}

nlohmann::json changes_json(const Inspection& inspection) {
  auto all = nlohmann::json::array();
  for (const RecordedChange& one : inspection.changes) {
    all.push_back({{"tick", one.tick},
                   {"setting", firmware::setting_name(one.change.setting)},
                   {"value", value_of(one.change)}});
  }
  return all;
}

nlohmann::json joints_json(const Inspection& inspection) {
  auto all = nlohmann::json::array();
  for (std::size_t i = 0; i < 3; ++i) {
    all.push_back({{"least_counts", inspection.counts[i].least},
                   {"most_counts", inspection.counts[i].most},
                   {"peak_code", inspection.peak_codes[i].code},
                   {"peak_code_tick", inspection.peak_codes[i].tick}});
  }
  return all;
}

}  // namespace

std::string inspection_text(const Inspection& inspection) {
  const Start& start = inspection.start;
  std::string text = fmt::format("{}: {} ticks, {:.3f} s, {}\n", start.scenario, inspection.ticks,
                                 1e-3 * inspection.ticks, end_text(inspection));
  text += fmt::format("  profile        {}\n", start.profile);
  text += fmt::format("  driven by      {}\n", start.is_guarded ? "a hand at the device" : "a script");
  text += fmt::format("  begins after   {} ticks\n", inspection.first_tick);
  text += list("states", state_lines(inspection), inspection.state_change_count);
  text += list("conditions", condition_lines(inspection), inspection.conditions.size());
  text += list("settings", change_lines(inspection), inspection.change_count);
  text += joint_text(inspection);
  text += fmt::format("  torque         in {} ticks\n", inspection.torque_ticks);
  text += fmt::format("  ticks          {} lost, {} late, {} without a new message\n", inspection.lost_ticks,
                      inspection.late_ticks, inspection.mute_ticks);
  text += fmt::format("  ends in        {}, fault {}\n", safety::state_name(inspection.last_state),
                      static_cast<int>(inspection.last_fault));
  return text + fmt::format("  checks         hashes of {} ticks, {} snapshots\n", inspection.hash_points,
                            inspection.snapshots);
}

std::string inspection_json(const Inspection& inspection) {
  const Start& start = inspection.start;
  const nlohmann::ordered_json json = {{"scenario", start.scenario},
                                       {"profile", start.profile},
                                       {"is_guarded", start.is_guarded},
                                       {"is_cut", inspection.is_cut()},
                                       {"first_tick", inspection.first_tick},
                                       {"ticks", inspection.ticks},
                                       {"duration_s", 1e-3 * inspection.ticks},
                                       {"chunks", inspection.chunks},
                                       {"hash_points", inspection.hash_points},
                                       {"snapshots", inspection.snapshots},
                                       {"lost_ticks", inspection.lost_ticks},
                                       {"late_ticks", inspection.late_ticks},
                                       {"mute_ticks", inspection.mute_ticks},
                                       {"torque_ticks", inspection.torque_ticks},
                                       {"flags", inspection.flags},
                                       {"last_state", safety::state_name(inspection.last_state)},
                                       {"last_fault", static_cast<int>(inspection.last_fault)},
                                       {"state_change_count", inspection.state_change_count},
                                       {"state_changes", states_json(inspection)},
                                       {"conditions", conditions_json(inspection)},
                                       {"change_count", inspection.change_count},
                                       {"changes", changes_json(inspection)},
                                       {"joints", joints_json(inspection)}};
  return json.dump(2) + "\n";
}

}  // namespace palpate::recording
