// Text output of the background: names, numbers and hashes, without a library and without division by
// anything but ten.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::firmware {

void print(const char* text);
void print_decimal(uint32_t value);
void print_decimal(int32_t value);
/// 16 hexadecimal digits.
void print_hex(uint64_t value);

}  // namespace palpate::firmware
