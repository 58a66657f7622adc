// One eigenpair (s, z) of the reduced pencil: refinement, sensitivities, quality figures.
//
//     P(s) z = (s^2 M + s C + K) z = 0,     c^H z = 1                    (seed paper, Eq. 32)
//
// The bordered matrix B = [[P, P_s z], [c^H, 0]] is factored once per mode and point, at the predicted pair.
// The same factors serve the Newton corrections, the left vector and every order of the sensitivities (Eq.
// 35), each brought to full accuracy by residual correction with the exact matrices.
#pragma once

#include <Eigen/LU>
#include <cstdint>
#include <optional>

#include "eigentrail/reduction/reduced_pencil.hpp"

namespace eigentrail {

struct CorrectorOptions {
  double tolerance = 1e-14;           ///< relative size of the last correction, > 0
  double refactor_contraction = 0.1;  ///< a slower contraction of the corrections factors anew, 0 < . < 1
  int max_iterations = 30;            ///< >= 1
};

/// Work done on modes, summed over a run.
struct ModeCounts {
  std::uint64_t factorizations = 0;  ///< complex LU of size n + 1
  std::uint64_t iterations = 0;      ///< Newton corrections
  std::uint64_t solves = 0;          ///< back-substitutions, all purposes
};

enum class ModeStatus { converged, not_converged, singular };

/// P at one point, prepared for corrections of several modes.
struct PencilAtPoint {
  const Matrix& M;
  const Matrix& C;
  const Matrix& K;
  double norm_M, norm_C, norm_K;  ///< Frobenius

  explicit PencilAtPoint(const ReducedPencil& pencil);
  explicit PencilAtPoint(ReducedPencil&&) = delete;  ///< the matrices are referred to, not copied

  ComplexMatrix matrix(Complex s) const;                         ///< P(s)
  ComplexVector times(Complex s, const ComplexVector& z) const;  ///< P(s) z
  ComplexVector slope(Complex s, const ComplexVector& z) const;  ///< P_s(s) z = (2 s M + C) z
  double magnitude(Complex s) const;  ///< |s|^2 |M| + |s| |C| + |K|, the scale of backward errors
};

/// LU factors of B at a pair (s, z), columns scaled to one magnitude.
class BorderedFactorization {
 public:
  BorderedFactorization(const PencilAtPoint& pencil, Complex s, const ComplexVector& z,
                        const ComplexVector& c);

  /// Solves B [dz; ds] = [r; 0].
  void solve(const ComplexVector& r, ComplexVector& dz, Complex& ds) const;
  /// Solves B^H [y; t] = [r; gamma] and returns y.
  ComplexVector solve_adjoint(const ComplexVector& r, Complex gamma) const;

 private:
  Eigen::PartialPivLU<ComplexMatrix> lu_;
  double slope_scale_, border_scale_;
};

/// An eigenpair at one point of the path.
struct Mode {
  ModeStatus status = ModeStatus::not_converged;
  Complex s;
  ComplexVector z;              ///< right vector, c^H z = 1
  ComplexVector y;              ///< left vector, y^H P = 0, unit length
  ComplexVector c;              ///< gauge
  double backward_error = 0.0;  ///< |P z| / (magnitude(s) |z|)  (Tisseur 2000, Eq. 2.2)
  double condition = 0.0;  ///< relative condition number of s (Tisseur 2000, Th. 5), w.r.t. max(|s|, s_ref)
  std::optional<BorderedFactorization> factors;
};

/// Refines (s, z) by chord-Newton with one LU, then takes s from the two-sided Rayleigh quotient. `s_ref` is
/// the magnitude below which an eigenvalue counts as zero in relative measures, > 0.
Mode correct_mode(const PencilAtPoint& pencil, Complex s, const ComplexVector& z, double s_ref,
                  const CorrectorOptions& options, ModeCounts& counts);

/// Power series of a mode along the path.
struct ModeSeries {
  ComplexVector s;        ///< order + 1 coefficients
  ComplexVectorSeries z;  ///< size x (order + 1), c^H z(h) = 1
};

/// Sensitivities of any order: coefficient k of P(s, h) z formed with s_k = z_k = 0 is the right side of Eq.
/// (35).
ModeSeries differentiate_mode(const ReducedPencil& pencil, const Mode& mode, int order, ModeCounts& counts);

}  // namespace eigentrail
