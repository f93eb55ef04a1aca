// expect: palpate: Acc \+ Acc needs equal fraction bits
#include "palpate/numeric/q.hpp"

auto sum(palpate::Acc<62> a, palpate::Acc<58> b) { return a + b; }
