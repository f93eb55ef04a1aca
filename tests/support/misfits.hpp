// The misfits of all groups at once, of which a tick renews a part.
#pragma once

#include "palpate/elastic/misfit_sweep.hpp"

namespace palpate::test {

template <class Profile>
void renew_all_misfits(const Forest<Profile>& forest, const RotationFront<Profile>& front,
                       Groups<Profile>& groups) {
  MisfitSweep sweep{};
  sweep.clear();
  for (uint32_t tick = 0; tick < 2 * kMisfitSlices; ++tick) renew_misfits(forest, front, groups, sweep);
}

}  // namespace palpate::test
