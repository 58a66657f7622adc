// Estimated error of the dense output on a step, as a fraction of what is accepted.
#pragma once

#include "continuation/path/path_frame.hpp"
#include "continuation/step/step.hpp"

namespace eigentrail {

/// A step is accepted up to this share of the tolerance: the estimate is the first term that the dense output
/// leaves out, or the last it has; the terms after it, which fall at least by half, add about as much again.
constexpr double accepted_share = 0.5;

/// Within a block two eigenvalues count as no closer than this share of their size: where they meet, no error
/// bound of single eigenvalues holds, and the functions of the block are what is accurate.
constexpr double least_relative_gap = 0.1;

/// Of one track. Infinite where it is not finite.
double track_error(const PathProblem& problem, double tolerance, const Step& step, std::size_t track);

/// The worst of all tracks, and of the parameter where the coordinate is not the parameter itself: an
/// accepted verdict up to an error of one. A short part of an accurate step is accurate.
Verdict judge_error(const PathProblem& problem, const PathFrame& frame, double tolerance, const Step& step);

}  // namespace eigentrail
