// Eigen's dense products of real and of complex matrices, compiled once (precompiled_products.cpp). Eigen 3.4
// generates all forms of a product (for small matrices, for vectors, by blocks) anew for every pair of types
// that a file multiplies. The functions here do the same operations in the same order. The names are internal
// to Eigen 3.4; with later versions every file generates its own products.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <concepts>

#if !EIGEN_VERSION_AT_LEAST(3, 4, 90)
namespace eigentrail::compiled {

/// Factor of a product, in memory. The entries of a column of a matrix (of a row, if `by_rows`) lie side by
/// side; `stride` is the distance of the columns or rows. Of a vector it is the distance of the entries, and
/// `dense` says that the compiler knows it to be one.
template <class Scalar>
struct Factor {
  const Scalar* data;
  Eigen::Index rows, columns, stride;
  bool by_rows, conjugated, dense;
};

/// Where a product goes: to a matrix as above, or to a vector.
template <class Scalar>
struct Result {
  Scalar* data;
  Eigen::Index rows, columns, stride;
  bool by_rows;
};

template <class A, class B>
using ProductScalar = std::conditional_t<std::same_as<A, B>, A, std::complex<double>>;

/// C = alpha A B.
template <class Left, class Right, class Scalar>
void set_product(Scalar alpha, const Factor<Left>& A, const Factor<Right>& B, const Result<Scalar>& C);
/// C += alpha A B.
template <class Left, class Right, class Scalar>
void add_product(Scalar alpha, const Factor<Left>& A, const Factor<Right>& B, const Result<Scalar>& C);
/// The same for matrices of any size as for large ones.
template <class Left, class Right, class Scalar>
void add_large_product(Scalar alpha, const Factor<Left>& A, const Factor<Right>& B, const Result<Scalar>& C);
/// y += alpha A x, for vectors x and y.
template <class Left, class Right, class Scalar>
void add_vector_product(Scalar alpha, const Factor<Left>& A, const Factor<Right>& x, const Result<Scalar>& y);

template <class Scalar>
concept Compiled = std::same_as<Scalar, double> || std::same_as<Scalar, std::complex<double>>;

template <class Expression>
inline constexpr bool in_memory = Eigen::internal::blas_traits<Expression>::HasUsableDirectAccess;

/// Calls use(A) with the factor that an expression is, transposed or conjugated, or with its value.
template <class Expression, class Use>
void with_factor(const Expression& expression, Use use) {
  using Traits = Eigen::internal::blas_traits<Expression>;
  const typename Traits::DirectLinearAccessType& A = Traits::extract(expression);
  using Stored = std::remove_cvref_t<decltype(A)>;
  use(Factor<typename Expression::Scalar>{
      A.data(), A.rows(), A.cols(), Stored::IsVectorAtCompileTime ? A.innerStride() : A.outerStride(),
      bool(Stored::IsRowMajor), bool(Traits::NeedToConjugate), int(Stored::InnerStrideAtCompileTime) == 1});
}

/// Calls use(C) with the place of a result, or of a copy where its entries do not lie side by side.
template <class Expression, class Use>
void with_result(Expression& expression, Use use) {
  if constexpr (in_memory<Expression>) {
    constexpr bool is_vector = Expression::IsVectorAtCompileTime;
    use(Result<typename Expression::Scalar>{expression.data(), expression.rows(), expression.cols(),
                                            is_vector ? expression.innerStride() : expression.outerStride(),
                                            bool(Expression::IsRowMajor)});
  } else {
    typename Expression::PlainObject copy = expression;
    with_result(copy, use);
    expression = copy;
  }
}

template <class Scalar>
Factor<Scalar> transposed(const Factor<Scalar>& A) {
  return {A.data, A.columns, A.rows, A.stride, !A.by_rows, A.conjugated, A.dense};
}

/// A product of matrices with sums of any length.
template <class Left, class Right>
concept Matrices = Compiled<typename Left::Scalar> && Compiled<typename Right::Scalar> &&
                   Left::ColsAtCompileTime == Eigen::Dynamic&& Right::RowsAtCompileTime == Eigen::Dynamic;

/// The matrix of a product with a vector: a product itself is evaluated, another expression stays one.
template <class Left, class Right>
using MatrixOf = std::remove_cvref_t<typename Eigen::internal::nested_eval<
    std::conditional_t<bool(Left::IsVectorAtCompileTime), Right, Left>, 1>::type>;

/// A product with a vector on one side, of a matrix that is in memory.
template <class Left, class Right>
concept MatrixAndVector = Matrices<Left, Right> &&
    std::same_as<typename Left::Scalar, typename Right::Scalar> && in_memory<MatrixOf<Left, Right>>;

}  // namespace eigentrail::compiled

namespace Eigen::internal {

template <class Left, class Right>
requires eigentrail::compiled::Matrices<Left, Right>
struct generic_product_impl<Left, Right, DenseShape, DenseShape, GemmProduct> {
  using A = typename Left::Scalar;
  using B = typename Right::Scalar;
  using Scalar = eigentrail::compiled::ProductScalar<A, B>;
  template <class Result>
  static void evalTo(Result& result, const Left& left, const Right& right) {
    run<eigentrail::compiled::set_product<A, B, Scalar>>(result, left, right, 1.0);
  }
  template <class Result>
  static void addTo(Result& result, const Left& left, const Right& right) {
    run<eigentrail::compiled::add_product<A, B, Scalar>>(result, left, right, 1.0);
  }
  template <class Result>
  static void subTo(Result& result, const Left& left, const Right& right) {
    run<eigentrail::compiled::add_product<A, B, Scalar>>(result, left, right, -1.0);
  }
  template <class Result>
  static void scaleAndAddTo(Result& result, const Left& left, const Right& right, const Scalar& alpha) {
    run<eigentrail::compiled::add_large_product<A, B, Scalar>>(result, left, right, alpha);
  }

 private:
  template <auto function, class Result>
  static void run(Result& result, const Left& left, const Right& right, Scalar alpha) {
    using namespace eigentrail::compiled;
    alpha = combine_scalar_factors(alpha, left, right);
    with_factor(left, [&](const Factor<A>& a) {
      with_factor(right, [&](const Factor<B>& b) {
        with_result(result, [&](const auto& c) { function(alpha, a, b, c); });
      });
    });
  }
};

template <class Left, class Right>
requires eigentrail::compiled::MatrixAndVector<Left, Right>
struct generic_product_impl<Left, Right, DenseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<Left, Right,
                                generic_product_impl<Left, Right, DenseShape, DenseShape, GemvProduct>> {
  using Scalar = typename Left::Scalar;
  template <class Result>
  static void scaleAndAddTo(Result& result, const Left& left, const Right& right, const Scalar& alpha) {
    using namespace eigentrail::compiled;
    const Scalar scale = combine_scalar_factors(alpha, left, right);
    with_factor(left, [&](const Factor<Scalar>& a) {
      with_factor(right, [&](const Factor<Scalar>& b) {
        with_result(result, [&](auto y) {
          // A matrix may be what a row or a column is written to.
          if (!Result::IsVectorAtCompileTime && y.by_rows == bool(Left::IsVectorAtCompileTime)) y.stride = 1;
          if constexpr (Left::IsVectorAtCompileTime)
            add_vector_product(scale, transposed(b), transposed(a), y);
          else
            add_vector_product(scale, a, b, y);
        });
      });
    });
  }
};

}  // namespace Eigen::internal
#endif
