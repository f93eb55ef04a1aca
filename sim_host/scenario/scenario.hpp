// A scenario: a body, who moves it and how, and what is recorded. It starts as one of the built-in ones; a
// .toml file and then command-line flags change its parameters (parameter_table.hpp).
#pragma once

#include "model_parameters.hpp"

namespace palpate::sim {

enum class ScenarioKind : uint8_t { kSine, kBend, kGrasp, kTouch };

/// Whether the tool is at the end of a device's arm.
constexpr bool has_device(ScenarioKind kind) {
  return kind == ScenarioKind::kGrasp || kind == ScenarioKind::kTouch;
}

/// cuboid-sine: a node follows u = (0, A sin(0.072 k / slow deg), 0), k the tick.
struct SineParameters {
  double amplitude_mm = 50.0;
  int slow = 1;
  bool rest_at_peak = false;  // the node stays at its first peak, and the body comes to rest
};

/// cuboid-bend: one end twisted about the bar's axis and turned until the bar's centre line is a circular
/// arc, then rest.
struct BendParameters {
  double angle_deg = 90.0;
  double twist_deg = 0.0;
};

/// grasp: a PHANToM takes a corner of the free end and drags it sideways.
struct GraspParameters {
  double drag_mm = 50.0;
};

/// touch: a hand at a PHANToM presses the low y side of the body, then grasps it, pulls it along -y and lets
/// go.
struct TouchParameters {
  double press_mm = 8.0;  // how far beyond the surface the hand means to go
  double pull_mm = 30.0;
};

struct Scenario {
  static constexpr int kAutomaticLevel = -1;
  static constexpr int kAutomaticSubsteps = 0;
  static constexpr int kAllTicks = 0;

  std::string name;
  ScenarioKind kind = ScenarioKind::kGrasp;
  std::string profile = "cuboid-paper";
  std::string board = "host";
  std::string link = "fifo";  // to a board that is not the host
  std::string port;           // serial line to a firmware on a bench; empty: none
  std::string firmware;       // ELF for board qemu; empty: the build's
  std::string hold = "one";
  std::string rotations = "misfit";
  std::string stretch = "six-edges";
  ModelParameters model;
  SineParameters sine;
  BendParameters bend;
  GraspParameters grasp;
  TouchParameters touch;
  SceneParameters scene;
  std::string settings;             // to change on the way; empty: none
  std::array<double, 3> node_mm{};  // at rest, of the node that is driven, grasped or watched
  bool node_given = false;
  double settle_damping_per_s = 30.0;  // while a body comes to rest
  int ticks = kAllTicks;
  int hash_every = 100;
  int vtu_every = 0;   // 0: never
  std::string record;  // file for a recording; empty: none
  std::string out;
  bool plots = true;
};

/// Built-in names, in order.
const std::vector<std::string>& scenario_names();
const char* kind_name(ScenarioKind kind);

/// A built-in scenario. Throws BadInput for an unknown name.
Scenario built_in_scenario(const std::string& name);

/// A built-in scenario, or one from a file (an argument that ends in .toml).
Scenario load_scenario(const std::string& name_or_path);

/// node_mm, from the body's centre.
std::array<double, 3> node_from_centre_m(const Scenario& scenario);

/// The model of a scenario that is complete, for the firmware's cycle. A scenario without a device gets a
/// scene whose device is at the body's centre.
firmware::CycleModel cycle_model(const Scenario& scenario);

/// After all parameters are set: derives what follows from them and refuses contradictions.
void complete_scenario(Scenario& scenario);

}  // namespace palpate::sim
