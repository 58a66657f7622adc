// Locates a zero or an extremum of a criterion: Newton's method on the series of one mode, which is solved
// anew at every guess.
#pragma once

#include "continuation/events/event_search.hpp"
#include "continuation/step/step.hpp"
#include "continuation/tracks/strands.hpp"

namespace eigentrail {

/// An eigenvalue of a track.
struct Member {
  std::size_t track = 0, index = 0;
};

/// What is looked for.
struct CriterionTarget {
  enum class Sought {
    zero,
    extremum,
    touch  ///< an extremum near zero, in which two zeros may hide
  };
  Criterion criterion;
  bool pair = false;  ///< the eigenvalue is one of a complex pair
  Sought sought = Sought::zero;
};

/// The criteria of one eigenvalue of a track on a step, at any t in [0, 1].
class CriteriaOnStep {
 public:
  /// `excitation`: the excitation frequency on the step. Refers to the step and to it.
  CriteriaOnStep(const Step& step, std::size_t track, const HermiteInterpolant& excitation);

  /// Where the members are told apart first: zero, or a little behind a meeting at the left end.
  double begin() const { return begin_; }

  /// The eigenvalue in the track's chart, with t moved into the step.
  Complex member_near(std::size_t member, double t);
  /// The upper member of its pair.
  Complex root(std::size_t member, double t);
  double value(const Criterion& criterion, Complex root, double t) const;
  double value(const Criterion& criterion, std::size_t member, double t);

  /// What rounding leaves of a value: of eigenvalues that coincide at the left end it is half their digits.
  double noise() const;

 private:
  const Track& track_;
  StrandSampler roots_;
  const HermiteInterpolant& excitation_;
  double departing_ = 0.0;  ///< where the members are told apart, in steps; may lie before the step
  double begin_ = 0.0;
};

/// |Re s| / max(|s|, reference) that counts as zero for the eigenvalues of a track: what rounding leaves of
/// it by the condition of the track, at most `on_axis`.
double axis_width(const CriterionThresholds& thresholds, const Track& track);

/// The excitation frequency at a point as a series.
Vector excitation_at(const EventSearch& search, const PathNode& node);

/// Locates a target for a member near t. Appends the event, if there is one. False where no place was found,
/// though the dense output shows one.
bool locate(const EventSearch& search, const Step& step, CriteriaOnStep& on_step, const Member& member,
            const CriterionTarget& target, double t, FoundEvents& found);

}  // namespace eigentrail
