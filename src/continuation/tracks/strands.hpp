// The eigenvalues of a step one by one, each followed from its left end.
#pragma once

#include <map>
#include <vector>

#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/path_step.hpp"

namespace eigentrail {

/// An eigenvalue of a track, or several that coincide on the whole step.
struct Strand {
  std::size_t track = 0;
  std::vector<int> members;  ///< indices of the roots of the track, ascending
};

/// Roots of one track on a step at any t in [0, 1], in the order of its modes.
class StrandSampler {
 public:
  /// `index` is the track's, the same at both ends.
  StrandSampler(const PathNode& left, const PathNode& right, std::size_t index, double length);

  /// Smooth functions of the track on the step.
  const HermiteInterpolant& functions() const { return functions_; }

  /// Roots that stay closer than this are one.
  double resolution() const { return resolution_; }

  /// Valid until the next call.
  const ComplexVector& operator()(double t);

 private:
  HermiteInterpolant functions_;
  double resolution_ = 0.0;
  std::map<double, ComplexVector> known_;  ///< by t
  ComplexVector single_;                   ///< the root of a track that has one, at the last t
};

/// A departure farther than this share of a step is looked at again nearer by.
constexpr double farthest_departure = 0.1;

/// Where the eigenvalues of a track are told apart at the left end of a step of length h: at the end itself,
/// or a little behind it where some meet there. `position` is a share of the step.
ComplexVector departing_roots(const Track& track, double h, double& position);

/// The strands of a track on a step: eigenvalues that coincide throughout are one.
std::vector<Strand> strands_of(const Track& track, std::size_t index, StrandSampler& sampler);

}  // namespace eigentrail
