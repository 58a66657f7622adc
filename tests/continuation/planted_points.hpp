// Points of matrix families whose eigenvalues are known in closed form. The test chooses the blocks and
// charts in which the modes are followed.
#pragma once

#include <string>
#include <vector>

#include "support/matrix_text.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {

constexpr Complex j{0.0, 1.0};

/// Eigenvalues that are followed together, in the order that the track shall have them. They make a real
/// block when they are closed under conjugation. All are eigenvalues s, also of a block in the other chart.
struct Together {
  std::vector<Complex> s;
  Chart chart = Chart::finite;
};

/// A family of matrices, and the problem of following its modes along p.
class Planted {
 public:
  explicit Planted(const FamilyMatrices& matrices, int order = 4);

  /// Undamped, of unit mass: s = j w with w an eigenvalue of W(p), coefficients by powers of p. K = W^2.
  static Planted frequencies(const std::vector<Matrix>& W, int order = 4);

  /// The point at p with these tracks. Modes are numbered in the order of the roots; members of real blocks
  /// below the real axis are none. Throws std::runtime_error where one of them is no eigenvalue to 1e-6.
  /// `previous_basis` as in compute_point.
  PathNode point(double p, const std::vector<Together>& tracks, const Matrix& previous_basis = {});

  /// Equilibrium and reduction alone.
  PathPoint reduced(double p, const Matrix& previous_basis = {});

  const PathProblem& problem() const { return problem_; }
  const Model& model() const { return *setting_.model; }

  RunCounts counts;

 private:
  InvariantPair pair_of(const PathPoint& point, const Together& track);

  Setting setting_;  // owns the model that the problem refers to
  PathProblem problem_;
};

/// Every one as a track of its own.
std::vector<Together> alone(const std::vector<Complex>& s);

/// Largest distance of the coefficients of two series; missing ones are zero.
double distance(const ComplexVector& a, const ComplexVector& b);

/// Frequencies of uncoupled modes: row i of `coefficients` those of mode i by powers of p.
std::vector<Matrix> uncoupled(const Matrix& coefficients);

}  // namespace eigentrail::test
