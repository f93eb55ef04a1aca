#include "recording/inspection.hpp"

#include <algorithm>
#include <cstdlib>

#include "palpate/firmware/cycle.hpp"

namespace palpate::recording {
namespace {

/// The first event in the order of urgency that leads from one state to the other: of those that are in the
/// row, or else of all, as boot, self-test and ramp report by themselves.
std::string cause_of(safety::State from, const TickRow& row) {
  const safety::EventSet recorded = row.requests | safety::EventSet::of(row.raised);
  const char* cause = "unknown";
  for (uint32_t i = safety::kEventCount; i > 0; --i) {
    const auto event = static_cast<safety::Event>(i - 1);
    const safety::Step step = safety::step(from, event);
    if (step.is_arrow && step.to == row.state && !recorded.has(event)) cause = safety::event_name(event);
  }
  for (uint32_t i = safety::kEventCount; i > 0; --i) {
    const auto event = static_cast<safety::Event>(i - 1);
    const safety::Step step = safety::step(from, event);
    if (step.is_arrow && step.to == row.state && recorded.has(event)) cause = safety::event_name(event);
  }
  return cause;
}

class Inspector final : public Visitor {
 public:
  explicit Inspector(Inspection& inspection)
      : all_(inspection),
        state_(inspection.start.is_guarded ? safety::State::kBoot : safety::State::kActive) {}

  void see_row(uint32_t tick, const TickRow& row) override {
    note_timing(row.timing);
    note_state(tick, row);
    note_conditions(tick, row.raised);
    for (std::size_t i = 0; i < 3; ++i) {
      const int32_t counts = row.encoder_counts[i];
      Span& span = all_.counts[i];
      span = all_.ticks == 0 ? Span{counts, counts}
                             : Span{std::min(span.least, counts), std::max(span.most, counts)};
      PeakCode& peak = all_.peak_codes[i];
      if (from_zero(row.motor_codes[i]) > from_zero(peak.code)) peak = {row.motor_codes[i], tick};
    }
    all_.torque_ticks += row.amplifiers_enabled ? 1u : 0u;
    all_.flags |= row.flags;
    all_.last_fault = row.fault;
    ++all_.ticks;
  }
  void see_hashes(const HashPoint& /*point*/) override { ++all_.hash_points; }
  void see_change(uint32_t tick, const firmware::SettingChange& change) override {
    ++all_.change_count;
    if (all_.changes.size() < Inspection::kMostListed) all_.changes.push_back({tick, change});
  }
  void see_snapshot(const SnapshotPart& part) override {
    if (!part.is_last()) return;
    ++all_.snapshots;
    if (all_.ticks == 0) all_.first_tick = part.tick;
  }

 private:
  static int from_zero(uint16_t code) { return std::abs(int{code} - phantom::kZeroCode); }

  /// A script's clock stands still.
  void note_timing(const safety::TimingReport& timing) {
    if (all_.ticks != 0) {
      const uint32_t step = timing.tick_number - timing_.tick_number;
      if (step > 1 && step < 0x80000000u) all_.lost_ticks += step - 1;
      if (all_.start.is_guarded && timing.message_number == timing_.message_number) ++all_.mute_ticks;
    }
    all_.late_ticks += timing.is_late ? 1u : 0u;
    timing_ = timing;
  }
  void note_state(uint32_t tick, const TickRow& row) {
    // What the state was before a recording that begins later, it does not say.
    const bool is_known = all_.ticks != 0 || all_.first_tick == 0;
    if (is_known && row.state != state_) {
      ++all_.state_change_count;
      if (all_.state_changes.size() < Inspection::kMostListed) {
        all_.state_changes.push_back({tick, state_, row.state, cause_of(state_, row)});
      }
    }
    state_ = all_.last_state = row.state;
  }
  void note_conditions(uint32_t tick, safety::ConditionSet raised) {
    if (raised.is_empty()) return;
    for (uint32_t i = 0; i < safety::kConditionCount; ++i) {
      const auto condition = static_cast<safety::Condition>(i);
      if (!raised.has(condition)) continue;
      auto at = std::find_if(all_.conditions.begin(), all_.conditions.end(),
                             [&](const ConditionUse& use) { return use.condition >= condition; });
      if (at == all_.conditions.end() || at->condition != condition) {
        at = all_.conditions.insert(at, {condition, tick, tick, 0});
      }
      at->last_tick = tick;
      ++at->ticks;
    }
  }

  Inspection& all_;
  safety::State state_;
  safety::TimingReport timing_{};
};

class CurveReader final : public Visitor {
 public:
  CurveReader(Curves& curves, const Inspection& inspection)
      : curves_(curves), width_(inspection.ticks / Curves::kMostBins + 1) {}

  void see_row(uint32_t tick, const TickRow& row) override {
    const bool is_new = rows_ % width_ == 0;
    if (is_new) curves_.time_s.push_back(1e-3 * tick);
    const auto add = [is_new](std::vector<Span>& spans, int32_t value) {
      if (is_new) spans.push_back({value, value});
      spans.back() = {std::min(spans.back().least, value), std::max(spans.back().most, value)};
    };
    for (std::size_t i = 0; i < 3; ++i) {
      add(curves_.counts[i], row.encoder_counts[i]);
      add(curves_.codes[i], row.motor_codes[i]);
    }
    add(curves_.state, static_cast<int32_t>(row.state));
    ++rows_;
  }

 private:
  Curves& curves_;
  uint32_t width_;  // of a bin, in ticks
  uint32_t rows_ = 0;
};

}  // namespace

Inspection inspect(Bytes file) {
  Inspection inspection;
  RecordingReader reader(file);
  inspection.finding = reader.open(inspection.start);
  inspection.has_start = inspection.finding.is_done();
  if (!inspection.has_start) return inspection;
  Inspector inspector(inspection);
  inspection.finding = reader.read(inspector);
  inspection.chunks = reader.chunk_count();
  return inspection;
}

Curves read_curves(Bytes file, const Inspection& inspection) {
  Curves curves;
  Start start;
  RecordingReader reader(file);
  CurveReader visitor(curves, inspection);
  if (reader.open(start).is_done()) static_cast<void>(reader.read(visitor));
  return curves;
}

}  // namespace palpate::recording
