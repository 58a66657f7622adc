// Isotropic shafts: forward and backward whirl are a conjugate pair of complex parts, whose modes cross and
// never meet. Their eigenvalues are those of the complex matrices, of half the size.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "eigentrail/continuation/scene_parts.hpp"
#include "eigentrail/core/text.hpp"
#include "support/matrix_text.hpp"
#include "support/resumed.hpp"
#include "support/scenes.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::whirl_parts_test {
namespace {

using ComplexTerms = std::vector<ComplexMatrix>;

/// s^2 M + s C + K of size m in w = x + iy, every matrix a polynomial in p; conj(w) has the conjugate
/// equations.
struct Shaft {
  ComplexTerms M, C, K;

  Eigen::Index size() const { return M[0].rows(); }
};

ComplexMatrix value(const ComplexTerms& terms, double p) {
  ComplexMatrix sum = terms.back();
  for (std::size_t i = terms.size() - 1; i-- > 0;) sum = p * sum + terms[i];
  return sum;
}

/// All 2 m eigenvalues of the complex equations, on both sides of the real axis.
std::vector<Complex> complex_eigenvalues(const Shaft& shaft, double p) {
  const Eigen::Index m = shaft.size();
  const Eigen::PartialPivLU<ComplexMatrix> M(value(shaft.M, p));
  ComplexMatrix A = ComplexMatrix::Zero(2 * m, 2 * m);
  A.topRightCorner(m, m).setIdentity();
  A.bottomLeftCorner(m, m) = -M.solve(value(shaft.K, p));
  A.bottomRightCorner(m, m) = -M.solve(value(shaft.C, p));
  const Eigen::ComplexEigenSolver<ComplexMatrix> eigen(A, false);
  return {eigen.eigenvalues().begin(), eigen.eigenvalues().end()};
}

/// Those of the real equations with Im s > 0: of the complex ones and of their conjugates.
std::vector<Complex> upper_eigenvalues(const Shaft& shaft, double p) {
  std::vector<Complex> all = complex_eigenvalues(shaft, p);
  for (Complex& s : all) s = {s.real(), std::abs(s.imag())};
  return all;
}

/// The real matrices in (x1, y1, x2, y2, ...): w = x + iy, so that a + ib is [a -b; b a].
std::vector<Matrix> real_matrices(const ComplexTerms& terms) {
  std::vector<Matrix> result;
  for (const ComplexMatrix& A : terms) {
    Matrix real(2 * A.rows(), 2 * A.cols());
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      for (Eigen::Index j = 0; j < A.cols(); ++j) {
        const double a = A(i, j).real(), b = A(i, j).imag();
        real.block<2, 2>(2 * i, 2 * j) << a, -b, b, a;
      }
    }
    result.push_back(std::move(real));
  }
  return result;
}

/// Equations in other coordinates: the same ones on both sides, or different ones.
enum class Coordinates { given, mixed, mixed_both_sides };

Setting setting_of(const Shaft& shaft, double from, double to, const std::string& tolerance,
                   Coordinates coordinates = Coordinates::given, double anisotropy = 0.0) {
  const Eigen::Index n = 2 * shaft.size();
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal(0.0, 0.2 / std::sqrt(static_cast<double>(n)));
  const auto random = [&] { return Matrix::NullaryExpr(n, n, [&] { return normal(engine); }).eval(); };
  Matrix right = Matrix::Identity(n, n), left = right;
  if (coordinates != Coordinates::given) left = right += random();
  if (coordinates == Coordinates::mixed_both_sides) left += random();
  const auto in_coordinates = [&](const ComplexTerms& terms) {
    std::vector<Matrix> all = real_matrices(terms);
    if (&terms == &shaft.K) all[0](0, 0) *= 1.0 + anisotropy;
    for (Matrix& A : all) A = (left.transpose() * A * right).eval();
    return text(all);
  };
  return make_setting("[trace]\nparameter = \"p\"\nfrom = " + exact_text(from) + "\nto = " + exact_text(to) +
                      "\ntolerance = " + tolerance + "\n[matrix_family]\nM = " + in_coordinates(shaft.M) +
                      "\nC = " + in_coordinates(shaft.C) + "\nK = " + in_coordinates(shaft.K) + "\n");
}

bool has_complex_parts(const Setting& setting) {
  const auto parts = parts_of_family(setting.problem(), setting.options);
  return parts != nullptr && std::any_of(parts->ranges.begin(), parts->ranges.end(),
                                         [](const auto& range) { return range.complex_sign != 0; });
}

