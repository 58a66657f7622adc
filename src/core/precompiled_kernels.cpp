#include "core/precompiled_kernels.hpp"

#if !EIGEN_VERSION_AT_LEAST(3, 4, 90)
namespace Eigen::internal {

template struct general_matrix_vector_product<Index, double, const_blas_data_mapper<double, Index, ColMajor>,
                                              ColMajor, false, double,
                                              const_blas_data_mapper<double, Index, ColMajor>, false, 0>;
template struct general_matrix_vector_product<Index, double, const_blas_data_mapper<double, Index, RowMajor>,
                                              RowMajor, false, double,
                                              const_blas_data_mapper<double, Index, ColMajor>, false, 0>;
template struct general_matrix_vector_product<
    Index, std::complex<double>, const_blas_data_mapper<std::complex<double>, Index, ColMajor>, ColMajor,
    false, std::complex<double>, const_blas_data_mapper<std::complex<double>, Index, ColMajor>, false, 0>;
template struct general_matrix_vector_product<
    Index, std::complex<double>, const_blas_data_mapper<std::complex<double>, Index, RowMajor>, RowMajor,
    true, std::complex<double>, const_blas_data_mapper<std::complex<double>, Index, ColMajor>, false, 0>;
template struct gebp_kernel<double, double, Index, blas_data_mapper<double, Index, ColMajor>,
                            gebp_traits<double, double>::mr, gebp_traits<double, double>::nr, false, false>;
template struct gebp_kernel<std::complex<double>, std::complex<double>, Index,
                            blas_data_mapper<std::complex<double>, Index, ColMajor>,
                            gebp_traits<std::complex<double>, std::complex<double>>::mr,
                            gebp_traits<std::complex<double>, std::complex<double>>::nr, false, false>;
template struct gebp_kernel<std::complex<double>, std::complex<double>, Index,
                            blas_data_mapper<std::complex<double>, Index, ColMajor>,
                            gebp_traits<std::complex<double>, std::complex<double>>::mr,
                            gebp_traits<std::complex<double>, std::complex<double>>::nr, true, false>;
template struct triangular_solve_matrix<double, Index, OnTheLeft, UnitLower, false, ColMajor, ColMajor, 1>;
template struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, ColMajor, ColMajor, 1>;
template struct triangular_solve_matrix<std::complex<double>, Index, OnTheLeft, UnitLower, false, ColMajor,
                                        ColMajor, 1>;
template struct triangular_solve_matrix<std::complex<double>, Index, OnTheLeft, Upper, false, ColMajor,
                                        ColMajor, 1>;
template struct triangular_solve_vector<double, double, Index, OnTheLeft, UnitLower, false, ColMajor>;
template struct triangular_solve_vector<double, double, Index, OnTheLeft, Upper, false, ColMajor>;
template struct triangular_solve_vector<double, double, Index, OnTheLeft, UnitUpper, false, RowMajor>;
template struct triangular_solve_vector<double, double, Index, OnTheLeft, Lower, false, RowMajor>;
template PartialPivLU<MatrixXd>::RealScalar rcond_invmatrix_L1_norm_estimate<PartialPivLU<MatrixXd>>(
    const PartialPivLU<MatrixXd>&);

}  // namespace Eigen::internal
#endif
