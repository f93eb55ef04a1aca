// The supported domain of a model (docs/numerics.md), every range once: check_domain refuses what is outside,
// the parameter table prints it.
#pragma once

#include "palpate/mesh/block.hpp"
#include "palpate/solve/dynamics.hpp"

namespace palpate::sim {

/// A closed range.
struct Range {
  double low = 0.0;
  double high = 0.0;
  /// NaN is in no range.
  [[nodiscard]] constexpr bool contains(double value) const { return value >= low && value <= high; }
};

namespace domain {

inline constexpr Range kYoungsModulusPa{100.0, 1e6};
inline constexpr Range kPoissonRatio{0.0, 0.495};
inline constexpr Range kDensityKgM3{10.0, 2000.0};
/// Largest over smallest of a model's regions.
inline constexpr Range kModulusRatio{1.0, 100.0};
inline constexpr Range kDensityRatio{1.0, 20.0};

inline constexpr Range kCubesPerAxis{1.0, kMaxCubesPerAxis};
inline constexpr Range kEdgeM{0.016, 0.128};
inline constexpr Range kLevel{0.0, kDeepestLevel};
/// -1 is an absent cube. A model's own limit is its number of regions.
inline constexpr Range kRegionOfCube{-1.0, kRegions - 1.0};

inline constexpr Range kSubsteps{1.0, kMaxSubsteps};
inline constexpr Range kMassDampingPerS{0.0, 30.0};
/// beta_K / dt stays below 1, the format's end. A model's own limit follows from its critical step too.
inline constexpr double kLargestDampingInSteps = 0.99;
inline constexpr Range kStiffnessDampingS{0.0, kLargestDampingInSteps * 1e-3};

inline constexpr Range kRotationSplitDeg{0.005, 60.0};
inline constexpr Range kStretchSplit{0.001, 1.0};
/// Of a lower threshold to the upper one.
inline constexpr Range kHysteresis{0.0, 1.0};

/// How far a grasp reaches, and how far the body may be from the device's origin.
inline constexpr double kReachEdges = 4.0;
inline constexpr double kFarthestM = kReachEdges * kEdgeM.high;
inline constexpr Range kGraspReachM{0.0, kFarthestM};
inline constexpr Range kBodyCentreM{-kFarthestM, kFarthestM};
inline constexpr Range kForceScale{0.01, 1000.0};

}  // namespace domain
}  // namespace palpate::sim