/// Expects at all points, and by the dense output between them, the eigenvalues of the complex equations.
void expect_eigenvalues(const RecordedTrace& found, const Shaft& shaft, double from, double to,
                        double tolerance) {
  // Double eigenvalues at rest are known to the root of rounding by the reference.
  constexpr double of_reference = 1e-7;
  constexpr int places = 23;
  for (int i = 0; i <= places; ++i) {
    const double p = from + (to - from) * static_cast<double>(i) / places;
    const ComplexVector s = found.eigenvalues_at(p);
    EXPECT_LT(matched_distance({s.begin(), s.end()}, upper_eigenvalues(shaft, p)), tolerance + of_reference)
        << "p = " << p;
  }
  for (std::size_t i = 0; i < found.nodes.size(); ++i) {
    const ComplexVector s = found.eigenvalues_of_node(i);
    EXPECT_LT(matched_distance({s.begin(), s.end()}, upper_eigenvalues(shaft, found.nodes[i].p)),
              of_reference);
  }
}

/// A chain of equal masses on springs, w_j'' + (2 w_j - w_{j-1} - w_{j+1}), with the gyroscopic coupling g p:
/// its modes have k_j = 2 - 2 cos(j pi / (m + 1)), and s = i (+-sqrt(a^2 + k_j) + a) with a = g p / 2.
struct GyroscopicChain {
  Eigen::Index m;
  double g;

  double k(Eigen::Index j) const {
    return 2.0 - 2.0 * std::cos(static_cast<double>(j) * M_PI / static_cast<double>(m + 1));
  }
  Shaft shaft() const {
    const ComplexMatrix I = ComplexMatrix::Identity(m, m);
    ComplexMatrix K = 2.0 * I;
    for (Eigen::Index i = 0; i + 1 < m; ++i) K(i, i + 1) = K(i + 1, i) = -1.0;
    return {{I}, {0.0 * I, Complex(0.0, -g) * I}, {K}};
  }
  /// Where forward whirl of j and backward whirl of l > j have one frequency:
  /// 8 a^2 (k_l + k_j) = (k_l - k_j)^2. At rest both whirls of every j have.
  std::vector<double> crossings(double to) const {
    std::vector<double> places(static_cast<std::size_t>(m), 0.0);
    for (Eigen::Index l = 1; l <= m; ++l) {
      for (Eigen::Index j = 1; j < l; ++j) {
        const double p = (k(l) - k(j)) / (g * std::sqrt(2.0 * (k(l) + k(j))));
        if (p <= to) places.push_back(p);
      }
    }
    std::sort(places.begin(), places.end());
    return places;
  }
};

TEST(WhirlParts, GyroscopicChainHasTheEigenvaluesAndCrossingsOfTheClosedForm) {
  const GyroscopicChain chain{7, 0.6};
  for (const bool backward : {false, true}) {
    for (const Coordinates coordinates : {Coordinates::given, Coordinates::mixed}) {
      const double from = backward ? 1.0 : 0.0, to = backward ? 0.0 : 1.0;
      const Setting setting = setting_of(chain.shaft(), from, to, "1e-9", coordinates);
      EXPECT_TRUE(has_complex_parts(setting));
      const RecordedTrace found = completed_trace(setting);
      EXPECT_EQ(found.result.certified_steps, found.result.mode_steps);
      EXPECT_TRUE(found.result.notes.empty());
      const std::vector<double> places = places_of(found.result, EventKind::crossing);
      const std::vector<double> expected = chain.crossings(1.0);
      ASSERT_EQ(places.size(), expected.size());
      for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(places[i], expected[i], 1e-9);
      for (const double p : {0.0, 0.31, 0.77, 1.0}) {
        std::vector<Complex> closed_form;
        for (Eigen::Index j = 1; j <= chain.m; ++j) {
          const double a = 0.5 * chain.g * p, root = std::sqrt(a * a + chain.k(j));
          closed_form.insert(closed_form.end(), {Complex(0.0, root + a), Complex(0.0, root - a)});
        }
        const ComplexVector s = found.eigenvalues_at(p);
        EXPECT_LT(matched_distance({s.begin(), s.end()}, closed_form), 1e-9);
      }
      EXPECT_LE(found.nodes.size(), 12U);  // crossings need no points of their own
    }
  }
}

