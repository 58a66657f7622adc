// The derivatives of every element of the registry, from its record, against differences of its force in 113
// bits. The force is called with numbers there, so the recorder has no part in them.
#include <gtest/gtest.h>

#include <cmath>

#include "model/evaluate_equations.hpp"

namespace eigentrail::test {
namespace {

/// A number of 113 bits that mixes with those of the source.
using Number = Series<Extended, 0>;

/// Gives every field of an element a vector or a number of its own.
class Filler {
 public:
  explicit Filler(std::vector<Place>& arguments) : arguments_(arguments) {}

  int n_numbers() const { return n_numbers_; }
  /// Slot of the speed of sound; sections are slower.
  int sound() const { return sound_; }

  /// Every second vector is a weighted sum of two.
  void place(std::string_view, Place& place, std::string_view = {}) {
    const int index = static_cast<int>(arguments_.size());
    place = {{{index, {}}}, {}, index};
    if (index % 2 == 1) place.terms.push_back({index - 1, {0.0, n_numbers_++}});
    arguments_.push_back(place);
  }
  void point(std::string_view key, Place& p, std::string_view) { place(key, p); }
  void direction(std::string_view key, Place& d, std::string_view) { place(key, d); }
  void body(std::string_view key, std::array<Place, 3>& directors, std::string_view) {
    for (Place& d : directors) place(key, d);
  }
  void joint(std::string_view key, HingeAngle& angle, std::string_view) {
    for (Place* d : {&angle.axis, &angle.from, &angle.to}) place(key, *d);
  }
  void quantity(const QuantityField& field, Quantity& q) {
    if (field.key == "speed_of_sound") sound_ = n_numbers_;
    q = {1.0, n_numbers_++};
  }
  void vector(const QuantityField&, std::array<Quantity, 3>& v) {
    for (Quantity& q : v) q = {1.0, n_numbers_++};
  }
  void matrix(const QuantityField&, std::array<Quantity, 4>& m) {
    for (Quantity& q : m) q = {1.0, n_numbers_++};
  }

 private:
  std::vector<Place>& arguments_;
  int n_numbers_ = 0, sound_ = -1;
};

/// An element with data, as a model of its own with coordinates q: those of its triples and states.
template <class Element>
struct Sample {
  Placed<Element> placed;
  MultibodyData data;
  ExtendedMatrix numbers;      ///< by slot, as polynomials in h
  ExtendedMatrix coordinates;  ///< likewise
  static constexpr int n_states = number_of_states<Element>();

  Sample() {
    Filler filler(placed.arguments);
    Element::fields(placed.element, filler);
    placed.label = Element::name;
    if (n_states > 0) placed.first_state = 0;
    data.n_triples = static_cast<int>(placed.arguments.size());
    data.n_coordinates = 3 * data.n_triples + n_states;
    data.quantities.assign(static_cast<std::size_t>(filler.n_numbers()), Expression());
    const auto wave = [](Eigen::Index i, double rate) {
      return Extended(std::sin(rate * static_cast<double>(i) + 1.0));
    };
    numbers.resize(filler.n_numbers(), 3);
    for (Eigen::Index i = 0; i < numbers.rows(); ++i) {
      numbers(i, 0) = Extended(1.1) + Extended(0.4) * wave(i, 5.0);
      numbers(i, 1) = Extended(0.3) * wave(i, 3.0);
      numbers(i, 2) = Extended(0.2) * wave(i, 7.0);
    }
    if (filler.sound() >= 0) numbers.row(filler.sound()) << Extended(30.0), Extended(1.0), Extended(0.0);
    coordinates.resize(data.n_coordinates, 3);
    for (Eigen::Index i = 0; i < coordinates.rows(); ++i) {
      coordinates(i, 0) = Extended(0.7) * wave(i, 2.0) + Extended(0.05 * static_cast<double>(i));
      coordinates(i, 1) = Extended(0.5) * wave(i, 4.0);
      coordinates(i, 2) = Extended(0.4) * wave(i, 6.0);
    }
  }

  ExtendedVector at(const ExtendedMatrix& polynomials, const Extended& h) const {
    return polynomials.col(0) + polynomials.col(1) * h + polynomials.col(2) * (h * h);
  }

