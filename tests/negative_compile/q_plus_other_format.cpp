// expect: palpate: Q \+ Q needs one format; narrow one side first
#include "palpate/numeric/q.hpp"

auto sum(palpate::Q<0, 31> a, palpate::Q<4, 27> b) { return a + b; }
