// The supported domain of a model (docs/numerics.md), every range once: check_domain refuses what is outside,
// the parameter table prints it.
#pragma once

#include <string>

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
/// A model's own limit: a metre of the handle is 62.5 edges at most, so that 0.13 m of it cross the largest
/// block.
inline constexpr Range kMotionScale{0.1, 8.0};
inline constexpr double kMostEdgesPerM = 1.0 / kEdgeM.low;
inline constexpr Range kRotationDeg{-180.0, 180.0};

/// Of a tool, in cube edges and over all cubes; 0: it does not touch.
inline constexpr Range kToolRadiusEdges{1.0 / 64.0, 0.5};
inline constexpr Range kToolRadiusM{0.0, kToolRadiusEdges.high* kEdgeM.high};
/// Of a coupling. A model's own limits follow from its lightest node (contact_parameters.hpp).
inline constexpr Range kContactStiffnessNM{0.01, 10000.0};
inline constexpr Range kDampingNSM{0.0, 50.0};
inline constexpr Range kContactFriction{0.0, 1.9};
/// Forces, and their change in a tick. A model's own limit is E_ref edge^2.
inline constexpr Range kContactForceN{0.001, 100.0};
/// At least a step of the heaviest unit of energy, at most the end of the smallest.
inline constexpr Range kPassivityCeilingJ{0.002, 1.0};

}  // namespace domain

/// Throws BadInput with the name, the value and the range.
void require_range(const std::string& name, double value, const Range& range);

}  // namespace palpate::sim
