#include "core/precompiled.hpp"

template class Eigen::HouseholderQR<Eigen::MatrixXd>;
template class Eigen::HouseholderQR<Eigen::MatrixXcd>;
template class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;
template class Eigen::ColPivHouseholderQR<Eigen::MatrixXcd>;
template class Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>;

template void Eigen::HouseholderQR<Eigen::MatrixXcd>::_solve_impl(const Eigen::MatrixXcd&,
                                                                  Eigen::MatrixXcd&) const;
template void Eigen::ColPivHouseholderQR<Eigen::MatrixXd>::_solve_impl(const Eigen::MatrixXd&,
                                                                       Eigen::MatrixXd&) const;
template void Eigen::ColPivHouseholderQR<Eigen::MatrixXcd>::_solve_impl(const Eigen::VectorXcd&,
                                                                        Eigen::VectorXcd&) const;
template void Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>::_solve_impl(const Eigen::MatrixXd&,
                                                                                   Eigen::MatrixXd&) const;
