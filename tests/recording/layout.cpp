// A snapshot's layout: prints this machine's fingerprints as options for another compiler, which then checks
// that its own are the same.
#include "palpate/firmware/state_layout.hpp"
#include "palpate/tick/profiles.hpp"

#ifdef PALPATE_LAYOUT_CUBOID_PAPER

namespace palpate::firmware {

static_assert(layout_fingerprint<CuboidPaper>() == PALPATE_LAYOUT_CUBOID_PAPER);
static_assert(layout_fingerprint<CuboidDense>() == PALPATE_LAYOUT_CUBOID_DENSE);
static_assert(layout_fingerprint<Organ>() == PALPATE_LAYOUT_ORGAN);
static_assert(layout_fingerprint<Small>() == PALPATE_LAYOUT_SMALL);
static_assert(layout_fingerprint<Tiny>() == PALPATE_LAYOUT_TINY);

}  // namespace palpate::firmware

#else

#include <cstdio>

int main() {
  const auto print = [](const char* name, uint64_t fingerprint) {
    std::printf("-DPALPATE_LAYOUT_%s=0x%016llxu;", name, static_cast<unsigned long long>(fingerprint));
  };
  print("CUBOID_PAPER", palpate::firmware::layout_fingerprint<palpate::CuboidPaper>());
  print("CUBOID_DENSE", palpate::firmware::layout_fingerprint<palpate::CuboidDense>());
  print("ORGAN", palpate::firmware::layout_fingerprint<palpate::Organ>());
  print("SMALL", palpate::firmware::layout_fingerprint<palpate::Small>());
  print("TINY", palpate::firmware::layout_fingerprint<palpate::Tiny>());
}

#endif
