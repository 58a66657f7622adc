#include "core/precompiled.hpp"

template class Eigen::ComplexSchur<Eigen::MatrixXcd>;
template class Eigen::ComplexEigenSolver<Eigen::MatrixXcd>;
template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>;
template Eigen::ComplexSchur<Eigen::MatrixXcd>& Eigen::ComplexSchur<Eigen::MatrixXcd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXcd>&, bool);
template Eigen::ComplexEigenSolver<Eigen::MatrixXcd>& Eigen::ComplexEigenSolver<Eigen::MatrixXcd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXcd>&, bool);
template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>::compute(const Eigen::EigenBase<Eigen::MatrixXcd>&, int);
