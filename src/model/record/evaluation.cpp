#include "model/record/evaluation.hpp"

#include <cmath>

#include "model/record/series_rules.hpp"

namespace eigentrail {

template <class Real, int Lanes>
void Evaluation<Real, Lanes>::run(const Program& program, const std::vector<Functions>& functions) {
  using In = Operand<Pack>;
  using Rule = Rules<Pack>;
  for (const Instruction& i : program.instructions) {
    const auto in = [&](int slot) { return In{series(slot), varies(slot)}; };
    const In a = in(i.a);
    Pack* const y = series(i.out);
    // Sets the coefficients of the result, which varies if an operand does.
    const auto set = [&](auto coefficient, const auto&... others) {
      const bool any = (a.varies || ... || others.varies);
      set_varies(i.out, any);
      const int top = any ? order_ : 0;
      for (int k = 0; k <= top; ++k) y[k] = coefficient(k);
    };
    switch (i.op) {
      case Operator::add: {
        const In b = in(i.b);
        set([&](int k) { return Pack(a.at(k) + b.at(k)); }, b);
        break;
      }
      case Operator::subtract: {
        const In b = in(i.b);
        set([&](int k) { return Pack(a.at(k) - b.at(k)); }, b);
        break;
      }
      case Operator::negate:
        set([&](int k) { return Pack(-a.c[k]); });
        break;
      case Operator::multiply: {
        const In b = in(i.b);
        set([&](int k) { return Rule::product(a, b, k); }, b);
        break;
      }
      case Operator::multiply_add: {
        const In b = in(i.b), c = in(i.c);
        set([&](int k) { return Pack(Rule::product(a, b, k) + c.at(k)); }, b, c);
        break;
      }
      case Operator::multiply_behind: {
        const In b = in(i.b), c = in(i.c);
        set([&](int k) { return Pack(c.at(k) - Rule::product(a, b, k)); }, b, c);
        break;
      }
      case Operator::multiply_two: {
        const In b = in(i.b), c = in(i.c), d = in(i.d);
        set([&](int k) { return Pack(Rule::product(a, b, k) + Rule::product(c, d, k)); }, b, c, d);
        break;
      }
      case Operator::divide: {
        const In b = in(i.b);
        set([&](int k) { return Rule::quotient(y, a, b, k); }, b);
        break;
      }
      default:
        run_function(i, functions);
    }
  }
}

/// Functions of one variable. Their leading coefficients come from the library.
template <class Real, int Lanes>
void Evaluation<Real, Lanes>::run_function(const Instruction& i, const std::vector<Functions>& functions) {
  using In = Operand<Pack>;
  using Rule = Rules<Pack>;
  const In x{series(i.a), varies(i.a)};
  const int top = x.varies ? order_ : 0;
  Pack* const y = series(i.out);
  set_varies(i.out, x.varies);
  if (i.second >= 0) set_varies(i.second, x.varies);
  const auto lead = [&](Pack& result, auto function) {
    for (int l = 0; l < Lanes; ++l) result[l] = Real(function(x.c[0][l]));
  };
  const auto integrate = [&](auto function) {
    lead(y[0], function);
    Rule::integrate(y, top, x, In{series(i.b), varies(i.b)});
  };
  const auto both = [&](auto function, auto other, double sign) {
    lead(y[0], function);
    lead(series(i.second)[0], other);
    Rule::sine_cosine(y, series(i.second), top, x, sign);
  };
  using std::sqrt, std::exp, std::log, std::sin, std::cos, std::sinh, std::cosh, std::tanh, std::asin,
      std::acos, std::atan;
  switch (i.op) {
    case Operator::sqrt:
      lead(y[0], [](const Real& v) { return sqrt(v); });
      return Rule::sqrt(y, top, x);
    case Operator::exp:
      lead(y[0], [](const Real& v) { return exp(v); });
      return Rule::integrate(y, top, x, In{y, x.varies});
    case Operator::tanh:
      lead(y[0], [](const Real& v) { return tanh(v); });
      return Rule::tanh(y, top, x);
    case Operator::log:
      return integrate([](const Real& v) { return log(v); });
    case Operator::asin:
      return integrate([](const Real& v) { return asin(v); });
    case Operator::acos:
      return integrate([](const Real& v) { return acos(v); });
    case Operator::atan:
      return integrate([](const Real& v) { return atan(v); });
    case Operator::sin:
      return both([](const Real& v) { return sin(v); }, [](const Real& v) { return cos(v); }, -1.0);
    case Operator::sinh:
      return both([](const Real& v) { return sinh(v); }, [](const Real& v) { return cosh(v); }, 1.0);
    case Operator::step:
      lead(y[0], [](const Real& v) { return v >= Real(0.0) ? 1.0 : 0.0; });
      return set_varies(i.out, false);
    case Operator::function:
      return compose(i, functions[static_cast<std::size_t>(i.b)], top);
    default:
      run_choice(i);
  }
}

/// f(x(h)) and f'(x(h)) by Horner's rule in x(h) - x_0.
template <class Real, int Lanes>
void Evaluation<Real, Lanes>::compose(const Instruction& i, const Functions& functions, int top) {
  std::array<Real, max_order + 2> taylor;
  for (int l = 0; l < Lanes; ++l) {
    LongSeries distance = lane(i.a, l), value, slope;
    functions[static_cast<std::size_t>(l)]->taylor(
        distance[0], std::span<Real>(taylor.data(), static_cast<std::size_t>(top) + 2));
    distance[0] = Real(0.0);
    for (int k = top; k >= 0; --k) {
      const auto at = static_cast<std::size_t>(k);
      value = value * distance + LongSeries(taylor[at]);
      slope = slope * distance + LongSeries(Real(k + 1.0) * taylor[at + 1]);
    }
    set_lane(i.out, l, value);
    set_lane(i.second, l, slope);
  }
}

/// What depends on the leading values of two operands.
template <class Real, int Lanes>
void Evaluation<Real, Lanes>::run_choice(const Instruction& i) {
  const auto a = [&](int l) { return series(i.a)[0][l]; };
  const auto b = [&](int l) { return series(i.b)[0][l]; };
  const bool minimum = i.op == Operator::min || i.op == Operator::choose_min;
  const bool of_operands = i.op == Operator::min || i.op == Operator::max;
  const int first = of_operands ? i.a : i.c, other = of_operands ? i.b : i.d;
  set_varies(i.out, i.op == Operator::leading_angle ? false
                    : i.op == Operator::power       ? varies(i.a) || varies(i.b)
                                                    : varies(first) || varies(other));
  for (int l = 0; l < Lanes; ++l) {
    if (i.op == Operator::leading_angle) {
      series(i.out)[0][l] = Real(std::atan2(static_cast<double>(a(l)), static_cast<double>(b(l))));
    } else if (i.op == Operator::power) {
      set_lane(i.out, l, pow(lane(i.a, l), lane(i.b, l)));
    } else {
      set_lane(i.out, l, lane((minimum ? b(l) < a(l) : a(l) < b(l)) ? other : first, l));
    }
  }
}

template class Evaluation<double, 1>;
template class Evaluation<double, lanes>;
template class Evaluation<Extended, 1>;

}  // namespace eigentrail