/// At rest both whirls coincide, and have their numbers by magnitude behind it.
TEST(WhirlParts, BackwardWhirlComesFirstAtRest) {
  const RecordedTrace found = record_trace(setting_of(GyroscopicChain{3, 0.1}.shaft(), 0.0, 1.0, "1e-6"));
  const ComplexVector s = found.eigenvalues_at(0.5);
  for (Eigen::Index i = 0; i + 1 < s.size(); ++i) EXPECT_LT(s[i].imag(), s[i + 1].imag());
}

/// A chain of unequal masses whose discs have unequal gyroscopic moments.
Shaft unequal_chain(Eigen::Index m, double damping, double circulatory) {
  const ComplexMatrix I = ComplexMatrix::Identity(m, m);
  ComplexMatrix K = 2.0 * I, G = 0.0 * I;
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto number = static_cast<double>(i);
    K(i, i) += 0.3 * number;
    G(i, i) = Complex(0.0, -0.2 - 0.05 * static_cast<double>((3 * i) % 7));
    if (i + 1 == m) break;
    K(i, i + 1) = K(i + 1, i) = -1.0;
    G(i, i + 1) = G(i + 1, i) = Complex(0.0, -0.04);
  }
  Shaft shaft{{I}, {damping * K, G}, {K}};
  if (circulatory > 0.0) shaft.K.push_back(Complex(0.0, -circulatory) * I);
  return shaft;
}

/// Number of pairs of a forward and a backward mode that have changed their order: forward whirl becomes
/// faster with p, and backward whirl slower.
std::size_t changes_of_order(const Shaft& shaft, double to) {
  const auto whirl = [&](double p, bool forward) {
    std::vector<double> frequencies;
    for (const Complex s : complex_eigenvalues(shaft, p)) {
      if ((s.imag() > 0.0) == forward) frequencies.push_back(std::abs(s.imag()));
    }
    std::sort(frequencies.begin(), frequencies.end());
    return frequencies;
  };
  const std::vector<double> forward = whirl(to, true), backward = whirl(to, false);
  std::size_t count = 0;
  for (std::size_t j = 0; j < forward.size(); ++j) {
    for (std::size_t l = j + 1; l < backward.size(); ++l) count += forward[j] > backward[l] ? 1 : 0;
  }
  return count;
}

TEST(WhirlParts, ManyCrossingsOfAnUndampedShaftAreCertified) {
  const Shaft shaft = unequal_chain(20, 0.0, 0.0);
  const std::size_t expected = 20 + changes_of_order(shaft, 1.0);
  EXPECT_GT(expected, 60U);
  for (const bool backward : {false, true}) {
    for (const std::string tolerance : {"1e-6", "1e-10"}) {
      const double from = backward ? 1.0 : 0.0;
      const RecordedTrace found = completed_trace(setting_of(shaft, from, 1.0 - from, tolerance));
      EXPECT_EQ(found.result.certified_steps, found.result.mode_steps);
      EXPECT_TRUE(found.result.notes.empty());
      EXPECT_EQ(places_of(found.result, EventKind::crossing).size(), expected);
      expect_eigenvalues(found, shaft, from, 1.0 - from, std::stod(tolerance));
    }
  }
}

TEST(WhirlParts, DampedAndCirculatoryShaftsInAnyCoordinates) {
  for (const double circulatory : {0.0, 0.3}) {
    for (const Coordinates coordinates :
         {Coordinates::given, Coordinates::mixed, Coordinates::mixed_both_sides}) {
      const Shaft shaft = unequal_chain(6, 0.02, circulatory);
      const Setting setting = setting_of(shaft, 0.0, 1.0, "1e-8", coordinates);
      EXPECT_TRUE(has_complex_parts(setting));
      const RecordedTrace found = completed_trace(setting);
      EXPECT_EQ(found.result.certified_steps, found.result.mode_steps);
      EXPECT_TRUE(found.result.notes.empty());
      expect_eigenvalues(found, shaft, 0.0, 1.0, 1e-8);
      // Cross-coupling makes forward whirl unstable, one mode after the other.
      std::size_t growing = 0;
      for (const Complex s : complex_eigenvalues(shaft, 1.0)) growing += s.real() > 0.0 ? 1 : 0;
      EXPECT_EQ(places_of(found.result, EventKind::flutter).size(), growing);
      EXPECT_EQ(growing > 0, circulatory > 0.0);
    }
  }
}

