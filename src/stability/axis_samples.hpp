// Samples of all modes on the path, by whose growth stretches are judged.
#pragma once

#include <vector>

#include "eigentrail/stability/axis_stretches.hpp"
#include "eigentrail/stability/permanent_modes.hpp"

namespace eigentrail {

/// How samples are judged: the accuracy of the dense output, and which modes are zero throughout, and left
/// out.
struct Judging {
  EigenvalueAccuracy accuracy;
  std::vector<Permanence> modes;
};

/// What errors of an eigenvalue are relative to, 1/s.
double scale_of(Complex s, const EigenvalueAccuracy& accuracy);

/// All modes at a place of the dense output or at a stored point.
AxisSample axis_sample(const RecordedPath& path, const PathPosition& at, const Judging& judging);

/// Samples the stretch: all stored points inside, several places of every step or part of a step, its ends
/// where they are not on the axis, and extrema of the margin between them.
void add_samples(const RecordedPath& path, const Judging& judging, AxisStretch& stretch);

}  // namespace eigentrail
