// Estimated error of the dense output on a step, divided by the accepted error.
#pragma once

#include "continuation/path/path_frame.hpp"
#include "continuation/step/step.hpp"

namespace eigentrail {

/// Accepted error of a step, as a share of the tolerance. The estimate rests on the first term that the dense
/// output leaves out and on the decrease of the last two terms; the rest of the tolerance is a margin for
/// terms that decrease less. With a larger value errors may exceed the tolerance, with a smaller one steps
/// are shorter than necessary.
constexpr double accepted_share = 0.5;

/// In the error estimate, two eigenvalues of a block count as at least this share of their size apart. Where
/// they coincide, the error of each is not bounded by the error of the block's functions, although these are
/// accurate. A larger value accepts larger errors of close eigenvalues, a smaller one takes very short steps
/// there.
constexpr double least_relative_gap = 0.1;

/// The t in [0, 1] at which the product of the eigenvalues of a block has its smallest magnitude, to 1e-5 of
/// the step. If one of them vanishes, this is the place: beside a zero of s, or of 1/s in the reciprocal
/// chart, errors relative to the eigenvalue may be much larger within the step than at its ends. `functions`
/// are the block's functions (modes/invariants.hpp) as polynomials in t, one row each, constant terms first.
/// A minimum is found if at least one of 9 equidistant samples lies in its basin.
double place_of_least_magnitude(const ComplexMatrix& functions);

/// Accepted error of p on a step where the coordinate is the distance across a plane.
double accepted_parameter_error(const PathFrame& frame, double tolerance);

/// Error of the place of a point on the path by rounding of the equilibrium, in the coordinate: rounding of
/// the forces K x does as much work along the path as the parameters on that distance. Zero where the
/// parameters act by constraints or conditions, or are stationary, where this tells nothing.
double rounding_along_path(const PathNode& node);

/// By how much eigenvalues change if the pencil changes by its rounding times one, 1/s.
double sensitivity_to_rounding(const Track& track);

/// Error of one track; infinite if it cannot be computed. `rounding`: that of eigenvalues, relative to their
/// condition and size, which is no error of the step.
double track_error(const PathProblem& problem, double tolerance, double rounding, const Step& step,
                   std::size_t track);

/// Whether a step is so short that the last terms of the series of a track at both its ends are far below the
/// accepted error: what is left of its error does not become less on a shorter step.
bool series_are_exact(const PathProblem& problem, double tolerance, const Step& step, std::size_t track);

/// Rounding of eigenvalues, relative to their condition and size, where a track of one or two modes shows it
/// on a step that is too inaccurate: its series are exact there, and the two ends still disagree, but by no
/// more than rounding can be. Zero elsewhere.
double observed_rounding(const PathProblem& problem, double tolerance, const Step& step, std::size_t track);

/// The rounding that is known of the modes of a track, and what becomes known of them. Modes keep it when
/// they are followed together with others.
double known_rounding(const PathFrame& frame, const Track& track);
void note_rounding(const Track& track, double seen, PathFrame& frame);

/// The largest error of all tracks, and of p where the coordinate is the distance across a plane. The verdict
/// is `accepted` up to an error of one, else `inaccurate`. Rounding that the frame knows is none; nor is, on
/// an accepted step, what is left where series are exact. A short part of an accurate step is accurate.
Verdict judge_error(const PathProblem& problem, const PathFrame& frame, double tolerance, const Step& step);

}  // namespace eigentrail
