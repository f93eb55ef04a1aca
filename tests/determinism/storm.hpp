// A hand that does its worst, in integers: it goes about the bar and right through it, now slowly, now at 1
// m/s, and closes and opens its grasp at any time. The compiler makes the storm's script of it, and longer
// runs draw from it as they go.
#pragma once

#include "palpate/firmware/scenario_image.hpp"

namespace palpate::golden {

class StormHand {
 public:
  constexpr explicit StormHand(uint32_t seed) : random_(seed) {}

  /// Counts and button of the next tick.
  constexpr firmware::ScriptRow next() {
    if (gone_ == steps_) begin_leg();
    ++gone_;
    if (below(kTicksAGrasp) == 0) closed_ = !closed_;
    firmware::ScriptRow row{};
    for (std::size_t joint = 0; joint < 3; ++joint) {
      const int32_t way = to_[joint] - from_[joint];
      row.encoder_counts[joint] = static_cast<int16_t>(from_[joint] + way * gone_ / steps_);
    }
    row.buttons = closed_ ? firmware::ScriptRow::kGraspButton : 0;
    return row;
  }

 private:
  // The tool at the bar's centre, and how far it goes from there: some 70 mm to all sides, 100 mm along the
  // bar.
  static constexpr std::array<int32_t, 3> kCentre = {0, 2300, 950};
  static constexpr std::array<int32_t, 3> kReach = {2600, 3200, 3200};
  // Of the tool for a count of each joint, within a third.
  static constexpr std::array<int32_t, 3> kUmPerCount = {32, 29, 23};
  // A tick; the first ones are about as fast as a hand can, 1 m/s where kUmPerCount is furthest off.
  static constexpr std::array<uint32_t, 4> kPacesUm = {750, 750, 400, 120};
  static constexpr uint32_t kTicksAGrasp = 150;

  /// xorshift32 of Marsaglia, "Xorshift RNGs", 2003.
  constexpr uint32_t below(uint32_t limit) {
    random_ ^= random_ << 13;
    random_ ^= random_ >> 17;
    random_ ^= random_ << 5;
    return random_ % limit;
  }

  /// From where it is to anywhere, or straight through the middle to the other side.
  constexpr void begin_leg() {
    from_ = to_;
    const bool through = below(2) == 0;
    int64_t square = 0;  // of the way
    for (std::size_t joint = 0; joint < 3; ++joint) {
      const auto width = static_cast<uint32_t>(2 * kReach[joint] + 1);
      const int32_t anywhere = kCentre[joint] - kReach[joint] + static_cast<int32_t>(below(width));
      to_[joint] = through ? 2 * kCentre[joint] - from_[joint] : anywhere;
      const int64_t way_um = int64_t{to_[joint] - from_[joint]} * kUmPerCount[joint];
      square += way_um * way_um;
    }
    const int64_t pace = kPacesUm[below(kPacesUm.size())];
    steps_ = 1;
    while (steps_ * pace * steps_ * pace < square) ++steps_;
    gone_ = 0;
  }

  uint32_t random_;
  std::array<int32_t, 3> from_{};
  std::array<int32_t, 3> to_{};  // zero counts are beside the bar
  int32_t steps_ = 0;            // of this leg
  int32_t gone_ = 0;
  bool closed_ = false;
};

inline constexpr uint32_t kStormSeed = 2463534242;
inline constexpr uint32_t kStormTicks = 10000;

}  // namespace palpate::golden