  /// The force on the coordinates at h, displaced, with rates and accelerations: the template with numbers.
  ExtendedVector force(const Extended& h, const ExtendedVector& displacement, const ExtendedVector& rates,
                       const ExtendedVector& accelerations) const {
    const ExtendedVector values = at(numbers, h), q = at(coordinates, h) + displacement;
    const auto vector = [&](const Place& place, const ExtendedVector& of) {
      ExtendedVector sum = ExtendedVector::Zero(3);
      for (const Term& term : place.terms) {
        const Extended weight = term.weight.slot < 0 ? Extended(1.0) : values[term.weight.slot];
        for (int i = 0; i < 3; ++i) sum[i] += weight * of[3 * term.triple + i];
      }
      return sum;
    };
    const auto numbers_of = [&](const Place& place, const ExtendedVector& of) {
      return Vec3<Number>(vector(place, of).template cast<Number>());
    };
    std::vector<MovingVector<Number>> vectors;
    for (const Place& place : placed.arguments)
      vectors.push_back({numbers_of(place, q), numbers_of(place, rates), numbers_of(place, accelerations)});
    std::vector<MovingState<Number>> states;
    for (int i = 0; i < n_states; ++i)
      states.push_back({Number(q[3 * data.n_triples + i]), Number(rates[3 * data.n_triples + i])});
    ElementView<Number> view([&](int slot) { return Number(values[slot]); }, vectors, states);
    placed.element.force(view);
    ExtendedVector result = ExtendedVector::Zero(data.n_coordinates);
    for (std::size_t a = 0; a < placed.arguments.size(); ++a) {
      for (const Term& term : placed.arguments[a].terms) {
        const Extended weight = term.weight.slot < 0 ? Extended(1.0) : values[term.weight.slot];
        for (int i = 0; i < 3; ++i) result[3 * term.triple + i] += weight * view.vectors()[a].force[i][0];
      }
    }
    for (int i = 0; i < n_states; ++i)
      result[3 * data.n_triples + i] = view.states()[static_cast<std::size_t>(i)].force[0];
    return result;
  }

  /// Central difference of the force in a direction of positions (0), rates (1) or accelerations (2).
  ExtendedVector derivative(const Extended& h, int motion, Eigen::Index direction) const {
    const Extended step(0x1p-30);
    ExtendedVector moved[3];
    for (ExtendedVector& v : moved) v = ExtendedVector::Zero(data.n_coordinates);
    moved[motion][direction] = step;
    const ExtendedVector ahead = force(h, moved[0], moved[1], moved[2]);
    moved[motion][direction] = -step;
    return (ahead - force(h, moved[0], moved[1], moved[2])) / (Extended(2.0) * step);
  }

  /// The same from the record.
  PathValues<double> path_values(int order) const {
    PathValues<double> values;
    values.order = order;
    const auto series = [&](const ExtendedMatrix& polynomials) {
      Matrix columns = Matrix::Zero(order + 1, polynomials.rows());
      for (int k = 0; k <= std::min(order, 2); ++k)
        columns.row(k) = to_double(polynomials.col(k)).transpose();
      return columns;
    };
    values.numbers = series(numbers);
    values.coordinates = series(coordinates);
    values.number_varies.assign(static_cast<std::size_t>(numbers.rows()), order > 0);
    values.coordinate_varies.assign(static_cast<std::size_t>(coordinates.rows()), order > 0);
    return values;
  }

  RecordedEquations record() const {
    eigentrail::Elements elements;
    std::get<std::vector<Placed<Element>>>(elements.lists).push_back(placed);
    return record_equations(data, elements, {});
  }
};

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

/// What an element declares is what its record has. If a declaration were missing, a matrix would be taken as
/// constant, without an error.
TEST(Registry, DeclaredDependencesAreThoseOfTheRecords) {
  eigentrail::Elements().for_each([&]<class Element>(const std::vector<Placed<Element>>&, std::size_t) {
    const Sample<Element> sample;
    const RecordedEquations equations = sample.record();
    EquationWork<double> work;
    Linearization here, there;
    PathValues<double> values = sample.path_values(0);
    ASSERT_FALSE(evaluate_linearization(equations, values, work, here));
    values.coordinates.row(0).array() +=
        Eigen::ArrayXd::LinSpaced(values.coordinates.cols(), 0.1, 0.3).transpose();
    ASSERT_FALSE(evaluate_linearization(equations, values, work, there));
    constexpr Dependence depends = Element::depends;
    const bool has_states = number_of_states<Element>() > 0;
    EXPECT_EQ(depends.position || has_states, here.K[0].norm() > 0.0) << Element::name;
    EXPECT_EQ(depends.velocity || has_states, here.C[0].norm() > 0.0) << Element::name;
    EXPECT_EQ(depends.acceleration, here.M[0].norm() > 0.0) << Element::name;
    const auto changes = [](const SystemMatrix& a, const SystemMatrix& b) {
      return (a.dense() - b.dense()).norm() > 1e-12 * a.norm();
    };
    if (!has_states) {
      EXPECT_EQ(depends.turning, changes(here.C[0], there.C[0])) << Element::name;
    }
    EXPECT_EQ(depends.turning_mass, changes(here.M[0], there.M[0])) << Element::name;
  });
}

}  // namespace
}  // namespace eigentrail::test
