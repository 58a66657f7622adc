// Precompiled header: what most files include is parsed once per target, and the decompositions that most of
// them use are compiled once (decompositions_*.cpp). No file may depend on it: builds without it (preset dev)
// give the same program and only take longer.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/precompiled_kernels.hpp"
#include "core/precompiled_products.hpp"

extern template class Eigen::PartialPivLU<Eigen::MatrixXd>;
extern template class Eigen::PartialPivLU<Eigen::MatrixXcd>;
extern template class Eigen::FullPivLU<Eigen::MatrixXd>;
extern template class Eigen::LLT<Eigen::MatrixXd>;
extern template class Eigen::HouseholderQR<Eigen::MatrixXd>;
extern template class Eigen::HouseholderQR<Eigen::MatrixXcd>;
extern template class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;
extern template class Eigen::ColPivHouseholderQR<Eigen::MatrixXcd>;
extern template class Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>;
extern template class Eigen::ComplexSchur<Eigen::MatrixXcd>;
extern template class Eigen::EigenSolver<Eigen::MatrixXd>;
extern template class Eigen::ComplexEigenSolver<Eigen::MatrixXcd>;
extern template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
extern template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>;

// Member functions that are templates themselves
extern template Eigen::ComplexSchur<Eigen::MatrixXcd>& Eigen::ComplexSchur<Eigen::MatrixXcd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXcd>&, bool);
extern template Eigen::EigenSolver<Eigen::MatrixXd>& Eigen::EigenSolver<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&, bool);
extern template Eigen::ComplexEigenSolver<Eigen::MatrixXcd>&
Eigen::ComplexEigenSolver<Eigen::MatrixXcd>::compute(const Eigen::EigenBase<Eigen::MatrixXcd>&, bool);
extern template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute(const Eigen::EigenBase<Eigen::MatrixXd>&, int);
extern template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>::compute(const Eigen::EigenBase<Eigen::MatrixXcd>&, int);
extern template Eigen::LLT<Eigen::MatrixXd>& Eigen::LLT<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&);
extern template double Eigen::internal::rcond_invmatrix_L1_norm_estimate(
    const Eigen::PartialPivLU<Eigen::MatrixXcd>&);
extern template double Eigen::internal::rcond_invmatrix_L1_norm_estimate(
    const Eigen::FullPivLU<Eigen::MatrixXd>&);
extern template double Eigen::internal::rcond_invmatrix_L1_norm_estimate(const Eigen::LLT<Eigen::MatrixXd>&);

// Solutions for right sides that are matrices or vectors in memory: other expressions are evaluated first.
extern template void Eigen::PartialPivLU<Eigen::MatrixXd>::_solve_impl(const Eigen::MatrixXd&,
                                                                       Eigen::MatrixXd&) const;
extern template void Eigen::PartialPivLU<Eigen::MatrixXd>::_solve_impl(const Eigen::VectorXd&,
                                                                       Eigen::VectorXd&) const;
extern template void Eigen::PartialPivLU<Eigen::MatrixXcd>::_solve_impl(const Eigen::MatrixXcd&,
                                                                        Eigen::MatrixXcd&) const;
extern template void Eigen::FullPivLU<Eigen::MatrixXd>::_solve_impl(const Eigen::VectorXd&,
                                                                    Eigen::VectorXd&) const;
extern template void Eigen::HouseholderQR<Eigen::MatrixXcd>::_solve_impl(const Eigen::MatrixXcd&,
                                                                         Eigen::MatrixXcd&) const;
extern template void Eigen::ColPivHouseholderQR<Eigen::MatrixXd>::_solve_impl(const Eigen::MatrixXd&,
                                                                              Eigen::MatrixXd&) const;
extern template void Eigen::ColPivHouseholderQR<Eigen::MatrixXcd>::_solve_impl(const Eigen::VectorXcd&,
                                                                               Eigen::VectorXcd&) const;
extern template void Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>::_solve_impl(
    const Eigen::MatrixXd&, Eigen::MatrixXd&) const;
extern template struct Eigen::internal::compute_inverse<Eigen::MatrixXd, Eigen::MatrixXd>;
extern template struct Eigen::internal::compute_inverse<Eigen::MatrixXcd, Eigen::MatrixXcd>;