/// Internal damping alone: both whirls have one frequency to first order, and other growth rates, s(p) in one
/// half is the conjugate mirror of s(-p) in the other. They cross at rest.
TEST(WhirlParts, WhirlsThatOnlyCirculatoryForcesTellApartCrossAtRest) {
  Shaft shaft = unequal_chain(4, 0.0, 0.0);
  shaft.C = {0.03 * ComplexMatrix::Identity(4, 4)};
  ComplexMatrix internal = ComplexMatrix::Zero(4, 4);
  for (Eigen::Index i = 0; i < 4; ++i) internal(i, i) = Complex(0.0, -0.02 - 0.01 * static_cast<double>(i));
  shaft.K.push_back(internal);
  for (const bool backward : {false, true}) {
    const double from = backward ? 6.0 : 0.0;
    const Setting setting = setting_of(shaft, from, 6.0 - from, "1e-7");
    EXPECT_TRUE(has_complex_parts(setting));
    const RecordedTrace found = completed_trace(setting);
    EXPECT_EQ(found.result.certified_steps, found.result.mode_steps);
    const std::vector<double> crossings = places_of(found.result, EventKind::crossing);
    EXPECT_EQ(crossings.size(), 4U);
    for (const double p : crossings) EXPECT_NEAR(p, 0.0, 1e-9);
    EXPECT_EQ(places_of(found.result, EventKind::flutter).size(), 4U);
    expect_eigenvalues(found, shaft, from, 6.0 - from, 1e-7);
  }
}

/// Stiffnesses of the two directions that differ by 1e-9 couple both whirls: their modes veer, and the
/// equations are one real part.
TEST(WhirlParts, SlightlyAnisotropicShaftIsOneRealPart) {
  const Shaft shaft = unequal_chain(4, 0.0, 0.0);
  for (const double anisotropy : {1e-9, 1e-11}) {
    for (const Coordinates coordinates : {Coordinates::given, Coordinates::mixed}) {
      const Setting setting = setting_of(shaft, 0.0, 1.0, "1e-6", coordinates, anisotropy);
      EXPECT_FALSE(has_complex_parts(setting)) << anisotropy;
      const RecordedTrace found = completed_trace(setting);
      expect_eigenvalues(found, shaft, 0.0, 1.0, 1e-6);
    }
  }
}

/// What the gyroscopic moments of the discs take off from the masses in a frame that turns with the shaft:
/// unequal, so that all modes are one pair of parts.
ComplexMatrix moments_of_discs(Eigen::Index m) {
  return Vector(0.4 * Vector::LinSpaced(m, 1.0, static_cast<double>(m)).cwiseInverse())
      .cast<Complex>()
      .asDiagonal();
}

/// A shaft in the frame that turns with it with the speed o(p), a polynomial: u'' - i (G - 2) o u' + D u' +
/// (K - o^2 (1 - G)) u = 0, with the damping D = damping K of the shaft.
Shaft in_turning_frame(Eigen::Index m, const std::vector<double>& speed, double damping) {
  const ComplexMatrix I = ComplexMatrix::Identity(m, m), G = moments_of_discs(m);
  Shaft shaft = GyroscopicChain{m, 0.0}.shaft();
  shaft.C = {damping * shaft.K[0]};
  shaft.C.resize(std::max<std::size_t>(speed.size(), 1), 0.0 * I);
  shaft.K.resize(2 * speed.size() - 1, 0.0 * I);
  for (std::size_t i = 0; i < speed.size(); ++i) {
    shaft.C[i] += Complex(0.0, speed[i]) * (2.0 * I - G);
    for (std::size_t j = 0; j < speed.size(); ++j) shaft.K[i + j] -= speed[i] * speed[j] * (I - G);
  }
  return shaft;
}

/// The speed at which a mode rests in the turning frame: det(K - o^2 (1 - G)) = 0.
double critical_speed(Eigen::Index m) {
  const Matrix I = Matrix::Identity(m, m);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(GyroscopicChain{m, 0.0}.shaft().K[0].real(),
                                                               I - moments_of_discs(m).real());
  return std::sqrt(eigen.eigenvalues()[0]);
}

