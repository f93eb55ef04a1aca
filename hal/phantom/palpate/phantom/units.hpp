// Formats of the quantities at the device's border, all SI.
#pragma once

#include "palpate/numeric/linear.hpp"

namespace palpate::phantom {

using Metre = Q<0, 31>;        ///< positions: +-1 m, LSB 0.47 nm
using Length = Q<-2, 33>;      ///< link lengths: below 0.25 m, LSB 0.12 nm
using Lever = Q<-1, 32>;       ///< their projections and sums: +-0.5 m, LSB 0.23 nm
using Newton = Q<4, 27>;       ///< forces: +-16 N a component, LSB 7.5 nN
using NewtonMetre = Q<5, 26>;  ///< joint torques: +-32 N m, LSB 15 nN m

}  // namespace palpate::phantom
