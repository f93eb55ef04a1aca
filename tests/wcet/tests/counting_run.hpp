// For the target: calls every root with many arguments and prints the most instructions of each. QEMU with
// -icount shift=10 lets an instruction last 1024 ns, which are 25.6 counts of the board's 25 MHz timer.
#pragma once

#include <palpate/numeric/bounded.hpp>

using namespace palpate;
using Root = uint32_t (*)(uint32_t x, uint32_t full);
extern const Root roots[];
extern const uint32_t root_count;

namespace counting {

// CMSDK timer 0 of the MPS2 (Arm DAI0385): it counts down.
struct Timer {
  volatile uint32_t control, value, reload;
};
inline Timer& timer() { return *reinterpret_cast<Timer*>(0x40000000); }

// Arm, "Semihosting for AArch32 and AArch64": SYS_WRITE0 and SYS_EXIT.
inline void semihosting(uint32_t operation, const void* argument) {
  register uint32_t r0 asm("r0") = operation;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

inline void print(uint32_t number) {
  static char text[12] = "          \n";
  for (uint32_t at = 10; at-- > 0; number /= 10) text[at] = static_cast<char>('0' + number % 10);
  semihosting(0x04, text);
}

// Between the two readings: the call, all of the root, and one of the readings.
__attribute__((noinline)) inline uint32_t counts_of(Root root, uint32_t x, uint32_t full) {
  register uint32_t r0 asm("r0") = x;
  register uint32_t r1 asm("r1") = full;
  uint32_t before, after;
  asm volatile("ldr %[before], [%[value]]\n\tblx %[root]\n\tldr %[after], [%[value]]"
               : [before] "=&r"(before), [after] "=&r"(after), "+r"(r0), "+r"(r1)
               : [value] "r"(&timer().value), [root] "r"(root)
               : "r2", "r3", "r12", "lr", "cc", "memory");
  return before - after;
}

__attribute__((naked, noipa)) inline uint32_t only_return(uint32_t, uint32_t) { asm volatile("bx lr"); }

inline uint32_t instructions_of(Root root, uint32_t x, uint32_t full) {
  const uint32_t counts = counts_of(root, x, full) - counts_of(only_return, 0, 0);
  return (counts * 5 + 64) / 128 + 1;
}

inline void run() {
  timer().reload = 0xffffffff;
  timer().value = 0xffffffff;
  timer().control = 1;
  for (uint32_t i = 0; i < root_count; ++i) {
    uint32_t most = 0;
    uint32_t x = 1;
    for (uint32_t round = 0; round < 48; ++round) {
      x = x * 1664525u + 1013904223u;
      const uint32_t full = round % 3 == 0 ? ~0u : round % 3 == 1 ? 0 : x * 2654435761u;
      const uint32_t instructions = instructions_of(roots[i], x, full);
      if (instructions > most) most = instructions;
    }
    print(most);
  }
  semihosting(0x18, reinterpret_cast<const void*>(0x20026));
}

}  // namespace counting

extern "C" __attribute__((noreturn, used)) void reset() {
  counting::run();
  for (;;) asm volatile("");
}

struct Vectors {
  uint32_t stack;
  void (*reset)();
};
__attribute__((section(".vectors"), used)) const Vectors vectors{0x20400000, reset};
