// All states, events and conditions, for tables; a format's numbers.
#pragma once

#include <cmath>
#include <vector>

#include "palpate/safety/parameters.hpp"
#include "palpate/safety/state_machine.hpp"

namespace palpate::safety::test {

template <class Enum>
std::vector<Enum> every(uint32_t count) {
  std::vector<Enum> all;
  for (uint32_t i = 0; i < count; ++i) all.push_back(static_cast<Enum>(i));
  return all;
}
inline std::vector<State> every_state() { return every<State>(kStateCount); }
inline std::vector<Event> every_event() { return every<Event>(kEventCount); }
inline std::vector<Condition> every_condition() { return every<Condition>(kConditionCount); }

/// The defaults.
inline constexpr MotionLimits kMotionLimits{};

/// As a double.
template <class Fixed>
double number(Fixed value) {
  return std::ldexp(static_cast<double>(value.raw()), -Fixed::kFractionBits);
}

/// The format's next number.
template <class Fixed>
Fixed just_above(Fixed value) {
  return Fixed::from_raw(value.raw() + 1);
}
template <class Fixed>
Fixed just_below(Fixed value) {
  return Fixed::from_raw(value.raw() - 1);
}

}  // namespace palpate::safety::test
