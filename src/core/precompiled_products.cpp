#include "core/precompiled_products.hpp"

#include <type_traits>

#if !EIGEN_VERSION_AT_LEAST(3, 4, 90)
namespace eigentrail::compiled {
namespace {

using Eigen::ColMajor;
using Eigen::Dynamic;
using Eigen::Index;
using Eigen::RowMajor;

template <class Scalar, int order = ColMajor>
using Matrix = Eigen::Matrix<Scalar, Dynamic, Dynamic, order>;
template <class Scalar>
using Vector = Eigen::Matrix<Scalar, Dynamic, 1>;
template <class Plain>
using Rows = Eigen::Map<Plain, Eigen::Unaligned, Eigen::OuterStride<>>;
template <class Plain>
using Spaced = Eigen::Map<Plain, Eigen::Unaligned, Eigen::InnerStride<>>;

/// Calls use(order, conjugated) with the form of A as types.
template <class Scalar, class Use>
void with_form(const Factor<Scalar>& A, Use use) {
  const auto with_order = [&](auto conjugated) {
    if (A.by_rows)
      use(std::integral_constant<int, RowMajor>{}, conjugated);
    else
      use(std::integral_constant<int, ColMajor>{}, conjugated);
  };
  if constexpr (Eigen::NumTraits<Scalar>::IsComplex) {
    if (A.conjugated) return with_order(std::true_type{});
  }
  with_order(std::false_type{});
}

/// Calls use(order_A, conjugated_A, order_B, conjugated_B).
template <class Left, class Right, class Use>
void with_forms(const Factor<Left>& A, const Factor<Right>& B, Use use) {
  with_form(A, [&](auto order_A, auto conjugated_A) {
    with_form(B, [&](auto order_B, auto conjugated_B) { use(order_A, conjugated_A, order_B, conjugated_B); });
  });
}

template <int order, bool conjugated, class Scalar>
auto entries(const Factor<Scalar>& A) {
  return Rows<const Matrix<Scalar, order>>(A.data, A.rows, A.columns, Eigen::OuterStride<>(A.stride))
      .template conjugateIf<conjugated>();
}

template <class Scalar>
Result<Scalar> transposed(const Result<Scalar>& C) {
  return {C.data, C.columns, C.rows, C.stride, !C.by_rows};
}

template <class Left, class Scalar>
bool is_small(const Factor<Left>& A, const Result<Scalar>& C) {
  return A.columns + C.rows + C.columns < EIGEN_GEMM_TO_COEFFBASED_THRESHOLD && A.columns > 0;
}

/// C = A B for C by columns, coefficient by coefficient: of complex numbers a register holds but one.
template <class Left, class Right, class Target>
void set_small_product(const Factor<Left>& A, const Factor<Right>& B, Target& C) {
  with_forms(A, B, [&](auto order_A, auto conjugated_A, auto order_B, auto conjugated_B) {
    using Scalar = typename Target::Scalar;
    const auto AB = entries<order_A, conjugated_A>(A).lazyProduct(entries<order_B, conjugated_B>(B));
    if constexpr (Eigen::NumTraits<Scalar>::IsComplex) {
      for (Index j = 0; j < C.cols(); ++j) {
        for (Index i = 0; i < C.rows(); ++i) C(i, j) = AB.coeff(i, j);
      }
    } else {
      Eigen::internal::call_restricted_packet_assignment_no_alias(
          C, AB, Eigen::internal::assign_op<Scalar, Scalar>());
    }
  });
}

/// The same in an array that needs no memory of its own.
template <class Left, class Right, class Scalar>
auto small_product(const Factor<Left>& A, const Factor<Right>& B, const Result<Scalar>& C) {
  constexpr int most = EIGEN_GEMM_TO_COEFFBASED_THRESHOLD;
  Eigen::Matrix<Scalar, Dynamic, Dynamic, ColMajor, most, most> AB(C.rows, C.columns);
  set_small_product(A, B, AB);
  return AB;
}

/// Sum of a_i b_i. Eigen adds in another order if it knows that both vectors are dense.
template <class Left, class Right>
auto scalar_product(const Factor<Left>& a, const Factor<Right>& b, Index size) {
  using Scalar = ProductScalar<Left, Right>;
  const auto sum = [&](const auto& x, const auto& y) -> Scalar {
    const Scalar value = a.conjugated != b.conjugated ? x.dot(y) : x.cwiseProduct(y).sum();
    return b.conjugated ? Eigen::numext::conj(value) : value;
  };
  if (a.dense && b.dense)
    return sum(Eigen::Map<const Vector<Left>>(a.data, size), Eigen::Map<const Vector<Right>>(b.data, size));
  return sum(Spaced<const Vector<Left>>(a.data, size, Eigen::InnerStride<>(a.stride)),
             Spaced<const Vector<Right>>(b.data, size, Eigen::InnerStride<>(b.stride)));
}

template <class Scalar>
Factor<Scalar> first_column(Factor<Scalar> A) {
  return {A.data, A.rows, 1, A.by_rows ? A.stride : 1, false, A.conjugated, !A.by_rows};
}

template <class Scalar>
Result<Scalar> first_column(Result<Scalar> C) {
  return {C.data, C.rows, 1, C.by_rows ? C.stride : 1, false};
}

/// y += alpha A x by Eigen's kernel, which takes dense vectors y, if A is stored by columns, or x.
template <int order, bool conjugated_A, bool conjugated_x, class Left, class Right, class Scalar>
void add_by_kernel(Scalar alpha, const Factor<Left>& A, const Factor<Right>& x, const Result<Scalar>& y) {
  using MapA = Eigen::internal::const_blas_data_mapper<Left, Index, order>;
  using MapX = Eigen::internal::const_blas_data_mapper<Right, Index, order == ColMajor ? RowMajor : ColMajor>;
  Eigen::internal::general_matrix_vector_product<Index, Left, MapA, order, conjugated_A, Right, MapX,
                                                 conjugated_x>::run(A.rows, A.columns, MapA(A.data, A.stride),
                                                                    MapX(x.data, x.stride), y.data, y.stride,
                                                                    alpha);
}

}  // namespace

template <class Left, class Right, class Scalar>
void add_vector_product(Scalar alpha, const Factor<Left>& A, const Factor<Right>& x,
                        const Result<Scalar>& y) {
  if constexpr (!std::same_as<Right, Scalar>) {
    const Vector<Scalar> copy = Spaced<const Vector<Right>>(x.data, A.columns, Eigen::InnerStride<>(x.stride))
                                    .template cast<Scalar>();
    add_vector_product(alpha, A, Factor<Scalar>{copy.data(), A.columns, 1, 1, false, false, true}, y);
  } else if (A.rows == 1) {
    *y.data += alpha * scalar_product(first_column(transposed(A)), x, A.columns);
  } else if (A.by_rows && x.stride != 1) {
    const Vector<Right> copy = Spaced<const Vector<Right>>(x.data, A.columns, Eigen::InnerStride<>(x.stride));
    add_vector_product(alpha, A, Factor<Right>{copy.data(), A.columns, 1, 1, false, x.conjugated, true}, y);
  } else if (!A.by_rows && y.stride != 1) {
    Spaced<Vector<Scalar>> target(y.data, A.rows, Eigen::InnerStride<>(y.stride));
    Vector<Scalar> copy = target;
    add_vector_product(alpha, A, x, Result<Scalar>{copy.data(), A.rows, 1, 1, false});
    target = copy;
  } else {
    with_forms(A, x, [&](auto order, auto conjugated_A, auto, auto conjugated_x) {
      add_by_kernel<order, conjugated_A, conjugated_x>(alpha, A, x, y);
    });
  }
}

template <class Left, class Right, class Scalar>
void add_large_product(Scalar alpha, const Factor<Left>& A, const Factor<Right>& B, const Result<Scalar>& C) {
  if (A.rows == 0 || A.columns == 0 || B.columns == 0) return;
  if (C.columns == 1) return add_vector_product(alpha, A, first_column(B), first_column(C));
  if (C.rows == 1)
    return add_vector_product(alpha, transposed(B), first_column(transposed(A)), first_column(transposed(C)));
  if (C.by_rows) return add_large_product(alpha, transposed(B), transposed(A), transposed(C));
  Eigen::internal::gemm_blocking_space<ColMajor, Left, Right, Dynamic, Dynamic, Dynamic> blocking(
      C.rows, C.columns, A.columns, 1, true);
  with_forms(A, B, [&](auto order_A, auto conjugated_A, auto order_B, auto conjugated_B) {
    Eigen::internal::general_matrix_matrix_product<Index, Left, order_A, conjugated_A, Right, order_B,
                                                   conjugated_B, ColMajor, 1>::run(C.rows, C.columns,
                                                                                   A.columns, A.data,
                                                                                   A.stride, B.data, B.stride,
                                                                                   C.data, 1, C.stride, alpha,
                                                                                   blocking, nullptr);
  });
}

template <class Left, class Right, class Scalar>
void set_product(Scalar alpha, const Factor<Left>& A, const Factor<Right>& B, const Result<Scalar>& C) {
  if (C.by_rows) return set_product(alpha, transposed(B), transposed(A), transposed(C));
  Rows<Matrix<Scalar>> target(C.data, C.rows, C.columns, Eigen::OuterStride<>(C.stride));
  if (!is_small(A, C)) {
    target.setZero();
    add_large_product(alpha, A, B, C);
  } else if (alpha == 1.0) {
    set_small_product(A, B, target);
  } else {
    target = alpha * small_product(A, B, C);
  }
}

template <class Left, class Right, class Scalar>
void add_product(Scalar alpha, const Factor<Left>& A, const Factor<Right>& B, const Result<Scalar>& C) {
  if (C.by_rows) return add_product(alpha, transposed(B), transposed(A), transposed(C));
  if (!is_small(A, C)) return add_large_product(alpha, A, B, C);
  Rows<Matrix<Scalar>>(C.data, C.rows, C.columns, Eigen::OuterStride<>(C.stride)) +=
      alpha * small_product(A, B, C);
}

using Complex = std::complex<double>;
template void set_product(double, const Factor<double>&, const Factor<double>&, const Result<double>&);
template void add_product(double, const Factor<double>&, const Factor<double>&, const Result<double>&);
template void add_large_product(double, const Factor<double>&, const Factor<double>&, const Result<double>&);
template void set_product(Complex, const Factor<Complex>&, const Factor<Complex>&, const Result<Complex>&);
template void add_product(Complex, const Factor<Complex>&, const Factor<Complex>&, const Result<Complex>&);
template void add_large_product(Complex, const Factor<Complex>&, const Factor<Complex>&,
                                const Result<Complex>&);
template void set_product(Complex, const Factor<double>&, const Factor<Complex>&, const Result<Complex>&);
template void add_product(Complex, const Factor<double>&, const Factor<Complex>&, const Result<Complex>&);
template void add_large_product(Complex, const Factor<double>&, const Factor<Complex>&,
                                const Result<Complex>&);
template void set_product(Complex, const Factor<Complex>&, const Factor<double>&, const Result<Complex>&);
template void add_product(Complex, const Factor<Complex>&, const Factor<double>&, const Result<Complex>&);
template void add_large_product(Complex, const Factor<Complex>&, const Factor<double>&,
                                const Result<Complex>&);
template void add_vector_product(double, const Factor<double>&, const Factor<double>&, const Result<double>&);
template void add_vector_product(Complex, const Factor<Complex>&, const Factor<Complex>&,
                                 const Result<Complex>&);

}  // namespace eigentrail::compiled
#endif
