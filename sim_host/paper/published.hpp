// The figures that the paper prints: Tagawa, Yamada and Tanaka, "A Study on Corotated Nonlinear Deformation
// Model for Simulating Soft Tissue Under Large Deformation".
#pragma once

#include <array>
#include <cstdint>

namespace palpate::sim::published {

/// Of displacement, mm.
struct Errors {
  double average_mm, maximum_mm, minimum_mm;
};

/// A column of Table 1.
struct Table1Column {
  double theta_deg;  // theta_max
  uint32_t rotation_tets;
  Errors errors;
};

/// The bend whose errors Table 1 lists.
inline constexpr double kBendDeg = 90.0;

inline constexpr std::array<Table1Column, 7> kTable1 = {{{25.8, 18, {1.107, 4.395, 0.08}},
                                                         {8.1, 48, {0.367, 1.474, 0.02}},
                                                         {4.1, 300, {0.064, 0.224, 0.009}},
                                                         {2.6, 578, {0.032, 0.174, 0.002}},
                                                         {1.8, 696, {0.020, 0.138, 0.002}},
                                                         {0.9, 908, {0.019, 0.153, 0.001}},
                                                         {0.1, 1072, {0.007, 0.053, 0.0002}}}};

/// The column L-FEM. Its count is of the mesh's tets, as printed; the text says 1152.
inline constexpr uint32_t kLinearTets = 1151;
inline constexpr Errors kLinear = {26.180, 49.763, 3.206};

/// "Computation time of each online re-mesh process".
inline constexpr double kRemeshMs = 0.015;

}  // namespace palpate::sim::published
