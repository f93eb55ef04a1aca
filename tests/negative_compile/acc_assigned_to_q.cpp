// expect: (no match for 'operator='|no viable overloaded '=').*Acc<62>
#include "palpate/numeric/q.hpp"

void assign(palpate::Q<0, 31>& q) { q = q * q; }
