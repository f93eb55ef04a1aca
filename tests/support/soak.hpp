// Long runs: PALPATE_SOAK=1 in the environment turns the tests' slices into them.
#pragma once

#include <cstdlib>
#include <cstring>

namespace palpate::test {

inline bool is_soak() {
  const char* soak = std::getenv("PALPATE_SOAK");
  return soak != nullptr && std::strcmp(soak, "0") != 0;
}

template <class Count>
Count in_soak(Count soak, Count otherwise) {
  return is_soak() ? soak : otherwise;
}

}  // namespace palpate::test
