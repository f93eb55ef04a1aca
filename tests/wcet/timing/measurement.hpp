// The most instructions that a search for the worst case saw in QEMU, as its tests leave it beside the image.
#pragma once

#include <optional>
#include <string>

#include "flow_network.hpp"

namespace palpate::wcet::timing {

struct Measurement {
  Cycles max_observed_instructions = 0;
  std::optional<double> coverage_percent;  // of the tick's instructions, that some run reached
};

/// Nothing where there is no such file: nobody has measured. Throws BadInput.
std::optional<Measurement> read_measurement(const std::string& path);

}  // namespace palpate::wcet::timing
