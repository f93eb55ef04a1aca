// Times pieces of work against each other: all in turn, round after round, so that whatever else the machine
// does meets them alike. What counts is processor time.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace palpate::bench {

/// A median and what it varied by: the quartiles.
struct Figure {
  double median = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// Of at least one value.
Figure figure_of(std::vector<double> values);

class Contest {
 public:
  /// `run` is done so many times in a row, a slice. Returns the contender's number.
  std::size_t add(std::function<void()> run, uint32_t times_a_slice);

  /// A slice of each that does not count, then the rounds.
  void race(uint32_t rounds);

  /// Of one run, microseconds.
  [[nodiscard]] Figure time_us(std::size_t contender) const;
  /// How many times faster the first is than the second, round by round.
  [[nodiscard]] Figure speed_ratio(std::size_t contender, std::size_t slower) const;

 private:
  struct Contender {
    std::function<void()> run;
    uint32_t times_a_slice;
    std::vector<double> us;  // of one run, by round
  };
  std::vector<Contender> contenders_;
};

}  // namespace palpate::bench
