// expect: palpate: numbers do not become Q; use from_raw, ratio or narrow
#include "palpate/numeric/q.hpp"

auto sum(palpate::Q<4, 27> a) { return a + 3; }
