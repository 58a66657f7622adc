// Eigenvalues on an equidistant grid of the parameter, by the methods with which a trace is compared.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/accuracy/study.hpp"

namespace eigentrail {

struct GridLoci {
  bool completed = false;
  std::string message;           ///< reason if not completed
  std::vector<double> p;         ///< equidistant
  std::vector<ComplexVector> s;  ///< per point: eigenvalues of the followed modes, in the order of the modes
  bool both_members = false;     ///< whether both members of complex pairs are modes of their own
  RunCounts counts;
};

// `modes`: number of modes to follow, those of least |s| at the first point, as in a trace; absent: all.

/// Computes the spectrum by QZ at every point. Modes are matched with those of the last point by modal
/// assurance and optimal assignment. Cost per point: one spectrum and one O(n^3) assignment.
GridLoci qz_grid(const PathProblem& problem, const std::vector<double>& p, const ModeChoice& modes);

/// Corrects each mode separately from point to point, from the prediction of `method` (zero_order, secant or
/// tangent). Ends at the first point where the corrector does not converge.
GridLoci corrected_grid(const PathProblem& problem, const std::vector<double>& p, const ModeChoice& modes,
                        Method method);

}  // namespace eigentrail
