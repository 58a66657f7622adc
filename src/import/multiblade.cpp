#include "import/multiblade.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace eigentrail {
namespace {

/// t of q = t a, N x N, and its first and second derivatives by psi.
struct Fourier {
  Matrix t, first, second;
};

Fourier fourier(std::size_t n_blades, double azimuth) {
  const auto n = static_cast<Eigen::Index>(n_blades);
  Fourier result{Matrix::Zero(n, n), Matrix::Zero(n, n), Matrix::Zero(n, n)};
  for (Eigen::Index blade = 0; blade < n; ++blade) {
    const double psi = azimuth + 2.0 * std::numbers::pi * static_cast<double>(blade) / static_cast<double>(n);
    result.t(blade, 0) = 1.0;
    for (Eigen::Index harmonic = 1; 2 * harmonic < n; ++harmonic) {
      const auto h = static_cast<double>(harmonic);
      const double cosine = std::cos(h * psi), sine = std::sin(h * psi);
      const Eigen::Index at = 2 * harmonic - 1;
      result.t.row(blade).segment(at, 2) << cosine, sine;
      result.first.row(blade).segment(at, 2) << -h * sine, h * cosine;
      result.second.row(blade).segment(at, 2) << -h * h * cosine, -h * h * sine;
    }
    if (n % 2 == 0) result.t(blade, n - 1) = blade % 2 == 0 ? 1.0 : -1.0;
  }
  return result;
}

}  // namespace

MultibladeTransformation multiblade(Eigen::Index n, const std::vector<BladeStates>& tuples, double azimuth,
                                    double rotor_speed) {
  MultibladeTransformation result{Matrix::Identity(n, n), Matrix::Zero(n, n)};
  for (const BladeStates& tuple : tuples) {
    const Fourier f = fourier(tuple.states.size(), azimuth);
    result.T(tuple.states, tuple.states) = f.t;
    result.derivative(tuple.states, tuple.states) = f.first;
    if (tuple.rates.empty()) continue;
    // q' = t a' + rotor_speed t' a
    result.T(tuple.rates, tuple.rates) = f.t;
    result.T(tuple.rates, tuple.states) = rotor_speed * f.first;
    result.derivative(tuple.rates, tuple.rates) = f.first;
    result.derivative(tuple.rates, tuple.states) = rotor_speed * f.second;
  }
  return result;
}

Matrix in_multiblade_coordinates(const Matrix& A, const MultibladeTransformation& transformation,
                                 double rotor_speed) {
  return transformation.T.partialPivLu().solve(
      Matrix(A * transformation.T - rotor_speed * transformation.derivative));
}

}  // namespace eigentrail
