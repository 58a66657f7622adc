// The derivatives of every element of the registry, from its record, against differences of its force in 113
// bits. The force is called with numbers there, so the recorder has no part in them.
#include <gtest/gtest.h>

#include <cmath>

#include "support/sample_element.hpp"

namespace eigentrail::test::element_derivatives_test {
namespace {

/// Coefficient k of f(h) about 0 by a central difference of second order with step h.
template <class Function>
ExtendedVector coefficient_by_difference(Function&& f, int k, double h) {
  // Weights of f at -m h, ..., m h, by the binomial formula for even k; odd k are averages of two.
  ExtendedVector sum;
  double factorial = 1.0;
  for (int i = 2; i <= k; ++i) factorial *= i;
  const auto add = [&](double place, double weight) {
    const ExtendedVector term = Extended(weight) * f(Extended(place) * Extended(h));
    sum = sum.size() == 0 ? term : ExtendedVector(sum + term);
  };
  double binomial = 1.0;
  for (int i = 0; i <= k; ++i) {
    const double weight = (i % 2 == 0 ? binomial : -binomial);
    if (k % 2 == 0) {
      add(k / 2 - i, weight);
    } else {
      add((k + 1) / 2 - i, 0.5 * weight);
      add((k - 1) / 2 - i, 0.5 * weight);
    }
    binomial = binomial * (k - i) / (i + 1);
  }
  Extended power(factorial);
  for (int i = 0; i < k; ++i) power *= Extended(h);
  return sum / power;
}

/// Differences approach `exact` with second order, or agree at once.
void expect_second_order(const ExtendedVector& coarse, const ExtendedVector& fine, const Vector& exact,
                         double scale, const std::string& what) {
  const double coarse_error = (to_double(coarse) - exact).norm(),
               fine_error = (to_double(fine) - exact).norm();
  if (coarse_error < 1e-9 * scale) {
    EXPECT_LT(fine_error, 1e-9 * scale) << what;
  } else {
    EXPECT_NEAR(std::log2(coarse_error / fine_error), 2.0, 0.1)
        << what << ": errors " << coarse_error << ", " << fine_error;
  }
}

Matrix coefficient_of(const SystemSeries& series, int k) {
  const auto at = static_cast<std::size_t>(k);
  return at < series.size() ? series[at].dense() : Matrix(Matrix::Zero(series[0].rows(), series[0].cols()));
}

template <class Element>
void check_derivatives() {
  const Sample<Element> sample;
  const RecordedEquations equations = sample.record();
  const Eigen::Index n = sample.data.n_coordinates;
  EquationWork<double> work;
  const ExtendedVector rest = ExtendedVector::Zero(n);
  for (int k = 0; k <= max_order; ++k) {
    const PathValues<double> values = sample.path_values(k);
    SteadyResidual residual{Matrix::Zero(n, k + 1), Matrix()};
    Linearization lin;
    ASSERT_FALSE(evaluate_residual(equations, values, work, residual));
    ASSERT_FALSE(evaluate_linearization(equations, values, work, lin));
    const std::string order = std::string(Element::name) + ", coefficient " + std::to_string(k);
    const auto compare = [&](auto f, const Vector& exact, double scale, const std::string& what) {
      expect_second_order(coefficient_by_difference(f, k, 0x1p-7), coefficient_by_difference(f, k, 0x1p-8),
                          exact, 1.0 + scale, order + what);
    };
    compare([&](const Extended& h) { return sample.force(h, rest, rest, rest); }, -residual.force.col(k),
            residual.force.norm(), " of the force");
    const std::array matrices = {&lin.K, &lin.C, &lin.M};
    for (int motion = 0; motion < 3; ++motion) {
      const Matrix exact = coefficient_of(*matrices[static_cast<std::size_t>(motion)], k);
      for (Eigen::Index j = 0; j < n; ++j)
        compare([&](const Extended& h) { return sample.derivative(h, motion, j); }, -exact.col(j),
                exact.norm(), " of column " + std::to_string(j) + ", motion " + std::to_string(motion));
    }
  }
}

/// Every kind of element as an index of the registry.
class ElementDerivatives : public testing::TestWithParam<std::size_t> {};

TEST_P(ElementDerivatives, AgreeWithDifferencesIn113BitsAtEveryOrder) {
  eigentrail::Elements().for_each([&]<class Element>(const std::vector<Placed<Element>>&, std::size_t kind) {
    if (kind == GetParam()) check_derivatives<Element>();
  });
}

/// Second derivatives in two directions: the first coefficient of K along a straight path.
TEST_P(ElementDerivatives, OfSecondOrderAgreeWithDifferencesOfTheForce) {
  eigentrail::Elements().for_each([&]<class Element>(const std::vector<Placed<Element>>&, std::size_t kind) {
    if (kind != GetParam()) return;
    Sample<Element> sample;
    sample.numbers.rightCols(2).setConstant(Extended(0.0));
    sample.coordinates.col(2).setConstant(Extended(0.0));
    const Eigen::Index n = sample.data.n_coordinates;
    const ExtendedVector rest = ExtendedVector::Zero(n), along = sample.coordinates.col(1);
    ExtendedVector across(n);
    for (Eigen::Index i = 0; i < n; ++i) across[i] = Extended(std::cos(3.0 * static_cast<double>(i)));
    EquationWork<double> work;
    Linearization lin;
    ASSERT_FALSE(evaluate_linearization(sample.record(), sample.path_values(1), work, lin));
    const Vector exact = -coefficient_of(lin.K, 1) * to_double(across);
    const auto mixed = [&](double size) {
      const Extended h(size);
      const auto f = [&](double a, double b) {
        return sample.force(Extended(0.0), along * (Extended(a) * h) + across * (Extended(b) * h), rest,
                            rest);
      };
      return ExtendedVector((f(1, 1) - f(1, -1) - f(-1, 1) + f(-1, -1)) / (Extended(4.0) * h * h));
    };
    expect_second_order(mixed(0x1p-9), mixed(0x1p-10), exact, 1.0 + exact.norm(), std::string(Element::name));
  });
}

std::vector<std::string> element_names() {
  std::vector<std::string> names;
  eigentrail::Elements().for_each([&]<class Element>(const std::vector<Placed<Element>>&, std::size_t) {
    names.emplace_back(Element::name);
  });
  return names;
}

INSTANTIATE_TEST_SUITE_P(Registry, ElementDerivatives,
                         testing::Range(std::size_t{0}, eigentrail::Elements::kinds),
                         [](const auto& tested) { return element_names()[tested.param]; });

/// What a matrix depends on by its record is what changes it. If an input were missing, the matrix would be
/// taken as constant, without an error.
TEST_P(ElementDerivatives, InputsOfTheRecordAreWhatChangesMatricesAndForces) {
  eigentrail::Elements().for_each([&]<class Element>(const std::vector<Placed<Element>>&, std::size_t kind) {
    if (kind != GetParam()) return;
    const Sample<Element> sample;
    const RecordedEquations equations = sample.record();
    const PathValues<double> values = sample.path_values(0);
    using Parts = std::array<Matrix, 4>;  // M, C, K and the forces
    const auto parts_at = [&](const PathValues<double>& at) {
      EquationWork<double> work;
      Linearization lin;
      SteadyResidual residual{Matrix::Zero(sample.data.n_coordinates, 1), Matrix()};
      EXPECT_FALSE(evaluate_linearization(equations, at, work, lin));
      EXPECT_FALSE(evaluate_residual(equations, at, work, residual));
      return Parts{lin.M[0].dense(), lin.C[0].dense(), lin.K[0].dense(), residual.force};
    };
    const std::array inputs = {&equations.inputs[0], &equations.inputs[1], &equations.inputs[2],
                               &equations.inputs_of_residual};
    const Parts here = parts_at(values);
    const auto changes = [&](const Parts& there, std::size_t i) {
      return (here[i] - there[i]).norm() > 1e-12 * here[i].norm();
    };
    PathValues<double> elsewhere = values;
    elsewhere.coordinates.row(0).array() +=
        Eigen::ArrayXd::LinSpaced(values.coordinates.cols(), 0.1, 0.3).transpose();
    const Parts moved = parts_at(elsewhere);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_EQ(inputs[i]->coordinates, changes(moved, i)) << Element::name << ", part " << i;
    for (Eigen::Index number = 0; number < values.numbers.cols(); ++number) {
      PathValues<double> other = values;
      other.numbers(0, number) += 0.05;
      const Parts there = parts_at(other);
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(inputs[i]->numbers.contains(static_cast<int>(number)), changes(there, i))
            << Element::name << ", part " << i << ", number " << number;
    }
  });
}

}  // namespace
}  // namespace eigentrail::test::element_derivatives_test
