// How fast a body can vibrate, hence how short an explicit step must be.
#pragma once

#include "reference/mesh.hpp"

namespace palpate::reference {

/// Largest w, rad/s, of K v = w^2 M v at rest with lumped masses; held nodes do not move. By power iteration
/// on M^-1/2 K M^-1/2 until the Rayleigh quotient, which rises, changes by less than 1e-9 over 50 iterations.
/// The critical step of symplectic Euler without damping is 2 / w.
double largest_angular_frequency(const Mesh& mesh, const std::vector<Material>& materials,
                                 const std::vector<bool>& held);

}  // namespace palpate::reference
