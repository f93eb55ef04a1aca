// What all injections go into: a bar of tissue of 144 tets, a device that is guarded, and a hand that does
// everything once in 2 s.
#pragma once

#include "compiled_stages.hpp"
#include "model_parameters.hpp"
#include "plant/plant.hpp"

namespace palpate::fault {

using Cycle = firmware::CycleState<Small>;

inline constexpr uint32_t kScenarioTicks = 2000;
inline constexpr uint16_t kRampTicks = 300;
inline constexpr uint16_t kStuckTicks = 100;
inline constexpr uint32_t kWatchedTicks = 300;  // after the last event

/// The body of the built-in scenario `touch`, coarser, and finer by a level where it is stretched.
sim::ModelParameters body_parameters();
firmware::CycleModel body_model();

/// A short ramp and an early look at stuck encoders; all else as delivered.
safety::Parameters device_parameters();

/// Where the tool's centre is when the ball is so many metres inside the surface.
Eigen::Vector3d point_at_surface(double inside_m);
Eigen::Vector3d home();

/// It trembles, as a hand does: counts that stand still are a broken encoder's.
plant::Hand hand_with(std::vector<plant::Knot> knots);
/// Waits for the whole force in the reset pose, touches, presses, grasps, pulls, lets go, goes home.
plant::Hand scenario_hand();

}  // namespace palpate::fault
