// Flutter, divergence and real collisions of a family, found without following any eigenvalue.
//
// Each is a zero of a function of the whole spectrum that is analytic in p, also where eigenvalues meet:
//
//     divergence      det K
//     flutter         F = product of s_i + s_j over all i < j
//     real collision  D = product of (s_i - s_j)^2 over all i < j
//
// F also vanishes where two real eigenvalues are opposite; that is no event and left out. The sign of D is
// that of (-1)^(number of complex pairs). Each function is replaced by Chebyshev polynomials on intervals so
// short that they are exact to 1e-9 of their size. An interval is divided until at most one root of its
// polynomial, real or beside the axis, is near. So two events close to each other are told from a touching
// of zero, and both from none.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hard_cases/family.hpp"

namespace eigentrail::test {

struct ReferenceEvent {
  std::string kind;  ///< flutter, divergence, collision
  double p = 0.0;
  Complex s;          ///< about; of a pair the one with Im s > 0
  int direction = 0;  ///< 1: one more unstable above p, -1: one less, 0 for collisions
};

struct ReferenceEvents {
  std::vector<ReferenceEvent> events;  ///< by p
  /// Places where a function touches zero, or has two zeros too close to be told apart.
  std::vector<ReferenceEvent> touching;
  /// What did not come out right, in words; empty means the events are all there are.
  std::vector<std::string> doubts;
  int spectra = 0;  ///< computed
};

/// Matrices at one parameter.
struct RealPencil {
  Matrix M, C, K;
};
RealPencil real_pencil(const Family& family, double p);

ReferenceEvents reference_events(const Family& family, double from, double to);

}  // namespace eigentrail::test
