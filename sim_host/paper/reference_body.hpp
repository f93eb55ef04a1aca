// A scenario's body as the double-precision reference takes it. Reference positions are metres from the
// block's centre, those of files are millimetres from its low corner.
#pragma once

#include "reference/mesh.hpp"
#include "scenario/scenario.hpp"
#include "simulation/body_fields.hpp"

namespace palpate::sim {

struct HeldMesh {
  reference::Mesh mesh;
  std::vector<uint8_t> held;  // a node: 0 free, 1 or 2 by which held end
};

/// The uniform mesh of the scenario's block at its level, up to that of profile workstation.
HeldMesh uniform_mesh(const Scenario& scenario);

/// The mesh of a body that was run, with the same ends held.
HeldMesh mesh_of(const BodyFields& body, const Scenario& scenario);

std::vector<reference::Material> materials_of(const ModelParameters& model);

std::array<double, 3> in_file_frame(const reference::Vector& x, const ModelParameters& model);
reference::Vector in_body_frame(const std::array<double, 3>& mm, const ModelParameters& model);

/// For pictures and comparisons: no velocity, force or stress; each tet its own rotation.
BodyFields fields_of(const reference::Mesh& mesh, const reference::Positions& x, const Scenario& scenario);

}  // namespace palpate::sim
