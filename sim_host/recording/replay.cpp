#include "recording/replay.hpp"

#include <fmt/format.h>

#include <memory>

#include "recording/profiles.hpp"
#include "recording/row.hpp"
#include "recording/snapshot.hpp"

namespace palpate::recording {
namespace {

/// Which snapshot to begin with, and whether the file is whole.
class Scan final : public Visitor {
 public:
  explicit Scan(uint32_t from_tick) : from_tick_(from_tick) {}

  void see_row(uint32_t /*tick*/, const TickRow& /*row*/) override { is_at_start_ = false; }
  void see_hashes(const HashPoint& /*point*/) override { is_at_start_ = false; }
  void see_change(uint32_t /*tick*/, const firmware::SettingChange& /*change*/) override {
    is_at_start_ = false;
  }
  void see_snapshot(const SnapshotPart& part) override {
    if (!part.is_last()) return;
    // One before all ticks is where the recording begins, whatever tick that is.
    const bool may_begin = is_at_start_ || part.tick <= from_tick_;
    if (may_begin && part.tick != 0) chosen_ = part;
    is_at_start_ = false;
  }
  [[nodiscard]] const std::optional<SnapshotPart>& chosen() const { return chosen_; }

 private:
  uint32_t from_tick_;
  bool is_at_start_ = true;
  std::optional<SnapshotPart> chosen_;
};

template <class Profile>
class Replay final : public Visitor {
 public:
  Replay(ReplayReport& report, const std::optional<SnapshotPart>& snapshot,
         const std::function<bool(const Mismatch&)>& on_mismatch)
      : report_(report),
        on_mismatch_(on_mismatch),
        state_(std::make_unique<firmware::CycleState<Profile>>()),
        snapshot_(snapshot),
        is_running_(!snapshot) {
    // A model that is refused is recorded as a cycle that stands still, and replays as one.
    static_cast<void>(begin_again(report.start, *state_));
    if (snapshot) report_.first_tick = report_.last_tick = snapshot->tick;
  }

  void see_row(uint32_t tick, const TickRow& row) override {
    if (!is_running_ || !tell_waiting()) return;
    const firmware::Sensors sensors = sensors_of(row);
    firmware::Actuators actuators{};
    firmware::cycle(*state_, sensors, actuators, probe_);
    report_.last_tick = tick;
    compare(tick, row, row_of(sensors, *state_));
  }
  void see_hashes(const HashPoint& point) override {
    if (!is_running_) return;
    ++report_.hash_points;
    const HashPoint computed = hashes_of(point.tick, *state_);
    for (uint32_t i = 0; i < firmware::kStageCount; ++i) {
      if (point.stages[i] == computed.stages[i]) continue;
      const char* stage = firmware::stage_name(static_cast<firmware::Stage>(i));
      // It says more than what came out of the same tick.
      waiting_.reset();
      return object(point.tick, fmt::format("stage {}", stage), hex(point.stages[i]),
                    hex(computed.stages[i]));
    }
    if (!tell_waiting()) return;
    if (point.state != computed.state) object(point.tick, "state", hex(point.state), hex(computed.state));
  }
  void see_change(uint32_t tick, const firmware::SettingChange& change) override {
    if (!is_running_ || !tell_waiting() || firmware::change_setting(*state_, change)) return;
    object(tick, fmt::format("setting {}", firmware::setting_name(change.setting)),
           fmt::format("{}", change.value), "refused");
  }
  void see_snapshot(const SnapshotPart& part) override {
    if (is_running_) return compare_snapshot(part);
    if (part.tick != snapshot_->tick || !finding_.is_done()) return;
    finding_ = restore(part, *state_);
    is_running_ = finding_.is_done() && part.is_last();
  }
  [[nodiscard]] bool wants_more() const override { return goes_on_ && finding_.is_done(); }
  void finish() { tell_waiting(); }
  /// Of the snapshot that it begins with.
  [[nodiscard]] const Finding& finding() const { return finding_; }

