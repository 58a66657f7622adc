#include "core/precompiled.hpp"

template class Eigen::HouseholderQR<Eigen::MatrixXd>;
template class Eigen::HouseholderQR<Eigen::MatrixXcd>;
template class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;
template class Eigen::ColPivHouseholderQR<Eigen::MatrixXcd>;
