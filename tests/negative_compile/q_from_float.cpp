// expect: palpate: numbers do not become Q; use from_raw, ratio or narrow
#include "palpate/numeric/q.hpp"

palpate::Q<4, 27> one() {
  palpate::Q<4, 27> q = 1.0f;
  return q;
}
