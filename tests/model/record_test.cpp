// Records and their programs against nested power series, which compute the same by another mechanism.
#include <gtest/gtest.h>

#include <cmath>
#include <concepts>
#include <functional>

#include "model/record/evaluation.hpp"
#include "model/record/recorder.hpp"

namespace eigentrail::test::record_test {
namespace {

static_assert(!std::equality_comparable<Recorded>);
static_assert(!std::totally_ordered<Recorded>);
static_assert(!std::convertible_to<Recorded, double> && !std::convertible_to<Recorded, bool>);

template <class Scalar>
using Function = std::function<Scalar(const Scalar& x, const Scalar& y, const Scalar& p)>;

/// A record of two components x and y and a number p; its force on x is the function.
struct Recording {
  Recorder recorder;
  Recorded x = recorder.component({{0, Recorded(1.0)}});
  Recorded y = recorder.component({{1, Recorded(1.0)}});
  Recorded p = recorder.number(0);

  explicit Recording(const Function<Recorded>& f) {
    recorder.record().forces = {recorder.node(f(x, y, p)), -1};
  }
};

/// Series of x, y and p for each lane.
template <class Real, int Q>
std::array<Series<Real, Q>, 3> inputs(int lane) {
  std::array<Series<Real, Q>, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (int k = 0; k <= Q; ++k)
      result[i][k] = Real(0.3 + 0.1 * std::sin(1.0 + 7.0 * static_cast<double>(i) + 3.0 * k + lane));
  }
  return result;
}

template <class Real, int Lanes, int Q>
void set_inputs(const Program& program, Evaluation<Real, Lanes>& evaluation) {
  for (int lane = 0; lane < Lanes; ++lane) {
    const auto series = inputs<Real, Q>(lane);
    const auto set = [&](int slot, const Series<Real, Q>& value) {
      for (int k = 0; k <= Q; ++k) evaluation.series(slot)[k][lane] = value[k];
      evaluation.set_varies(slot, Q > 0);
    };
    for (const LocalValue& in : program.coordinates) set(in.slot, series[static_cast<std::size_t>(in.index)]);
    for (const LocalValue& in : program.numbers) set(in.slot, series[2]);
  }
}

template <class Real, int Lanes>
Real coefficient(const Evaluation<Real, Lanes>& evaluation, int slot, int k, int lane) {
  return k == 0 || evaluation.varies(slot) ? evaluation.series(slot)[k][lane] : Real(0.0);
}

/// Value and derivatives of f at order Q, from its record and from nested series.
template <class Real, int Lanes, int Q>
void compare(Recording& recording, const Function<Series<Series<Real, Q>, 1>>& f, const std::string& name) {
  using Base = Series<Real, Q>;
  using Nested = Series<Base, 1>;
  const Record& record = recording.recorder.record();
  const Program values = value_program(record), derivatives = derivative_program(record);
  Evaluation<Real, Lanes> evaluation;
  evaluation.begin(values, Q);
  set_inputs<Real, Lanes, Q>(values, evaluation);
  evaluation.run(values, {});
  ASSERT_EQ(values.forces.size(), 1u) << name;
  for (int lane = 0; lane < Lanes; ++lane) {
    const auto in = inputs<Real, Q>(lane);
    const Nested expected = f(Nested(in[0]), Nested(in[1]), Nested(in[2]));
    for (int k = 0; k <= Q; ++k)
      EXPECT_NEAR(static_cast<double>(coefficient(evaluation, values.forces[0].slot, k, lane)),
                  static_cast<double>(expected[0][k]),
                  1e-13 * (1.0 + std::abs(static_cast<double>(expected[0][k]))))
          << name << " coefficient " << k;
  }
  evaluation.begin(derivatives, Q);
  set_inputs<Real, Lanes, Q>(derivatives, evaluation);
  evaluation.run(derivatives, {});
  for (int lane = 0; lane < Lanes; ++lane) {
    for (int direction = 0; direction < 2; ++direction) {
      const auto in = inputs<Real, Q>(lane);
      Nested x(in[0]), y(in[1]);
      (direction == 0 ? x : y)[1] = Base(1.0);
      const Base expected = f(x, y, Nested(in[2]))[1];
      Base found;
      for (const Entry& entry : derivatives.entries) {
        if (entry.column != direction) continue;
        for (int k = 0; k <= Q; ++k) found[k] += coefficient(evaluation, entry.slot, k, lane);
      }
      for (int k = 0; k <= Q; ++k)
        EXPECT_NEAR(static_cast<double>(found[k]), static_cast<double>(expected[k]),
                    1e-12 * (1.0 + std::abs(static_cast<double>(expected[k]))))
            << name << " derivative by " << direction << ", coefficient " << k;
    }
  }
}

struct Formula {
  std::string name;
  std::function<void()> check;
};

template <class F>
Formula formula(const std::string& name, F f) {
  return {name, [name, f] {
            const auto all_orders = [&]<int Q>() {
              Recording recording(f);
              compare<double, 1, Q>(recording, f, name);
              compare<double, lanes, Q>(recording, f, name);
              compare<Extended, 1, Q>(recording, f, name);
            };
            all_orders.template operator()<0>();
            all_orders.template operator()<1>();
            all_orders.template operator()<3>();
            all_orders.template operator()<5>();
          }};
}

class RecordedFunctions : public testing::TestWithParam<Formula> {};

TEST_P(RecordedFunctions, EqualNestedSeries) {
  GetParam().check();
}

INSTANTIATE_TEST_SUITE_P(
    Operators, RecordedFunctions,
    testing::Values(
        formula("sums", [](auto x, auto y, auto p) { return x + p * y - (x - 2.0 * y) - p; }),
        formula("products", [](auto x, auto y, auto p) { return -(x * y) * (p + x) * x * y; }),
        formula("quotients", [](auto x, auto y, auto p) { return x / (y + p) - p / x + x / p; }),
        formula("roots", [](auto x, auto y, auto p) { return sqrt(x * x + y * y) * p; }),
        formula("exponentials", [](auto x, auto y, auto p) { return exp(p * x) * log(x + y); }),
        formula("circular", [](auto x, auto y, auto p) { return sin(x * y) + cos(y) * cos(p * x); }),
        formula("hyperbolic", [](auto x, auto y, auto p) { return sinh(x * y) - cosh(y) * tanh(p * x); }),
        formula("tangent", [](auto x, auto y, auto p) { return tan(x * p) * y; }),
        formula("inverse", [](auto x, auto y, auto p) { return asin(x * p) + acos(y) * atan(x * y); }),
        formula("angles", [](auto x, auto y, auto p) { return angle_of(x * p, -y); }),
        formula("powers",
                [](auto x, auto y, auto p) { return pow(x, y) + pow(x, p) + pow(y, 0.0 * p + 3.0); })),
    [](const auto& tested) { return tested.param.name; });

TEST(Recorder, EqualOperationsAreRecordedOnce) {
  Recording twice(
      [](const Recorded& x, const Recorded& y, const Recorded& p) { return x * y * p + sin(x * y); });
  int products = 0;
  for (const Operation& operation : twice.recorder.record().operations)
    products += operation.op == Operator::multiply;
  EXPECT_EQ(products, 2);
}

TEST(Programs, HaveNothingThatIsNotWanted) {
  Recorder recorder;
  const Recorded x = recorder.component({{0, Recorded(1.0)}}), p = recorder.number(0);
  const Recorded dead = exp(x) * sin(p);
  recorder.record().forces = {recorder.node(p * x)};
  EXPECT_EQ(value_program(recorder.record()).instructions.size(), 1u);
  EXPECT_EQ(derivative_program(recorder.record()).instructions.size(), 0u);  // it is p itself
  EXPECT_GE(dead.node(), 0);
}

/// A product of a rate has a derivative by the rate only: the rate is zero.
TEST(Programs, RatesHaveNoValue) {
  Recorder recorder;
  const Recorded x = recorder.component({{0, Recorded(1.0)}}), v = recorder.rate(0);
  recorder.record().forces = {recorder.node(x * v + v * v)};
  EXPECT_TRUE(value_program(recorder.record()).forces.empty());
  const Program derivatives = derivative_program(recorder.record());
  ASSERT_EQ(derivatives.entries.size(), 1u);
  EXPECT_EQ(derivatives.entries[0].target, Target::damping);
  EXPECT_EQ(derivatives.n_directions, 1);
}

/// Piecewise operations choose for every lane, in every evaluation.
TEST(Programs, ChooseForEveryElement) {
  Recorder recorder;
  const Recorded x = recorder.component({{0, Recorded(1.0)}}), p = recorder.number(0);
  recorder.record().forces = {
      recorder.node(abs(x) + 10.0 * min(x, p) + 100.0 * max(x, p) + 1000.0 * step(x))};
  const Program values = value_program(recorder.record()),
                derivatives = derivative_program(recorder.record());
  Evaluation<double, lanes> evaluation;
  const std::array<double, lanes> at = {-2.0, -0.5, 0.5, 2.0};
  const auto run = [&](const Program& program) {
    evaluation.begin(program, 1);
    for (const auto* inputs : {&program.coordinates, &program.numbers}) {
      for (const LocalValue& in : *inputs) {
        for (int lane = 0; lane < lanes; ++lane) {
          evaluation.series(in.slot)[0][lane] =
              inputs == &program.numbers ? 1.0 : at[static_cast<std::size_t>(lane)];
          evaluation.series(in.slot)[1][lane] = inputs == &program.numbers ? 0.0 : 1.0;
        }
        evaluation.set_varies(in.slot, true);
      }
    }
    evaluation.run(program, {});
  };
  run(values);
  const int force = values.forces[0].slot;
  const auto expected = [](double v) {
    return std::abs(v) + 10.0 * std::min(v, 1.0) + 100.0 * std::max(v, 1.0) + (v >= 0.0 ? 1000.0 : 0.0);
  };
  const auto slope = [](double v) { return (v < 0.0 ? -1.0 : 1.0) + (v < 1.0 ? 10.0 : 100.0); };
  for (int lane = 0; lane < lanes; ++lane) {
    const double v = at[static_cast<std::size_t>(lane)];
    EXPECT_DOUBLE_EQ(evaluation.series(force)[0][lane], expected(v));
    EXPECT_DOUBLE_EQ(evaluation.series(force)[1][lane], slope(v));
  }
  run(derivatives);
  ASSERT_EQ(derivatives.entries.size(), 1u);
  for (int lane = 0; lane < lanes; ++lane)
    EXPECT_DOUBLE_EQ(evaluation.series(derivatives.entries[0].slot)[0][lane],
                     slope(at[static_cast<std::size_t>(lane)]));
}

/// f(x) = x^3 by its Taylor coefficients.
class Cube final : public SmoothFunction {
 public:
  void taylor(double x, std::span<double> c) const override { cube(x, c); }
  void taylor(const Extended& x, std::span<Extended> c) const override { cube(x, c); }

