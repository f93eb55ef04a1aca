#include "scenario/parameter_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "domain.hpp"

namespace palpate::sim {
namespace {

constexpr unsigned kSine = kind_bit(ScenarioKind::kSine);
constexpr unsigned kBend = kind_bit(ScenarioKind::kBend);
constexpr unsigned kGrasp = kind_bit(ScenarioKind::kGrasp);
constexpr unsigned kTouch = kind_bit(ScenarioKind::kTouch);
constexpr double kManyTicks = 1e8;

/// Its index in Access is that of its type.
template <class Member>
Parameter make(const char* key, const char* unit, const Range& range, const char* meaning, Member access,
               unsigned kinds = kAllKinds) {
  return Parameter{key, "", unit, meaning, range, {}, "", kinds, false, access};
}

Parameter with_default(Parameter parameter, const char* text) {
  parameter.default_text = text;
  return parameter;
}

Parameter with_alias(Parameter parameter, const char* alias) {
  parameter.alias = alias;
  return parameter;
}

Parameter output(Parameter parameter) {
  parameter.is_output = true;
  return parameter;
}

Parameter choice(const char* key, std::vector<std::string> choices, const char* meaning,
                 Field<std::string> access) {
  Parameter parameter = make(key, "", {}, meaning, access);
  parameter.choices = std::move(choices);
  return parameter;
}

#define PALPATE_FIELD(type, member) Field<type>([](Scenario& s) -> type& { return s.member; })
using Triple = std::array<double, 3>;
using WholeTriple = std::array<int, 3>;

std::vector<Parameter> body_parameters() {
  return {
      make("youngs_modulus_pa", "Pa", domain::kYoungsModulusPa, "Young's modulus",
           &RegionParameters::youngs_modulus_pa),
      make("poisson_ratio", "", domain::kPoissonRatio, "Poisson ratio", &RegionParameters::poisson_ratio),
      make("density_kg_m3", "kg/m3", domain::kDensityKgM3, "density", &RegionParameters::density_kg_m3),
      make("cubes", "cubes", domain::kCubesPerAxis, "size of the block along x, y, z",
           PALPATE_FIELD(WholeTriple, model.cubes)),
      make("region_of_cube", "", domain::kRegionOfCube,
           "[[region]] of each cube, x fastest; -1 leaves a cube out",
           PALPATE_FIELD(std::vector<int>, model.region_of_cube)),
      make("edge_m", "m", domain::kEdgeM, "edge of a cube", PALPATE_FIELD(double, model.edge_m)),
      with_default(make("level", "", domain::kLevel, "subdivision level of the mesh at start",
                        PALPATE_FIELD(int, model.level)),
                   "the deepest up to 6 and most_level that the profile holds"),
      with_default(make("substeps", "", domain::kSubsteps, "integration steps a tick",
                        PALPATE_FIELD(int, model.substeps)),
                   "4, or as many as the profile computes"),
      make("mass_damping_per_s", "1/s", domain::kMassDampingPerS, "mass-proportional damping",
           PALPATE_FIELD(double, model.mass_damping_per_s)),
      make("stiffness_damping_s", "s", domain::kStiffnessDampingS, "stiffness-proportional damping",
           PALPATE_FIELD(double, model.stiffness_damping_s)),
      with_default(choice("hold", {"one", "both", "none"}, "held end faces of the longest axis",
                          PALPATE_FIELD(std::string, hold)),
                   "one; both for cuboid-bend"),
      make("grasp_reach_m", "m", domain::kGraspReachM, "how far from a node a grasp still takes it",
           PALPATE_FIELD(double, model.grasp_reach_m)),
  };
}

std::vector<Parameter> remesh_parameters() {
  return {
      choice("rotations", {"misfit", "siblings", "full"}, "what splits the tets whose rotation is extracted",
             PALPATE_FIELD(std::string, rotations)),
      make("rotation_level", "", domain::kLevel, "of the coarsest tets whose rotation is extracted",
           PALPATE_FIELD(int, model.remesh.rotation_level)),
      with_alias(
          make("rotation_split_deg", "deg", domain::kRotationSplitDeg, "theta_max: where such a tet is split",
               PALPATE_FIELD(double, model.remesh.rotation_split_deg)),
          "theta"),
      make("rotation_join_ratio", "", domain::kHysteresis, "theta_min, where two are joined, over theta_max",
           PALPATE_FIELD(double, model.remesh.rotation_join_ratio)),
      choice("stretch", {"fixed", "longest-edge", "six-edges", "strain-jump"},
             "what refines the mesh, from least_level to most_level; fixed: nothing",
             PALPATE_FIELD(std::string, stretch)),
      make("stretch_split", "", domain::kStretchSplit,
           "elongation (strain-jump: difference of strains) where a leaf is split",
           PALPATE_FIELD(double, model.remesh.stretch_split)),
      make("stretch_merge_ratio", "", domain::kHysteresis, "that where leaves are merged, over stretch_split",
           PALPATE_FIELD(double, model.remesh.stretch_merge_ratio)),
      with_default(make("least_level", "", domain::kLevel, "coarsest level while the mesh changes",
                        &RegionParameters::least_level),
                   "level"),
      with_default(make("most_level", "", domain::kLevel, "finest level while the mesh changes",
                        &RegionParameters::most_level),
                   "level"),
  };
}

std::vector<Parameter> contact_parameters() {
  return {
      make("tool_radius_m", "m", domain::kToolRadiusM,
           "radius of the ball that touches the surface, 1/64 to 1/2 edge_m; 0: the tool only grasps",
           PALPATE_FIELD(double, model.contact.tool_radius_m)),
      with_default(
          make("contact_stiffness_n_m", "N/m", domain::kContactStiffnessNM,
               "spring between the tool and the surface", PALPATE_FIELD(double, model.contact.stiffness_n_m)),
          "half of the largest stable one, at most 1000"),
      with_default(make("contact_damping_n_s_m", "N s/m", domain::kDampingNSM, "damper beside that spring",
                        PALPATE_FIELD(double, model.contact.damping_n_s_m)),
                   "contact_stiffness_n_m times 1 ms, or the largest stable one"),
      make("contact_friction", "", domain::kContactFriction, "coefficient of friction on the surface",
           PALPATE_FIELD(double, model.contact.friction)),
      with_default(make("contact_force_limit_n", "N", domain::kContactForceN, "largest force of the contact",
                        PALPATE_FIELD(double, model.contact.force_limit_n)),
                   "8, or youngs_modulus_pa times edge_m squared if that is less"),
      with_default(
          make("contact_slew_n_per_tick", "N", domain::kContactForceN, "most change of that force in a tick",
               PALPATE_FIELD(double, model.contact.slew_n_per_tick)),
          "what a tool at 2 m/s asks for, at most the limit"),
      make("passivity_ceiling_j", "J", domain::kPassivityCeilingJ,
           "work of the hand that may come back; more is forgotten",
           PALPATE_FIELD(double, model.contact.passivity_ceiling_j)),
      with_default(make("passivity_damping_n_s_m", "N s/m", domain::kDampingNSM,
                        "most damping of the tool while the body gives more than it got; 0: none",
                        PALPATE_FIELD(double, model.contact.passivity_damping_n_s_m)),
                   "5, or the largest that the model holds if that is less"),
  };
}

std::vector<Parameter> motion_parameters() {
  Parameter node = make("node_mm", "mm", {-1000, 1000}, "rest position of the driven node",
                        PALPATE_FIELD(Triple, node_mm), kSine | kDeviceKinds);
  return {
      with_default(with_alias(node, "node"),
                   "a corner of the free end; the middle of a side if both ends are held"),
      make("amplitude_mm", "mm", {0, 200}, "amplitude of the node's motion",
           PALPATE_FIELD(double, sine.amplitude_mm), kSine),
      make("slow", "", {1, 1000}, "stretches the motion in time", PALPATE_FIELD(int, sine.slow), kSine),
      with_alias(make("angle_deg", "deg", {0, 180}, "angle of the arc", PALPATE_FIELD(double, bend.angle_deg),
                      kBend),
                 "angle"),
      with_alias(make("twist_deg", "deg", {0, 180},
                      "how far the turned end is twisted about the bar's axis, beside the bend",
                      PALPATE_FIELD(double, bend.twist_deg), kBend),
                 "twist"),
      make("rest_at_peak", "", {}, "keep the node at its first peak until the body is at rest",
           PALPATE_FIELD(bool, sine.rest_at_peak), kSine),
      make("settle_damping_per_s", "1/s", domain::kMassDampingPerS,
           "mass-proportional damping while the body comes to rest",
           PALPATE_FIELD(double, settle_damping_per_s), kToolKinds),
      make("drag_mm", "mm", {-80, 80}, "how far the tool drags the grasped corner along y",
           PALPATE_FIELD(double, grasp.drag_mm), kGrasp),
      make("press_mm", "mm", {0, 20}, "how far beyond the surface the hand means to press",
           PALPATE_FIELD(double, touch.press_mm), kTouch),
      make("pull_mm", "mm", {0, 60}, "how far the hand pulls the grasped place off the body, along -y",
           PALPATE_FIELD(double, touch.pull_mm), kTouch),
      with_default(make("settings", "", {}, "thresholds that change on the way: 'TICK: NAME = VALUE; ...'",
                        PALPATE_FIELD(std::string, settings), kTouch),
                   "none"),
      make("force_scale", "", domain::kForceScale, "force on the handle over force of the tissue",
           PALPATE_FIELD(double, scene.force_scale), kDeviceKinds),
      make("motion_scale", "", domain::kMotionScale,
           "way of the tool over way of the handle, at most edge_m / 16 mm",
           PALPATE_FIELD(double, scene.motion_scale), kDeviceKinds),
      make("device_rotation_deg", "deg", domain::kRotationDeg,
           "how the device stands beside the body: turned about the body's x, then y, then z axis",
           PALPATE_FIELD(Triple, scene.device_rotation_deg), kDeviceKinds),
      make("body_centre_in_device_m", "m", domain::kBodyCentreM,
           "where the body's centre is in the device's frame",
           PALPATE_FIELD(Triple, scene.body_centre_in_device_m), kDeviceKinds),
      with_default(make("ticks", "ticks of 1 ms", {0, kManyTicks}, "when to stop; 0: at the end",
                        PALPATE_FIELD(int, ticks)),
                   "0"),
      choice("profile", {"cuboid-paper", "cuboid-dense", "organ", "small", "tiny", "workstation"},
             "capacities to run with", PALPATE_FIELD(std::string, profile)),
  };
}

std::vector<Parameter> output_parameters() {
  Parameter board = output(choice("board", {"host", "qemu"}, "where the cycle runs; qemu: touch only",
                                  PALPATE_FIELD(std::string, board)));
  Parameter link = output(choice("link", {"fifo", "uart"}, "how the firmware in QEMU and the device talk",
                                 PALPATE_FIELD(std::string, link)));
  Parameter firmware = output(with_default(
      make("firmware", "", {}, "firmware for board qemu, an ELF file", PALPATE_FIELD(std::string, firmware)),
      "build/m7/palpate_lockstep.elf; build/m4 for profile small"));
  Parameter port =
      output(with_default(make("port", "", {}, "serial line to a firmware on a bench, instead of a board",
                               PALPATE_FIELD(std::string, port)),
                          "none"));
  Parameter record =
      output(with_default(make("record", "", {}, "file to record everything into that enters each tick",
                               PALPATE_FIELD(std::string, record)),
                          "none"));
  board.kinds = record.kinds = kDeviceKinds;
  link.kinds = firmware.kinds = port.kinds = kTouch;
  return {
      board,
      link,
      port,
      firmware,
      record,
      output(make("hash_every", "ticks", {1, kManyTicks}, "ticks between two rows of hash.csv",
                  PALPATE_FIELD(int, hash_every))),
      output(make("vtu_every", "ticks", {0, kManyTicks}, "ticks between two .vtu files for ParaView; 0: none",
                  PALPATE_FIELD(int, vtu_every))),
      output(with_default(make("out", "", {}, "run folder to write", PALPATE_FIELD(std::string, out)),
                          "out/<command>/<scenario>")),
      output(make("plots", "", {}, "draw pictures with gnuplot", PALPATE_FIELD(bool, plots))),
  };
}

#undef PALPATE_FIELD

std::vector<Parameter> all_parameters() {
  std::vector<Parameter> all = body_parameters();
  for (auto part : {remesh_parameters(), contact_parameters(), motion_parameters(), output_parameters()}) {
    std::move(part.begin(), part.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace

const std::vector<Parameter>& parameter_table() {
  static const std::vector<Parameter> table = all_parameters();
  return table;
}

const Parameter* find_parameter(const std::string& key) {
  for (const Parameter& parameter : parameter_table()) {
    if (key == parameter.key || (!parameter.alias.empty() && key == parameter.alias)) return &parameter;
  }
  return nullptr;
}

std::string list_keys(unsigned kinds) {
  std::vector<std::string> keys;
  for (const Parameter& parameter : parameter_table()) {
    if ((parameter.kinds & kinds) != 0) keys.push_back(parameter.key);
  }
  return fmt::format("{}", fmt::join(keys, ", "));
}

nlohmann::json parameter_value(const Parameter& parameter, const Scenario& scenario) {
  Scenario copy = scenario;  // Access is for writing
  return std::visit(
      [&](auto access) -> nlohmann::json {
        if constexpr (kIsOfRegion<decltype(access)>) {
          return copy.model.regions[0].*access;
        } else {
          return access(copy);
        }
      },
      parameter.access);
}

}  // namespace palpate::sim
