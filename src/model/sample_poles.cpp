#include "model/sample_poles.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/singular_vectors.hpp"

namespace eigentrail {
namespace {

/// Poles must be farther from the range than this share of the mean distance of the nodes: between two
/// samples none shows a narrower peak.
constexpr double nearest_pole = 0.1;
/// Fewest divided differences per pole. With as many as poles, the fit would have no error at all and say
/// nothing.
constexpr int windows_per_pole = 3;
/// Poles farther from the middle of the range than this many half ranges are none.
constexpr double farthest_pole = 20.0;

/// Factors of the nodes `first` ... `first` + order in their divided difference, of unit length.
Vector divided_difference(const std::vector<double>& nodes, std::size_t first, int order) {
  Vector factors(order + 1);
  for (int j = 0; j <= order; ++j) {
    factors[j] = 1.0;
    for (int l = 0; l <= order; ++l) {
      const auto at = [&](int i) { return nodes[first + static_cast<std::size_t>(i)]; };
      if (l != j) factors[j] /= at(j) - at(l);
    }
  }
  return factors.normalized();
}

/// Column j: the divided differences of x^j f for all windows of degree + 2 nodes.
Matrix differences_of_products(const std::vector<double>& x, const Matrix& samples, int degree, int n_poles) {
  const auto windows = static_cast<Eigen::Index>(x.size()) - degree - 1;
  Matrix result(samples.rows() * windows, n_poles + 1);
  const Eigen::Map<const Vector> powers_of(x.data(), static_cast<Eigen::Index>(x.size()));
  Vector power = Vector::Ones(powers_of.size());
  for (int j = 0; j <= n_poles; ++j) {
    for (Eigen::Index i = 0; i < windows; ++i) {
      const Vector factors = divided_difference(x, static_cast<std::size_t>(i), degree + 1);
      result.col(j).segment(i * samples.rows(), samples.rows()) =
          samples.middleCols(i, degree + 2) * power.segment(i, degree + 2).cwiseProduct(factors);
    }
    power = power.cwiseProduct(powers_of);
  }
  return result;
}

/// Column j: x^j at the nodes, times the norm of the sample there.
Matrix weighted_powers(const std::vector<double>& x, const Matrix& samples, int n_poles) {
  Matrix result(samples.cols(), n_poles + 1);
  for (Eigen::Index k = 0; k < samples.cols(); ++k) {
    for (int j = 0; j <= n_poles; ++j)
      result(k, j) = std::pow(x[static_cast<std::size_t>(k)], j) * samples.col(k).norm();
  }
  return result;
}

/// Coefficients q of the least |differences q| / |powers q|.
Vector least_quotient(const Matrix& differences, const Matrix& powers) {
  const Matrix scale = triangular_factor(powers);
  const Matrix quotient = scale.transpose()
                              .triangularView<Eigen::Lower>()
                              .solve(triangular_factor(differences).transpose())
                              .transpose();
  return scale.triangularView<Eigen::Upper>().solve(right_singular_vectors(quotient).V.rightCols(1));
}

/// Roots of q_0 + q_1 x + q_2 x^2.
std::vector<Complex> roots(const Vector& q) {
  if (q.size() == 2) return {-q[0] / q[1]};
  const Complex root = std::sqrt(Complex(q[1] * q[1] - 4.0 * q[0] * q[2]));
  if (root.imag() != 0.0) return {{-q[1] / (2.0 * q[2]), std::abs(root.imag() / (2.0 * q[2]))}};
  const double far = -0.5 * (q[1] + std::copysign(root.real(), q[1]));
  return {far / q[2], q[0] / far};
}

/// Distance from -1 <= x <= 1.
double distance_to_range(Complex x) {
  return std::hypot(std::max(0.0, std::abs(x.real()) - 1.0), x.imag());
}

}  // namespace

Matrix triangular_factor(const Matrix& matrix) {
  const Eigen::Index rows = std::min(matrix.rows(), matrix.cols());
  return Eigen::HouseholderQR<Matrix>(matrix).matrixQR().topRows(rows).triangularView<Eigen::Upper>();
}

int Denominator::degree() const {
  int count = 0;
  for (const Complex pole : poles) count += pole.imag() != 0.0 ? 2 : 1;
  return count;
}

double Denominator::operator()(double x) const {
  double product = 1.0;
  for (const Complex pole : poles) product *= pole.imag() != 0.0 ? std::norm(x - pole) : std::abs(x - pole);
  return product;
}

std::optional<Denominator> fitted_denominator(const std::vector<double>& nodes, const Matrix& samples,
                                              int degree, int n_poles) {
  const auto count = static_cast<Eigen::Index>(nodes.size());
  if (count - degree - 1 < windows_per_pole * n_poles) return std::nullopt;
  const double middle = 0.5 * (nodes.front() + nodes.back()), half = 0.5 * (nodes.back() - nodes.front());
  std::vector<double> x;
  for (const double node : nodes) x.push_back((node - middle) / half);
  const Vector q = least_quotient(differences_of_products(x, samples, degree, n_poles),
                                  weighted_powers(x, samples, n_poles));
  if (!q.allFinite() || q[n_poles] == 0.0) return std::nullopt;
  Denominator result;
  for (const Complex root : roots(q)) {
    const double distance = distance_to_range(root);
    const bool usable =
        distance > nearest_pole * 2.0 / static_cast<double>(count - 1) && std::abs(root) < farthest_pole;
    if (!usable) return std::nullopt;
    result.poles.push_back(middle + half * root);
  }
  return result;
}

}  // namespace eigentrail
