// The paper's static experiments on a bar along z whose mesh is centred on the origin.
#pragma once

#include "reference/static_solver.hpp"

namespace palpate::reference {

/// How the second end of a bar is turned: twisted about the bar's axis, then bent aside.
struct EndTurn {
  double bend_rad = 0.0;
  double twist_rad = 0.0;
};

/// Whose frame a bend is solved in. A model that turns with its frame has the same answer in both, but
/// Newton's method with St. Venant-Kirchhoff finds it only from the middle: from the held end's frame it
/// falls onto spurious branches from 80 degrees on. The linear model's answer is meant in the held end's
/// frame.
enum class BendFrame { kHeldEnd, kMiddle };

/// One end face (z = -length / 2) held, the other twisted about z and moved so that the centre line, its
/// length kept, is an arc in the x-z plane. The first guess of a load step turns each free node with its
/// cross-section.
StaticProblem turned_end_problem(const Mesh& mesh, const Material& material, const EndTurn& turn,
                                 BendFrame frame, int load_steps = 15);

/// Experiment 1: bent only.
StaticProblem bend_problem(const Mesh& mesh, const Material& material, double angle_rad, BendFrame frame,
                           int load_steps = 15);

/// Twisted only.
StaticProblem twist_problem(const Mesh& mesh, const Material& material, double angle_rad);

/// Positions that were solved in the frame of the middle, in the held end's frame.
Positions in_held_end_frame(Positions x, double length_m, double bend_rad);

/// The face z = -length / 2 held, and z = +length / 2 too if `both_ends`; one node is moved by
/// `displacement`, m.
StaticProblem driven_node_problem(const Mesh& mesh, const Material& material, bool both_ends, uint32_t node,
                                  const Vector& displacement);

/// Experiment 2: a corner of the free end driven along y.
StaticProblem corner_problem(const Mesh& mesh, const Material& material, double displacement_m);

/// Both ends held, the node in the middle of the long face x = max pushed in.
StaticProblem indentation_problem(const Mesh& mesh, const Material& material, double depth_m);

/// The node whose rest position is nearest to `point`, m.
uint32_t node_nearest(const Mesh& mesh, const Vector& point);

/// The far corner of the mesh's bounding box, m.
Vector upper_corner(const Mesh& mesh);

/// Distance of two results in the nodes that are free, mm.
struct Distance {
  double mean_mm, max_mm, min_mm;
};
Distance distance_of(const Positions& a, const Positions& b, const std::vector<bool>& prescribed);

/// Sum over the tets of det F V, relative to the rest volume, minus 1.
double volume_change(const Mesh& mesh, const Positions& x);

}  // namespace palpate::reference
