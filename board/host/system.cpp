#include <cstdio>
#include <cstdlib>

#include "palpate/ports/console.hpp"
#include "palpate/ports/system.hpp"

namespace palpate::port {

void write_console(char character) { std::putchar(character); }

void initialize_board() {}

[[noreturn]] void exit_program(int status) { std::exit(status); }

uint32_t stack_peak_bytes() { return 0; }

}  // namespace palpate::port

int main() { palpate::port::run_firmware(); }
