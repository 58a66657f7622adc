// Explicit instantiations of the kernels of Eigen's dense products and triangular solves, compiled once
// (precompiled_kernels.cpp) and not in every file that multiplies matrices. The names are internal to Eigen
// 3.4; with later versions every file compiles its own kernels.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <complex>

#if !EIGEN_VERSION_AT_LEAST(3, 4, 90)
namespace Eigen::internal {

extern template struct general_matrix_vector_product<
    Index, double, const_blas_data_mapper<double, Index, ColMajor>, ColMajor, false, double,
    const_blas_data_mapper<double, Index, ColMajor>, false, 0>;
extern template struct general_matrix_vector_product<
    Index, double, const_blas_data_mapper<double, Index, RowMajor>, RowMajor, false, double,
    const_blas_data_mapper<double, Index, ColMajor>, false, 0>;
extern template struct general_matrix_vector_product<
    Index, std::complex<double>, const_blas_data_mapper<std::complex<double>, Index, ColMajor>, ColMajor,
    false, std::complex<double>, const_blas_data_mapper<std::complex<double>, Index, ColMajor>, false, 0>;
extern template struct general_matrix_vector_product<
    Index, std::complex<double>, const_blas_data_mapper<std::complex<double>, Index, RowMajor>, RowMajor,
    true, std::complex<double>, const_blas_data_mapper<std::complex<double>, Index, ColMajor>, false, 0>;
extern template struct gebp_kernel<double, double, Index, blas_data_mapper<double, Index, ColMajor>,
                                   gebp_traits<double, double>::mr, gebp_traits<double, double>::nr, false,
                                   false>;
extern template struct gebp_kernel<std::complex<double>, std::complex<double>, Index,
                                   blas_data_mapper<std::complex<double>, Index, ColMajor>,
                                   gebp_traits<std::complex<double>, std::complex<double>>::mr,
                                   gebp_traits<std::complex<double>, std::complex<double>>::nr, false, false>;
extern template struct gebp_kernel<std::complex<double>, std::complex<double>, Index,
                                   blas_data_mapper<std::complex<double>, Index, ColMajor>,
                                   gebp_traits<std::complex<double>, std::complex<double>>::mr,
                                   gebp_traits<std::complex<double>, std::complex<double>>::nr, true, false>;
extern template struct triangular_solve_matrix<double, Index, OnTheLeft, UnitLower, false, ColMajor, ColMajor,
                                               1>;
extern template struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, ColMajor, ColMajor, 1>;
extern template struct triangular_solve_matrix<std::complex<double>, Index, OnTheLeft, UnitLower, false,
                                               ColMajor, ColMajor, 1>;
extern template struct triangular_solve_matrix<std::complex<double>, Index, OnTheLeft, Upper, false, ColMajor,
                                               ColMajor, 1>;
extern template struct triangular_solve_vector<double, double, Index, OnTheLeft, UnitLower, false, ColMajor>;
extern template struct triangular_solve_vector<double, double, Index, OnTheLeft, Upper, false, ColMajor>;
extern template struct triangular_solve_vector<double, double, Index, OnTheLeft, UnitUpper, false, RowMajor>;
extern template struct triangular_solve_vector<double, double, Index, OnTheLeft, Lower, false, RowMajor>;
extern template PartialPivLU<MatrixXd>::RealScalar rcond_invmatrix_L1_norm_estimate<PartialPivLU<MatrixXd>>(
    const PartialPivLU<MatrixXd>&);

}  // namespace Eigen::internal
#endif