 private:
  template <class Real>
  static void cube(const Real& x, std::span<Real> c) {
    const std::array<Real, 4> all = {x * x * x, Real(3.0) * x * x, Real(3.0) * x, Real(1.0)};
    for (std::size_t k = 0; k < c.size(); ++k) c[k] = k < 4 ? all[k] : Real(0.0);
  }
};

TEST(Programs, ComposeFunctionsWithSeries) {
  const Cube cube;
  Recorder recorder;
  const Recorded x = recorder.component({{0, Recorded(1.0)}});
  recorder.record().forces = {recorder.node(apply(cube, x * x))};
  const Program derivatives = derivative_program(recorder.record());
  Evaluation<double, 1> evaluation;
  evaluation.begin(derivatives, 3);
  const Series<double, 3> at = inputs<double, 3>(0)[0];
  for (const LocalValue& in : derivatives.coordinates) {
    for (int k = 0; k <= 3; ++k) evaluation.series(in.slot)[k][0] = at[k];
    evaluation.set_varies(in.slot, true);
  }
  evaluation.run(derivatives, {{&cube}});
  const Series<double, 3> expected = 6.0 * integer_power(at, 5);
  for (int k = 0; k <= 3; ++k)
    EXPECT_NEAR(coefficient(evaluation, derivatives.entries[0].slot, k, 0), expected[k], 1e-13);
}

}  // namespace
}  // namespace eigentrail::test::record_test
