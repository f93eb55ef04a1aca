// expect: success
#include "palpate/numeric/linear.hpp"

using Unit = palpate::Q<0, 31>;

// Everything that the other files here get wrong, done right.
Unit all_of_it(Unit a, palpate::Q<4, 27> b) {
  const Unit sum = a + palpate::narrow<Unit>(palpate::widen<31>(a));
  const Unit plus_three = palpate::Q<0, 31>::ratio(3, 4) + sum;
  const palpate::Acc<58> products = a * b + palpate::widen<58>(b);
  return palpate::narrow<palpate::Q<4, 27>>(products) > b ? plus_three : a;
}
