// The rotation R (det R = +1) nearest to F: it maximises tr(R^T F).
#pragma once

#include "reference/mesh.hpp"

namespace palpate::reference {

/// By singular values: R = U diag(1, 1, det(U V^T)) V^T, any F. Where the nearest rotation is not unique (the
/// two smallest signed singular values add up to zero), one of them.
Matrix polar_rotation(const Matrix& f);

/// The same by Newton steps from `warm` until they vanish; falls back on singular values. Far cheaper from
/// near by.
Matrix polar_rotation(const Matrix& f, const Matrix& warm);

/// Vector a with a x v = (m - m^T) v / 2 doubled: the axial vector of m - m^T.
Vector axial_vector(const Matrix& m);
/// [a]x: the matrix of v -> a x v.
Matrix cross_matrix(const Vector& a);

/// Angle between two rotations, rad; exact to rounding also where it is small.
double angle_between(const Matrix& a, const Matrix& b);

}  // namespace palpate::reference
