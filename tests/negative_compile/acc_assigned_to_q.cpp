// expect: (no match for .operator=.*Acc<62>|no viable overloaded '=')
#include "palpate/numeric/q.hpp"

void assign(palpate::Q<0, 31>& q) { q = q * q; }
