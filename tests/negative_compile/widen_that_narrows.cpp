// expect: palpate: widen adds fraction bits, at most 32
#include "palpate/numeric/q.hpp"

auto fewer_bits(palpate::Q<0, 31> a) { return palpate::widen<30>(a); }
