// Machine code to instructions, by Capstone.
#pragma once

#include <map>

#include "elf_image.hpp"
#include "instruction.hpp"

namespace palpate::wcet {

/// All Thumb code of the executable sections, by address. What can't be decoded is there as kUndecodable.
std::map<uint32_t, Instruction> decode(const ElfImage& image);

}  // namespace palpate::wcet
