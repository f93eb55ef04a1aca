// Called by libFuzzer.
#include <cstdio>
#include <cstdlib>

#include "link_harness.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  if (!palpate::test::reads_rightly(data, size)) {
    std::fprintf(stderr, "the reader and its reference differ\n");
    std::abort();
  }
  return 0;
}
