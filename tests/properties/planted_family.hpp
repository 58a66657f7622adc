// Families of matrices with planted special points.
//
// Small blocks (s^2 + 2 c(p) s) I + K(p) of one to three freedoms, K polynomial, have eigenvalues in closed
// form: s = -c +- sqrt(c^2 - mu), mu those of K. Put on a diagonal and mixed by matrices P and T,
//
//     M = P^T T,    C = P^T diag(2 c_b I) T,    K = P^T diag(K_b) T
//
// they look like any other pencil, and have the same eigenvalues. All coefficients are multiples of small
// powers of two, chosen so that the products are exact in double precision: what the engine reads is the
// family whose special points are known, not a rounded one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hard_cases/family.hpp"
#include "hard_cases/trace_checks.hpp"
#include "properties/polynomial.hpp"

namespace eigentrail::test {

struct PlantedBlock {
  std::string kind;                   ///< what it was planted for
  Eigen::Index size = 1;              ///< 1 to 3
  Polynomial damping;                 ///< c
  std::vector<Polynomial> stiffness;  ///< K, row-major; symmetric where size is 3

  /// Where two eigenvalues of K meet and are defective: mu there. One of each pair of complex conjugates,
  /// with Im p >= 0; blocks of one freedom have none.
  struct Exceptional {
    WideComplex p, mu;
  };
  std::vector<Exceptional> exceptional;

  const Polynomial& K(Eigen::Index row, Eigen::Index column) const {
    return stiffness[static_cast<std::size_t>(row * size + column)];
  }
  /// Eigenvalues of K at a real parameter; where they are real the order is that of the continuation.
  std::vector<WideComplex> mu(Wide p) const;
  /// One of each complex pair and every real eigenvalue, in the order of the continuation along real p where
  /// nothing of this block meets.
  std::vector<WideComplex> modes(Wide p) const;
  /// c^2 - mu for one freedom: its sign tells real eigenvalues from a pair.
  Polynomial overdamping() const;
};

struct PlantedFamily {
  std::uint64_t seed = 0;
  double from = 0.0, to = 0.0;
  std::vector<PlantedBlock> blocks;
  std::vector<SpecialPoint> special;      ///< all of the range, ascending
  std::vector<std::vector<int>> meeting;  ///< blocks whose modes take part in it, per special point
  std::vector<std::vector<Wide>> breaks;  ///< per block: where its labels end
  std::string mixing;                     ///< how it was mixed, in words
  Family matrices;                        ///< what the engine sees

  Eigen::Index size() const { return matrices.M[0].rows(); }
  /// Exact spectrum.
  std::vector<Complex> spectrum(Wide p) const;
  /// Exact labels: the family is the block.
  std::vector<LabelledMode> labelled(double p) const;
  /// As a case of the catalogue.
  HardCase as_case() const;
  std::string description() const;
};

/// A family that cannot serve: special points too close to each other or to the ends, not exact in double
/// precision.
struct UnusableFamily : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Every special point of the blocks between `from` and `to`, and where labels end. Throws UnusableFamily.
void find_special_points(PlantedFamily& family);

/// The blocks on a diagonal between P(p)^T and T(p), polynomials of matrices. Throws UnusableFamily where a
/// coefficient is not exact.
Family mixed(const std::vector<PlantedBlock>& blocks, const MatrixSeries& P, const MatrixSeries& T);

/// The family of a seed; always the same.
PlantedFamily planted_family(std::uint64_t seed);

}  // namespace eigentrail::test
