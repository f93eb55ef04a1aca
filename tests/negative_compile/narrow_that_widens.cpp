// expect: palpate: narrow only drops fraction bits; widen the factors instead
#include "palpate/numeric/q.hpp"

auto more_bits(palpate::Acc<20> a) { return palpate::narrow<palpate::Q<0, 31>>(a); }
