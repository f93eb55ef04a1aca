// The seed is fixed, so that every run of the tests is the same run; RC_PARAMS in the environment overrides
// it.
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/soak.hpp"

int main(int argc, char** argv) {
  const bool soak = palpate::test::is_soak();
  setenv("RC_PARAMS", soak ? "seed=20260729 max_success=20000" : "seed=20260729 max_success=400", 0);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
