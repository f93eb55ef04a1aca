#include "text.hpp"

#include "palpate/ports/console.hpp"

namespace palpate::firmware {

void print(const char* text) {
  for (; *text != '\0'; ++text) port::write_console(*text);
}

void print_decimal(uint32_t value) {
  constexpr uint32_t kMaxDigits = 10;
  std::array<char, kMaxDigits> digits{};
  uint32_t count = 0;
  do {
    digits[count++] = static_cast<char>('0' + value % 10);
    value /= 10;
  } while (value != 0);
  while (count > 0) port::write_console(digits[--count]);
}

void print_decimal(int32_t value) {
  if (value < 0) port::write_console('-');
  const auto bits = static_cast<uint32_t>(value);
  print_decimal(value < 0 ? 0u - bits : bits);
}

void print_hex(uint64_t value) {
  constexpr int kTopNibble = 60;
  for (int shift = kTopNibble; shift >= 0; shift -= 4) {
    port::write_console("0123456789abcdef"[static_cast<uint32_t>(value >> shift) & 15]);
  }
}

}  // namespace palpate::firmware
