// Conditions on the pencil at a special point of a case, by its kind, in extended precision.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hard_cases/catalogue.hpp"

namespace eigentrail::test {

/// P(s) with rows and columns scaled by the magnitude of its diagonal (of its row where that is zero), so
/// that soft coordinates count beside stiff ones, and what a double eigenvalue does to it.
struct Singularity {
  std::vector<double> values;  ///< singular values, ascending, relative to the terms of P
  double slope = 0.0;          ///< |y^H P_s z| with the null vectors, relative to the terms of P_s

  /// `scale` takes the place of |s| in magnitudes where s is zero.
  Singularity(const WidePencil& pencil, WideComplex s, double scale);
};

/// Largest |s| where the case begins.
inline double largest_at_start(const HardCase& hard_case) {
  double largest = 0.0;
  const Spectra spectra = hard_case.spectrum(hard_case.from);
  for (const Complex s : spectra[0]) largest = std::max(largest, std::abs(s));
  return largest;
}

/// Number of eigenvalues with Re s > 0.
inline int unstable(const HardCase& hard_case, double p, int branch) {
  const auto spectra = hard_case.spectrum(p);
  const auto& spectrum = spectra[static_cast<std::size_t>(branch)];
  return static_cast<int>(
      std::count_if(spectrum.begin(), spectrum.end(), [](Complex s) { return s.real() > 0.0; }));
}

inline int branches_at(const HardCase& hard_case, double p) {
  const auto spectra = hard_case.spectrum(p);
  return static_cast<int>(
      std::count_if(spectra.begin(), spectra.end(), [](const auto& s) { return !s.empty(); }));
}

/// What a special point must be, by kind, with parameters that are rounded to double precision.
class SpecialPointCheck {
 public:
  explicit SpecialPointCheck(const HardCase& hard_case)
      : case_(hard_case), scale_(largest_at_start(hard_case)) {}

  void check(const SpecialPoint& point) const {
    const double nearby = 1e-6 * std::abs(case_.to - case_.from);
    const double before = point.parameter - nearby;
    const double after = point.parameter + nearby;
    const Singularity at(case_.pencil(point.parameter, point.branch), point.s, scale_);
    const double rounded = rounding_of_parameter(point);
    const double allowed = 1e-14 + rounded;
    if (point.kind != "veering") {
      EXPECT_LT(rounded, 1e-6) << "the parameter means nothing in double precision";
    }
    if (point.kind == "flutter" || point.kind == "divergence") {
      EXPECT_EQ(point.s.real(), 0.0);
      if (point.kind == "divergence") {
        EXPECT_EQ(point.s.imag(), 0.0);
      }
      EXPECT_LT(at.values[0], allowed);
      EXPECT_NE(unstable(case_, before, point.branch), unstable(case_, after, point.branch));
    } else if (point.kind == "collision") {
      EXPECT_LT(at.values[0], allowed);
      EXPECT_LT(at.slope, 1e-13 + rounded);
    } else if (point.kind == "crossing") {
      ASSERT_GE(at.values.size(), 2U);
      EXPECT_LT(at.values[1], allowed);
    } else if (point.kind == "veering") {
      check_veering(point);
    } else if (point.kind == "fold") {
      EXPECT_LT(at.values[0], 1e-6);  // half the digits are lost at a fold
      EXPECT_EQ(std::abs(branches_at(case_, before) - branches_at(case_, after)), 2);
    } else if (point.kind == "branch_point") {
      EXPECT_LT(at.values[0], allowed);
      EXPECT_EQ(point.s, 0.0);
    } else {
      ASSERT_EQ(point.kind, "infinite");
      const WideComplexMatrix M = case_.pencil(point.parameter, point.branch).M;
      EXPECT_EQ(std::abs(M.determinant()), 0);
    }
  }

 private:
  /// How much the smallest singular value moves when the parameter moves by two units in its last place.
  double rounding_of_parameter(const SpecialPoint& point) const {
    const Wide ulp = 2.0 * std::numeric_limits<double>::epsilon() * std::abs(point.parameter);
    const double here = Singularity(case_.pencil(point.parameter, point.branch), point.s, scale_).values[0];
    double largest = 0.0;
    for (const Wide shift : {-ulp, ulp}) {
      const Singularity shifted(case_.pencil(point.parameter + shift, point.branch), point.s, scale_);
      largest = std::max(largest, std::abs(shifted.values[0] - here));
    }
    return largest;
  }

  void check_veering(const SpecialPoint& point) const {
    EXPECT_GT(point.half_width, 0.0);
    EXPECT_LE(point.half_width, case_.reach * std::abs(case_.to - case_.from) * (1.0 + 1e-9));
    // Which half of the complex plane the eigenvalue with Im s >= 0 meets another in is not listed.
    const double sign = defect(point, 1.0, 0, 0) < defect(point, -1.0, 0, 0) ? 1.0 : -1.0;
    const double here = defect(point, sign, 0, 0);
    if (here < 1e-14) return;
    // Where the distance is narrow the shapes turn fast, and rounded numbers lie beside the point.
    constexpr double ulp = 2.0 * std::numeric_limits<double>::epsilon();
    double rounded = 0.0;
    for (const WideComplex direction : {WideComplex(ulp), WideComplex(0, ulp)}) {
      for (const double side : {-1.0, 1.0}) {
        const WideComplex shift = WideComplex(side) * direction;
        const double of_s = std::abs(defect(point, sign, 0, std::abs(WideComplex(point.s)) * shift) - here);
        const double of_p = std::abs(defect(point, sign, shift * Wide(point.parameter), 0) - here);
        rounded = std::max(rounded, of_s + of_p);
      }
    }
    EXPECT_LT(rounded, 1e-6) << "the numbers mean nothing in double precision";
    EXPECT_LT(here, 1e-14 + rounded);
  }

  /// Zero where s is a defective double eigenvalue at parameter +- j half-width; with shifts of both.
  double defect(const SpecialPoint& point, double sign, WideComplex of_p, WideComplex of_s) const {
    const WideComplex p(point.parameter, sign * point.half_width);
    const Singularity at(case_.pencil(p + of_p, point.branch), WideComplex(point.s) + of_s, scale_);
    return at.values[0] + 0.01 * at.slope;
  }

  const HardCase& case_;
  double scale_;
};

}  // namespace eigentrail::test
