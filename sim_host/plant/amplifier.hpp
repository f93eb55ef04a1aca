// Three current amplifiers behind 12-bit converters, with an enable each and one watchdog for all.
#pragma once

#include <array>
#include <cstdint>

#include "plant/figure.hpp"

namespace palpate::plant {

inline constexpr Figure kFullScaleCurrent{"amplifier full scale", 5.5, "A", Mark::kUnverified,
                                          "mahilab/Phantom's; it belongs to the board"};
inline constexpr Figure kCurrentLimit{"amplifier current limit", 5.5, "A", Mark::kAssumed,
                                      "the motor's stall current: no stricter limit is known"};
inline constexpr Figure kWatchdogTicks{"amplifier watchdog", 4, "ms", Mark::kAssumed,
                                       "that there is one is known, its time is not"};

struct AmplifierParameters {
  double full_scale = kFullScaleCurrent.value;  ///< I_fs: of code 2048 +- 2047, A
  double current_limit = kCurrentLimit.value;   ///< A
  uint32_t watchdog_ticks = static_cast<uint32_t>(kWatchdogTicks.value);
};

/// What a controller tells the amplifiers in one tick.
struct AmplifierInput {
  std::array<uint16_t, 3> codes;   ///< 2048 is no current; a converter takes the low 12 bits of what it gets
  std::array<bool, 3> is_enabled;  ///< one line an axis
  bool watchdog_line;              ///< its level; an edge is a level that differs from the last tick's
};

/// The watchdog is a retriggerable one-shot, which is an assumption: from the watchdog_ticks-th tick without
/// an edge all axes are off, and the next edge brings them back at once. Nothing latches, so that it is the
/// firmware that must keep forces from coming back with a kick. It starts dropped out, with the line low.
class Amplifiers {
 public:
  explicit Amplifiers(const AmplifierParameters& parameters)
      : parameters_(parameters), ticks_without_edge_(parameters.watchdog_ticks) {}

  /// Once a tick.
  void receive(const AmplifierInput& input);

  [[nodiscard]] bool is_dropped_out() const { return ticks_without_edge_ >= parameters_.watchdog_ticks; }
  /// Dropped out while an axis should be on: what the amplifiers report.
  [[nodiscard]] bool is_cut() const {
    return is_dropped_out() && (input_.is_enabled[0] || input_.is_enabled[1] || input_.is_enabled[2]);
  }
  [[nodiscard]] bool is_on(std::size_t axis) const { return input_.is_enabled[axis] && !is_dropped_out(); }
  /// (code - 2048) I_fs / 2047 within +-the limit, A.
  [[nodiscard]] double target_current(std::size_t axis) const;

 private:
  AmplifierParameters parameters_;
  AmplifierInput input_{{2048, 2048, 2048}, {false, false, false}, false};
  uint32_t ticks_without_edge_;
};

}  // namespace palpate::plant
