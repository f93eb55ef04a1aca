#include "paper/reference_body.hpp"

#include <cmath>
#include <memory>

#include "palpate/tick/profiles.hpp"
#include "palpate/tick/start.hpp"
#include "reference/mesh_from_forest.hpp"

namespace palpate::sim {
namespace {

using reference::Vector;

Vector half_size_m(const ModelParameters& model) {
  return Vector(model.cubes[0], model.cubes[1], model.cubes[2]) * (model.edge_m / 2.0);
}

}  // namespace

HeldMesh uniform_mesh(const Scenario& scenario) {
  const auto state = std::make_unique<State<Workstation>>();
  const Model model = compile_model(scenario.model);
  if (start(*state, model) != Status::kDone)
    throw BadInput("the uniform mesh does not fit profile workstation");
  return HeldMesh{reference::mesh_of(state->forest, scenario.model.edge_m),
                  reference::held_nodes(state->forest, model.held)};
}

HeldMesh mesh_of(const BodyFields& body, const Scenario& scenario) {
  constexpr double kOnFaceM = 1e-9;
  const Vector half = half_size_m(scenario.model);
  Eigen::Index along = 0;
  half.maxCoeff(&along);
  HeldMesh result;
  for (const auto& rest_mm : body.rest_mm) {
    const Vector x = in_body_frame(rest_mm, scenario.model);
    const bool on_first = std::abs(x[along] + half[along]) < kOnFaceM;
    const bool on_second = std::abs(x[along] - half[along]) < kOnFaceM;
    uint8_t held = 0;
    if (on_first && scenario.model.held != HeldEnds::kNone) held = 1;
    if (on_second && scenario.model.held == HeldEnds::kBoth) held = 2;
    result.mesh.rest.push_back(x);
    result.held.push_back(held);
  }
  result.mesh.tet = body.tets;
  for (const int32_t region : body.region) result.mesh.region.push_back(static_cast<uint32_t>(region));
  return result;
}

std::vector<reference::Material> materials_of(const ModelParameters& model) {
  std::vector<reference::Material> materials;
  for (const RegionParameters& region : model.regions) {
    materials.push_back(
        reference::material_of(region.youngs_modulus_pa, region.poisson_ratio, region.density_kg_m3));
  }
  return materials;
}

std::array<double, 3> in_file_frame(const Vector& x, const ModelParameters& model) {
  const Vector mm = (x + half_size_m(model)) * 1e3;
  return {mm[0], mm[1], mm[2]};
}

Vector in_body_frame(const std::array<double, 3>& mm, const ModelParameters& model) {
  return Vector(mm[0], mm[1], mm[2]) * 1e-3 - half_size_m(model);
}

BodyFields fields_of(const reference::Mesh& mesh, const reference::Positions& x, const Scenario& scenario) {
  BodyFields fields;
  for (std::size_t i = 0; i < x.size(); ++i) {
    fields.rest_mm.push_back(in_file_frame(mesh.rest[i], scenario.model));
    fields.now_mm.push_back(in_file_frame(x[i], scenario.model));
  }
  for (std::size_t i = 0; i < mesh.tet.size(); ++i) {
    fields.tets.push_back(oriented(mesh.tet[i], fields.rest_mm));
    fields.level.push_back(scenario.model.level);
    fields.region.push_back(static_cast<int32_t>(mesh.region[i]));
    fields.rotation_tet.push_back(static_cast<int32_t>(i));
  }
  return fields;
}

}  // namespace palpate::sim
