// Self-tests of the checked build (-DPALPATE_CHECKED): every numeric operation verifies its own result.
// In all other builds a check costs nothing.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate {

#ifdef PALPATE_CHECKED
#ifdef PALPATE_TARGET
[[noreturn]] inline void check_failed(const char*) { __builtin_trap(); }
#else
[[noreturn]] inline void check_failed(const char* what) {
  std::fprintf(stderr, "palpate: check failed: %s\n", what);
  std::abort();
}
#endif
constexpr void check(bool holds, const char* what) {
  if (!holds) check_failed(what);
}
#else
constexpr void check(bool, const char*) {}
#endif

}  // namespace palpate
