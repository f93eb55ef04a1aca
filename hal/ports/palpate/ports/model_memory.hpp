// Port: where the model lies that the board was given, apart from the program.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

struct ModelMemory {
  const uint8_t* bytes;
  uint32_t size;
};

/// The memory that holds a model as a container (docs/container-format.md), and whatever follows it up to
/// `size`. Its content is not trusted: the firmware checks it.
///
/// Called by: the background, once, before ticks start.
ModelMemory model_memory();

}  // namespace palpate::port
