// What Capstone says of one instruction, in the terms of the analysis.
#pragma once

#include <capstone/capstone.h>

#include "instruction.hpp"

namespace palpate::wcet {

Instruction classify(const cs_insn& from);

}  // namespace palpate::wcet