 private:
  static std::string hex(uint64_t hash) { return fmt::format("{:016x}", hash); }

  void compare_snapshot(const SnapshotPart& part) {
    if (!tell_waiting()) return;
    const uint64_t hash = firmware::state_hash(*state_);
    if (part.is_last() && hash != part.state_hash)
      object(part.tick, "state", hex(part.state_hash), hex(hash));
  }

  /// What came out waits for the hashes of the same tick, if there are some.
  void compare(uint32_t tick, const TickRow& recorded, const TickRow& computed) {
    const auto differs = [&](const std::string& what, const auto& a, const auto& b) {
      if (a == b) return false;
      waiting_ = Mismatch{tick, what, fmt::format("{}", a), fmt::format("{}", b)};
      return true;
    };
    const auto number = [](auto value) { return static_cast<uint32_t>(value); };
    const auto name = [](safety::State state) { return std::string(safety::state_name(state)); };
    if (differs("flags", recorded.flags, computed.flags)) return;
    if (differs("raised conditions", recorded.raised.bits(), computed.raised.bits())) return;
    if (differs("state of the safety layer", name(recorded.state), name(computed.state))) return;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string what = fmt::format("motor code {}", i + 1);
      if (differs(what, recorded.motor_codes[i], computed.motor_codes[i])) return;
    }
    if (differs("amplifiers", recorded.amplifiers_enabled, computed.amplifiers_enabled)) return;
    differs("fault", number(recorded.fault), number(computed.fault));
  }
  /// False when the listener wants no more.
  bool tell_waiting() {
    if (waiting_) object(waiting_->tick, waiting_->what, waiting_->recorded, waiting_->computed);
    waiting_.reset();
    return goes_on_;
  }

  /// The first difference of a tick says it all.
  void object(uint32_t tick, const std::string& what, const std::string& recorded,
              const std::string& computed) {
    if (objected_ && *objected_ == tick) return;
    objected_ = tick;
    const Mismatch mismatch{tick, what, recorded, computed};
    ++report_.mismatches;
    if (!report_.first) report_.first = mismatch;
    goes_on_ = on_mismatch_(mismatch);
  }

  ReplayReport& report_;
  const std::function<bool(const Mismatch&)>& on_mismatch_;
  std::unique_ptr<firmware::CycleState<Profile>> state_;
  std::optional<SnapshotPart> snapshot_;
  bool is_running_;
  bool goes_on_ = true;
  std::optional<uint32_t> objected_;  // the last tick with a difference
  std::optional<Mismatch> waiting_;
  Finding finding_ = Finding::nothing();
  firmware::NoProbe probe_;
};

template <class Profile>
void run(Bytes file, const std::optional<SnapshotPart>& snapshot, ReplayReport& report,
         const std::function<bool(const Mismatch&)>& on_mismatch) {
  if (snapshot) {
    const Finding finding = check_layout<Profile>(*snapshot);
    if (!finding.is_done()) {
      report.finding = finding;
      return;
    }
  }
  Replay<Profile> again(report, snapshot, on_mismatch);
  RecordingReader reader(file);
  Start start;
  // It has been read before.
  if (!reader.open(start).is_done()) return;
  static_cast<void>(reader.read(again));
  again.finish();
  if (!again.finding().is_done()) report.finding = again.finding();
}

}  // namespace

ReplayReport replay(Bytes file, const ReplayOptions& options,
                    const std::function<bool(const Mismatch&)>& on_mismatch) {
  ReplayReport report;
  Scan scan(options.from_tick);
  RecordingReader reader(file);
  report.finding = reader.open(report.start);
  report.has_start = report.finding.is_done();
  if (!report.has_start) return report;
  report.finding = reader.read(scan);
  if (!report.is_usable()) return report;
  sim::with_profile(report.start.profile,
                    [&](auto profile) { run<decltype(profile)>(file, scan.chosen(), report, on_mismatch); });
  return report;
}

}  // namespace palpate::recording
