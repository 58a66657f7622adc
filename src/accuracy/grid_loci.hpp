// Eigenvalues on an equidistant grid of the parameter: what the rivals of a trace produce.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eigentrail/accuracy/study.hpp"

namespace eigentrail {

struct GridLoci {
  bool completed = false;
  std::string message;           ///< why not
  std::vector<double> p;         ///< equidistant
  std::vector<ComplexVector> s;  ///< per point, by label; followed modes only
  bool both_members = false;     ///< labels hold both members of complex pairs
  RunCounts counts;
};

// `modes` are followed, those of least |s| at the first point, as a trace does; absent: all.

/// QZ at every point; labels of all modes carried by modal assurance and optimal assignment. Cost per point
/// one spectrum and one O(n^3) assignment.
GridLoci qz_grid(const PathProblem& problem, const std::vector<double>& p, std::optional<int> modes);

/// Modes corrected from point to point, each by itself, predicted as `method` says (zero_order, secant,
/// tangent). Ends where the corrector does.
GridLoci corrected_grid(const PathProblem& problem, const std::vector<double>& p, std::optional<int> modes,
                        Method method);

}  // namespace eigentrail
