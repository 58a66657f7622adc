// Eigenvalue branches: the eigenvalues of a track on a step one by one, each followed continuously from the
// left end.
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/path_step.hpp"

namespace eigentrail {

/// An eigenvalue of a track, or several of them that coincide on the whole step.
struct EigenvalueBranch {
  std::size_t track = 0;     ///< index of the track
  std::vector<int> members;  ///< indices of the roots of the track, ascending
};

/// Eigenvalues of one track on a step at any t in [0, 1], in the order of its modes. Remembers those that it
/// has computed.
class EigenvalueSampler {
 public:
  /// `index`: of the track, the same at both ends. `length`: signed length of the step. Keeps a reference to
  /// the track.
  EigenvalueSampler(const PathNode& left, const PathNode& right, std::size_t index, double length);

  /// Smooth functions of the track on the step (modes/invariants.hpp).
  const HermiteInterpolant& functions() const { return functions_; }

  /// Distance within which the eigenvalues i and j cannot be distinguished at the left end.
  double resolution(Eigen::Index i, Eigen::Index j) const {
    return std::max(rounding_, std::min(resolutions_[i], resolutions_[j]));
  }

  /// The same at t, where more of them may coincide.
  double resolution_at(double t, Eigen::Index i, Eigen::Index j);

  /// Whether two eigenvalues differ on the whole step by no more than their errors by rounding, as those of
  /// rigid-body motions.
  bool are_hidden(Eigen::Index i, Eigen::Index j);

  /// Eigenvalues at t. The reference is valid until the next call.
  const ComplexVector& operator()(double t);

 private:
  /// Whether eigenvalues that are distinct at the left end are so in another set of them, too.
  bool are_distinct(const ComplexVector& roots) const;

  const Track& track_;  ///< at the left end
  HermiteInterpolant functions_;
  double rounding_ = 0.0;                  ///< distance within which any two coincide
  Vector resolutions_;                     ///< of the eigenvalues at the left end (root_resolutions)
  double start_ = 0.0;                     ///< t of the first ones, at the left end or beside it
  std::map<double, ComplexVector> known_;  ///< by t
  ComplexVector single_;                   ///< the root of a track that has one, at the last t
};

/// In steps: if a departure (Track::departure) is farther from the left end than this, the eigenvalues are
/// distinguished closer to it.
constexpr double farthest_departure = 0.1;

/// Eigenvalues of a track at the left end of a step of signed length h, in the order of its modes. If some
/// coincide there, those a small distance away, where they differ. `position` is set to that distance in
/// steps, else to zero.
ComplexVector departing_roots(const Track& track, double h, double& position);

/// The eigenvalue branches of a track on a step. `index`: of the track. Eigenvalues that coincide at all of
/// several samples form one eigenvalue branch.
std::vector<EigenvalueBranch> eigenvalue_branches_of(const Track& track, std::size_t index,
                                                     EigenvalueSampler& sampler);

}  // namespace eigentrail
