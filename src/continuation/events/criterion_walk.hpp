// Locates a zero or an extremum of a criterion by Newton's method on the power series of one mode. The point
// of the path and the mode are computed anew at every iterate.
#pragma once

#include <cmath>

#include "continuation/events/event_search.hpp"
#include "continuation/step/step.hpp"
#include "continuation/tracks/eigenvalue_branches.hpp"

namespace eigentrail {

/// What is to be located.
struct CriterionTarget {
  enum class Sought {
    zero,
    extremum,
    touch  ///< an extremum near zero; there may be two zeros beside it
  };
  Criterion criterion;
  bool pair = false;  ///< the eigenvalue is one of a complex pair
  Sought sought = Sought::zero;
  double behind =
      0.0;  ///< value behind the zero, by the samples; its sign is the direction where no slope is
};

/// Eigenvalues of one track and their criteria from the dense output of a step, at any t in [0, 1].
class CriteriaOnStep {
 public:
  /// `excitation`: the excitation frequency on the step. Keeps references to all.
  CriteriaOnStep(const Step& step, std::size_t track, const HermiteInterpolant& excitation,
                 const RoundingThresholds& thresholds);

  const Step& step() const { return step_; }
  std::size_t track_index() const { return index_; }
  /// At the left end.
  const Track& track() const { return step_.left->tracks[index_]; }

  /// Smallest t at which the eigenvalues can be distinguished: zero, or a little more where some of them
  /// coincide at the left end.
  double begin() const { return begin_; }

  /// The eigenvalue in the track's chart; t beyond the step is replaced by its nearest end.
  Complex member_near(std::size_t member, double t);
  /// The same for t in [0, 1], but of a complex pair the member with Im s > 0.
  Complex root(std::size_t member, double t);
  /// The criterion at t, of an eigenvalue as `root` returns it, or of a member.
  double value(const Criterion& criterion, Complex root, double t) const;
  double value(const Criterion& criterion, std::size_t member, double t);

  /// Error of an eigenvalue at t by rounding: near a meeting it is known to a root of rounding only.
  double rounding(std::size_t member, double t);

 private:
  const Step& step_;
  std::size_t index_;
  const RoundingThresholds& thresholds_;
  EigenvalueSampler roots_;
  const HermiteInterpolant& excitation_;
  double rounding_at_ = NAN;  ///< place of `roundings_`
  Vector roundings_;          ///< those of all members there
  double departing_ = 0.0;    ///< where the eigenvalues can be distinguished, in steps; may be negative
  double begin_ = 0.0;
};

/// The excitation frequency (rad/s) at a point, as a power series along the path.
Vector excitation_at(const EventSearch& search, const PathNode& node);

/// Locates a zero or extremum of an eigenvalue (index among the roots of the track) near t. Appends the event
/// to `found`, if there is one. Returns false if Newton's method fails, although the dense output shows a
/// zero or extremum.
bool locate(const EventSearch& search, CriteriaOnStep& on_step, std::size_t member,
            const CriterionTarget& target, double t, FoundEvents& found);

}  // namespace eigentrail
