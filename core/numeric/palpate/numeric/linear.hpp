// Vectors and matrices of Q, held by Eigen with fixed sizes. A product of two Q matrices is a matrix of
// accumulators; narrow<To> brings it back. A 3x3 times a vector compiles to smull, smlal, smlal a row.
#pragma once

#include "palpate/numeric/q.hpp"

namespace Eigen {

template <int I, int F>
struct NumTraits<palpate::Q<I, F>> {
  using Real = palpate::Q<I, F>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};

template <int F>
struct NumTraits<palpate::Acc<F>> {
  using Real = palpate::Acc<F>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 2,
    MulCost = 1
  };
};

// Equal formats need their own entry: the pair (Q, Q) -> Acc is not Eigen's T x T -> T.
template <int I, int F>
struct ScalarBinaryOpTraits<palpate::Q<I, F>, palpate::Q<I, F>,
                            internal::scalar_product_op<palpate::Q<I, F>, palpate::Q<I, F>>> {
  using ReturnType = palpate::Acc<2 * F>;
};
template <int I1, int F1, int I2, int F2>
struct ScalarBinaryOpTraits<palpate::Q<I1, F1>, palpate::Q<I2, F2>,
                            internal::scalar_product_op<palpate::Q<I1, F1>, palpate::Q<I2, F2>>> {
  using ReturnType = palpate::Acc<F1 + F2>;
};

}  // namespace Eigen

namespace palpate {

template <class Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <class Scalar>
using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;

/// narrow of each coefficient.
template <class To, class Derived>
constexpr auto narrow(const Eigen::MatrixBase<Derived>& accumulators) {
  using Plain = Eigen::Matrix<To, Derived::RowsAtCompileTime, Derived::ColsAtCompileTime>;
  static_assert(Plain::SizeAtCompileTime != Eigen::Dynamic, "palpate: matrices of Q have fixed sizes");
  return Plain(accumulators.unaryExpr([](auto acc) { return narrow<To>(acc); }));
}

/// narrow of each coefficient of a product as it is made, without a matrix of accumulators between.
template <class To, class Left, class Right>
constexpr auto narrow(const Eigen::Product<Left, Right, Eigen::DefaultProduct>& product) {
  return narrow<To>(product.lhs().lazyProduct(product.rhs()));
}

template <class Scalar>
constexpr Vector3<Scalar> zero_vector() {
  const Scalar zero = Scalar::from_raw(0);
  return Vector3<Scalar>(zero, zero, zero);
}

/// v . v; the caller knows that the sum fits 64 bits.
template <class Scalar>
constexpr Acc<2 * Scalar::kFractionBits> square_of(const Vector3<Scalar>& v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

/// a . b, as above.
template <class A, class B>
constexpr Acc<A::kFractionBits + B::kFractionBits> dot(const Vector3<A>& a, const Vector3<B>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace palpate
