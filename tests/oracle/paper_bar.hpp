// The paper's bar and its quarter turn.
#pragma once

#include "reference/mesh.hpp"

namespace palpate::test {

inline constexpr double kQuarterTurn = 1.5707963267948966;
inline constexpr double kEdgeM = 0.064;

inline reference::Material tissue() { return reference::material_of(500.0, 0.49, 10.0); }

}  // namespace palpate::test
