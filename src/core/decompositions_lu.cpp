#include "core/precompiled.hpp"

template class Eigen::PartialPivLU<Eigen::MatrixXd>;
template class Eigen::PartialPivLU<Eigen::MatrixXcd>;
template class Eigen::FullPivLU<Eigen::MatrixXd>;
template class Eigen::LLT<Eigen::MatrixXd>;

template Eigen::LLT<Eigen::MatrixXd>& Eigen::LLT<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&);
template double Eigen::internal::rcond_invmatrix_L1_norm_estimate(
    const Eigen::PartialPivLU<Eigen::MatrixXcd>&);
template double Eigen::internal::rcond_invmatrix_L1_norm_estimate(const Eigen::FullPivLU<Eigen::MatrixXd>&);
template void Eigen::PartialPivLU<Eigen::MatrixXd>::_solve_impl(const Eigen::MatrixXd&,
                                                                Eigen::MatrixXd&) const;
template void Eigen::PartialPivLU<Eigen::MatrixXcd>::_solve_impl(const Eigen::MatrixXcd&,
                                                                 Eigen::MatrixXcd&) const;
template void Eigen::FullPivLU<Eigen::MatrixXd>::_solve_impl(const Eigen::VectorXd&, Eigen::VectorXd&) const;
template struct Eigen::internal::compute_inverse<Eigen::MatrixXd, Eigen::MatrixXd>;
template struct Eigen::internal::compute_inverse<Eigen::MatrixXcd, Eigen::MatrixXcd>;
template double Eigen::internal::rcond_invmatrix_L1_norm_estimate(const Eigen::LLT<Eigen::MatrixXd>&);
template void Eigen::PartialPivLU<Eigen::MatrixXd>::_solve_impl(const Eigen::VectorXd&,
                                                                Eigen::VectorXd&) const;
