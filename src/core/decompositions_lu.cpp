#include "core/precompiled.hpp"

template class Eigen::PartialPivLU<Eigen::MatrixXd>;
template class Eigen::PartialPivLU<Eigen::MatrixXcd>;
template class Eigen::FullPivLU<Eigen::MatrixXd>;
template class Eigen::LLT<Eigen::MatrixXd>;
