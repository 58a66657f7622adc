// The companion form of a pencil, of which coordinates without mass are of first order.
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// The coordinates with mass: columns of M that are not zero.
template <class Values>
std::vector<Eigen::Index> coordinates_with_mass(const Values& M) {
  std::vector<Eigen::Index> with_mass;
  for (Eigen::Index j = 0; j < M.cols(); ++j) {
    if (!M.col(j).isZero(0.0)) with_mass.push_back(j);
  }
  return with_mass;
}

/// a y = mu b y with y = [z; mu z_m], z_m the coordinates with mass: first their velocities, then the n
/// equations. Those without have no velocity as a state: s C z stands on the right side for them.
template <class Values>
struct CompanionForm {
  Values a, b;

  CompanionForm(const Values& M, const Values& C, const Values& K)
      : CompanionForm(M, C, K, coordinates_with_mass(M)) {}

  CompanionForm(const Values& M, const Values& C, const Values& K,
                const std::vector<Eigen::Index>& with_mass) {
    const Eigen::Index n = M.rows();
    const auto m = static_cast<Eigen::Index>(with_mass.size());
    a = Values::Zero(m + n, n + m);
    b = a;
    a.topRightCorner(m, m).setIdentity();
    a.bottomLeftCorner(n, n) = -K;
    b.bottomLeftCorner(n, n) = C;
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index j = with_mass[static_cast<std::size_t>(i)];
      b(i, j) = 1.0;
      b.col(j).tail(n).setZero();
      a.col(n + i).tail(n) = -C.col(j);
      b.col(n + i).tail(n) = M.col(j);
    }
  }
};

}  // namespace eigentrail
