#include "eigentrail/modes/participation.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/modes/motion_names.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {
namespace {

/// Coordinates are named down to this share of the participation, and at most so many.
constexpr double least_share = 0.15;
constexpr std::size_t most_named = 3;

Vector squared_shares(const ComplexVector& shape) {
  return shape.cwiseAbs2() / shape.squaredNorm();
}

}  // namespace

Vector participation(const ComplexVector& left, const ComplexVector& slope, const ComplexVector& right,
                     bool is_simple) {
  const Vector product = left.cwiseProduct(slope).cwiseAbs();
  const double sum = product.sum();
  if (is_simple && sum > 0.0 && std::isfinite(sum)) return product / sum;
  return squared_shares(right);
}

std::string largest_names(const Vector& shares, const ComplexVector& shape,
                          const std::vector<std::string>& names) {
  std::string text;
  std::size_t named = 0;
  for (const MotionShare& one : motion_shares(names, shares, shape)) {
    if (named == most_named || (named > 0 && one.share < least_share)) break;
    text +=
        (named++ > 0 ? ", " : "") + one.name + " " + std::to_string(std::lround(100.0 * one.share)) + " %";
  }
  return text;
}

std::string largest_names(const ComplexVector& shape, const std::vector<std::string>& names) {
  return largest_names(squared_shares(shape), shape, names);
}

std::string name_by_participation(const Matrix& M, const Matrix& C, const Matrix& K, Complex s,
                                  const ComplexVector& right, double s_ref,
                                  const std::vector<std::string>& names) {
  const ComplexVector left = eigenvector_near(M.transpose(), C.transpose(), K.transpose(), s, s_ref);
  const ComplexVector slope = 2.0 * s * (M * right) + C * right;
  const Vector shares = participation(left, slope, right, true);
  return shares.allFinite() ? largest_names(shares, right, names) : "";
}

bool has_own_names(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != "x" + std::to_string(i + 1)) return true;
  }
  return false;
}

}  // namespace eigentrail
