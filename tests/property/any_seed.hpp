// Seeds that RapidCheck draws.
#pragma once

#include <rapidcheck.h>

#include <cstdint>

namespace palpate::test {

/// Not shrunk: a smaller seed is not a simpler case.
inline uint64_t any_seed() { return *rc::gen::noShrink(rc::gen::arbitrary<uint64_t>()); }

}  // namespace palpate::test
