#pragma once

namespace palpate::plant {

inline constexpr double kPi = 3.14159265358979323846;

constexpr double radians(double degrees) { return degrees * kPi / 180.0; }
constexpr double degrees(double radians) { return radians * (180.0 / kPi); }

}  // namespace palpate::plant
