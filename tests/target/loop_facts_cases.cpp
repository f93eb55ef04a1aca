// Small functions for the self-test of loop_facts_test: what it must find, and what it must accept. Nobody
// runs them.
#include "palpate/numeric/bounded.hpp"
#include "palpate/ports/system.hpp"
#include "palpate/ports/tick_timer.hpp"

#define PALPATE_CASE __attribute__((noipa))
#define PALPATE_ASSEMBLER_CASE extern "C" __attribute__((naked, noipa))

namespace palpate::cases {

// The compiler must not turn loops into formulas, nor calls into loops.
inline void keep() { asm volatile("" : : : "memory"); }

PALPATE_CASE void bounded_loops(uint32_t count) {
  for ([[maybe_unused]] const uint32_t i : bounded<20>(count, [] {})) {
    for ([[maybe_unused]] const uint32_t j : bounded<7>(count, [] {})) keep();
  }
}

struct Place {};
using Total = decltype(bounded_total<20>(Place{}));

PALPATE_CASE void take_from(Total& total, uint32_t count) {
  for ([[maybe_unused]] const uint32_t i : total.take(0, count)) keep();
}

PALPATE_CASE void shared_total(uint32_t count) {
  Total total = bounded_total<20>(Place{});
  for ([[maybe_unused]] const uint32_t i : bounded<7>(count, [] {})) take_from(total, count);
}

struct NobodysPlace {};
using NobodysTotal = decltype(bounded_total<20>(NobodysPlace{}));

// Nothing in the program makes such a total.
PALPATE_CASE void take_from_nobody(NobodysTotal& total) {
  for ([[maybe_unused]] const uint32_t i : total.take(0, 5)) keep();
}

// Each round makes a total of its own.
PALPATE_CASE void total_in_a_loop_without_fact(uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) {
    auto total = bounded_total<20>([] {});
    for ([[maybe_unused]] const uint32_t j : total.take(0, count)) keep();
  }
}

PALPATE_CASE void loop_without_fact(uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) keep();
}

// Each round of the outer loop passes the inner one's fact, which says nothing about the outer one.
PALPATE_CASE void outer_loop_without_fact(uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) {
    for ([[maybe_unused]] const uint32_t j : bounded<7>(7, [] {})) keep();
  }
}

PALPATE_CASE void callee_without_fact(uint32_t count) {
  bounded_loops(count);
  loop_without_fact(count);
  keep();
}

PALPATE_CASE uint32_t recursion(uint32_t count) {
  if (count == 0) return 0;
  const uint32_t below = recursion(count - 1);
  keep();
  return below + count;
}

PALPATE_CASE uint32_t odd(uint32_t count);
PALPATE_CASE uint32_t recursion_by_tail_calls(uint32_t count) { return count == 0 ? 1 : odd(count - 1); }
PALPATE_CASE uint32_t odd(uint32_t count) { return count == 0 ? 0 : recursion_by_tail_calls(count - 1); }

PALPATE_CASE void indirect_call(void (*function)()) {
  function();
  keep();
}

// The compiler's own helper would bring unwind tables.
PALPATE_ASSEMBLER_CASE void __aeabi_ldivmod() { asm volatile("bx lr"); }
PALPATE_CASE int64_t library_division(int64_t a, int64_t b) { return a / b; }

PALPATE_CASE void library_copy(uint32_t* to, const uint32_t* from, uint32_t words) {
  __builtin_memcpy(to, from, words * sizeof(uint32_t));
}

PALPATE_ASSEMBLER_CASE void backward_branch_without_loop() {
  asm volatile("b 2f\n1: adds r0, #1\n\tbx lr\n2: cmp r0, #0\n\tbeq 1b\n\tbx lr");
}

PALPATE_ASSEMBLER_CASE void loop_past_a_predicated_return() {
  asm volatile("push {r4, lr}\n1: subs r0, #1\n\tit eq\n\tpopeq {r4, pc}\n\tb 1b");
}

// Only the table leads to the loop.
PALPATE_ASSEMBLER_CASE void loop_behind_a_table() {
  asm volatile(
      "tbb [pc, r0]\n3: .byte (1f - 3b) / 2, (2f - 3b) / 2\n"
      "1: bx lr\n2: subs r0, #1\n\tbne 2b\n\tbx lr");
}

PALPATE_ASSEMBLER_CASE void computed_jump() { asm volatile("bx r0"); }

}  // namespace palpate::cases

namespace palpate::port {

void on_tick() {}

// The linker keeps what is called.
void run_firmware() {
  cases::bounded_loops(5);
  cases::shared_total(5);
  cases::total_in_a_loop_without_fact(5);
  uint32_t nobodys[1] = {0};
  cases::take_from_nobody(*reinterpret_cast<cases::NobodysTotal*>(nobodys));
  cases::outer_loop_without_fact(5);
  cases::callee_without_fact(5);
  cases::recursion(5);
  cases::recursion_by_tail_calls(5);
  cases::indirect_call(on_tick);
  cases::library_division(5, 3);
  uint32_t words[2] = {1, 2};
  cases::library_copy(words, words + 1, 1);
  cases::backward_branch_without_loop();
  cases::loop_past_a_predicated_return();
  cases::loop_behind_a_table();
  cases::computed_jump();
  exit_program(0);
}

}  // namespace palpate::port
