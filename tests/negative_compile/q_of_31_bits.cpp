// expect: palpate: Q<I, F> has 32 bits, so I \+ F must be 31
#include "palpate/numeric/q.hpp"

palpate::Q<3, 27> narrow_one() { return palpate::Q<3, 27>::from_raw(1); }
