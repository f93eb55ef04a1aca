// The device of the worst case: what its ports say is what the adversary wants.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::worst_case {

struct Inputs {
  std::array<int32_t, 3> encoder_counts;
  uint32_t reading_number;
  uint32_t buttons;
  uint32_t device_status;
};
extern Inputs g_inputs;

}  // namespace palpate::worst_case
