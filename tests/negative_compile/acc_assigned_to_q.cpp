// expect: palpate: an Acc does not become a Q by itself
#include "palpate/numeric/q.hpp"

void assign(palpate::Q<0, 31>& q) { q = q * q; }
