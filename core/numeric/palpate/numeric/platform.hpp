// The only place where core, hal and firmware see system headers. Target builds force-include it before
// everything else, so that after it the words `float` and `double` can be made errors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#if defined(PALPATE_CHECKED) && !defined(PALPATE_TARGET)
#include <cstdio>
#include <cstdlib>
#endif

#ifndef EIGEN_NO_MALLOC
#define EIGEN_NO_MALLOC
#endif
#ifndef EIGEN_NO_IO
#define EIGEN_NO_IO
#endif
#ifndef EIGEN_NO_DEBUG
#define EIGEN_NO_DEBUG
#endif
#ifndef EIGEN_DONT_VECTORIZE
#define EIGEN_DONT_VECTORIZE
#endif
// 3x3 products unroll completely: a loop of Eigen's would have no flow fact.
#ifndef EIGEN_UNROLLING_LIMIT
#define EIGEN_UNROLLING_LIMIT 1000
#endif
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-enum-enum-conversion"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <Eigen/Core>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#ifdef PALPATE_TARGET
#pragma GCC poison float double
#endif

static_assert((-1 >> 1) == -1, "palpate: right shift of a negative number must be arithmetic");
static_assert(sizeof(int) == 4, "palpate: int must have 32 bits");

#define PALPATE_NOINLINE __attribute__((noinline))
#define PALPATE_ALWAYS_INLINE inline __attribute__((always_inline))
