// An exceptional point at a complex value of the coordinate along the path, from the pencil there.
//
// The pencil P(s, h) is a power series in h, so that it is known at complex h as well. With two borders,
//
//   [P  B; C^H  0] [V; G] = [0; I]
//
// f(s, h) = det G vanishes at the eigenvalues (Govaerts, Numerical Methods for Bifurcations of Dynamical
// Equilibria, SIAM 2000, Chap. 3), and with its derivative f_s at double ones. Two borders, because modes
// that hardly influence each other make P nearly singular twice. Newton's method for both converges however
// close other exceptional points are; those that are known are divided out (Maehly).
//
// The series of eigenvalues tell where two of them nearly meet, but not well: the gap of a narrow veering has
// little slope at its roots, and beside other exceptional points the series are inaccurate, or show a meeting
// where there is none. This method tells.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "eigentrail/modes/invariant_pair.hpp"
#include "eigentrail/reduction/reduced_pencil.hpp"

namespace eigentrail {

/// Where two eigenvalues coalesce.
struct ExceptionalPoint {
  Complex h;   ///< distance from the point of the pencil
  Complex mu;  ///< the double eigenvalue in its chart
  /// ((mu_a - mu_b) / 2)^2 = slope (h - h*) + ...
  Complex slope;
  /// The next root of that function, by its curvature; accurate where it is close. Two exceptional points are
  /// close to each other where the two modes hardly influence each other; they are one place where the
  /// eigenvalues only coincide.
  Complex next;
  Complex mean_slope = 0.0;  ///< of (mu_a + mu_b) / 2 over h
};

/// Newton's method from (h, mu). `reach`: largest |h - start| of iterates. `known`: exceptional points of the
/// same two eigenvalues, which are not found again. Empty where it does not converge. Cost: one LU of size
/// n + 1 per iteration.
std::optional<ExceptionalPoint> find_exceptional_point(const ReducedPencil& pencil, Chart chart, Complex h,
                                                       Complex mu, double reach,
                                                       const std::vector<Complex>& known);

/// The mean of two eigenvalues at a complex place h, by following both there from a real place. Empty where
/// one of them cannot be followed. Cost: an LU per iteration, some tens in all.
std::optional<Complex> mean_at(const ReducedPencil& pencil, Chart chart, double from, Complex h,
                               std::array<Complex, 2> mu);

/// One of the eigenvalues that coalesce, at the real coordinate Re h*, with its right vector.
struct EigenvalueBelow {
  Complex mu;
  ComplexVector z;
};

/// The two eigenvalues that coalesce at an exceptional point, followed from there along a line of constant
/// real part down to the real axis. Empty where one of them cannot be followed.
std::optional<std::array<EigenvalueBelow, 2>> eigenvalues_below(const ReducedPencil& pencil, Chart chart,
                                                                const ExceptionalPoint& point);

/// A veering beside a point: its exceptional points are at offset +- i half_width, one for each of two
/// conjugate pairs of eigenvalues, or both for the same two.
struct VeeringPlace {
  double offset = 0.0;      ///< from the point, in the path's coordinate
  double half_width = 0.0;  ///< in the path's coordinate
};

/// The place to which Newton's method leads from `seen`: the mean of both exceptional points where the two
/// eigenvalues `mu` (at the point, in the chart) have both. Empty where neither is found within `allowed` of
/// what was seen. Cost: two to four times a few LUs of size n + 2.
std::optional<VeeringPlace> located_veering(const ReducedPencil& pencil, Chart chart, VeeringPlace seen,
                                            const std::array<Complex, 2>& mu, double allowed);

}  // namespace eigentrail