/// Where the frame turns with a natural frequency, its backward mode rests, and its eigenvalue passes through
/// zero: it goes over to the other whirl. No mode is lost there.
TEST(WhirlParts, ModeThatRestsInATurningFrameGoesOn) {
  for (const double damping : {0.0, 0.02}) {
    for (const bool backward : {false, true}) {
      const Shaft shaft = in_turning_frame(3, {0.1, 1.5}, damping);
      const double from = backward ? 0.9 : 0.0, to = 0.9 - from;
      const Setting setting = setting_of(shaft, from, to, "1e-7");
      EXPECT_FALSE(has_complex_parts(setting));
      const RecordedTrace found = completed_trace(setting);
      for (const double p : {0.05, 0.37, 0.71, 0.85}) {
        const ComplexVector s = found.eigenvalues_at(p);
        EXPECT_LT(matched_distance({s.begin(), s.end()}, upper_eigenvalues(shaft, p)), 1e-6) << p;
      }
    }
  }
}

/// The speed exceeds the critical one o_c only on a stretch between the places that are looked at before the
/// trace: o = o_c + e (1 - ((p - 0.3) / 0.01)^2). There the parts become one real part.
Shaft resting_on_a_stretch(double damping) {
  constexpr double excess = 0.002, width = 0.01, middle = 0.3;
  const double c = excess / (width * width);
  return in_turning_frame(3, {critical_speed(3) + excess - c * middle * middle, 2.0 * c * middle, -c},
                          damping);
}

TEST(WhirlParts, ModeThatRestsBetweenThePlacesIsNotLost) {
  for (const double damping : {0.0, 0.01}) {
    for (const bool backward : {false, true}) {
      const Shaft shaft = resting_on_a_stretch(damping);
      const double from = backward ? 0.4 : 0.2, to = backward ? 0.2 : 0.4;
      const Setting setting = setting_of(shaft, from, to, "1e-7");
      EXPECT_TRUE(has_complex_parts(setting));
      const RecordedTrace found = completed_trace(setting);
      for (const double p : {0.21, 0.26, 0.295, 0.303, 0.34, 0.39}) {
        const ComplexVector s = found.eigenvalues_at(p);
        EXPECT_LT(matched_distance({s.begin(), s.end()}, upper_eigenvalues(shaft, p)), 1e-5) << p;
      }
    }
  }
}

/// Damping becomes critical on the way, and both whirls become real at a coalescence or come close to it.
TEST(WhirlParts, ShaftThatBecomesOverdampedIsNotLost) {
  Shaft shaft = unequal_chain(3, 0.0, 0.0);
  shaft.C[1] = 0.1 * shaft.C[1] + 2.0 * ComplexMatrix::Identity(3, 3);
  const RecordedTrace found = completed_trace(setting_of(shaft, 0.0, 3.0, "1e-7"));
  expect_eigenvalues(found, shaft, 0.0, 3.0, 1e-6);
}

/// Two shafts of one kind, the second turning the other way: copies, of which one is traced.
TEST(WhirlParts, EqualShaftsAreTracedOnceEach) {
  const Shaft one = unequal_chain(3, 0.01, 0.0);
  Shaft two;
  const auto add = [](const ComplexTerms& terms, ComplexTerms& all) {
    for (const ComplexMatrix& A : terms) {
      ComplexMatrix both = ComplexMatrix::Zero(6, 6);
      both.topLeftCorner(3, 3) = A;
      both.bottomRightCorner(3, 3) = A.conjugate();
      all.push_back(std::move(both));
    }
  };
  add(one.M, two.M);
  add(one.C, two.C);
  add(one.K, two.K);
  for (const Coordinates coordinates : {Coordinates::given, Coordinates::mixed}) {
    const RecordedTrace found = completed_trace(setting_of(two, 0.0, 1.0, "1e-8", coordinates));
    EXPECT_EQ(found.result.certified_steps, found.result.mode_steps);
    EXPECT_EQ(found.nodes.front().tracks.size(), 6U);  // of the 12 modes
    expect_eigenvalues(found, two, 0.0, 1.0, 1e-8);
  }
}

TEST(WhirlParts, ResumedTraceIsTheSame) {
  const auto difference = [](const Setting& setting) {
    return first_resumed_difference(*setting.model, setting.options, 20);
  };
  EXPECT_EQ(difference(setting_of(unequal_chain(4, 0.02, 0.3), 0.0, 1.0, "1e-8")), "");
  EXPECT_EQ(difference(setting_of(resting_on_a_stretch(0.0), 0.2, 0.4, "1e-7")), "");
  EXPECT_EQ(difference(setting_of(resting_on_a_stretch(0.01), 0.4, 0.2, "1e-7")), "");
}

}  // namespace
}  // namespace eigentrail::test::whirl_parts_test
