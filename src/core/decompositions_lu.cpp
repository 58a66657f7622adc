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
