#include "model/record/evaluation.hpp"

#include <cmath>

namespace eigentrail {

// Rules for power series whose coefficients are packs of numbers, one for each element (Griewank & Walther,
// Evaluating Derivatives, 2nd ed., Table 13.2). A series that does not vary along the path has one
// coefficient.

/// An operand: the coefficients of a series, and whether it varies along the path. Null where an instruction
/// has none.
template <class Pack>
struct Operand {
  const Pack* c = nullptr;
  bool varies = false;

  Pack at(int k) const { return k == 0 || varies ? c[k] : Pack(Pack::Zero()); }
};

/// Rules for series of packs. They write coefficients up to `top`.
template <class Pack>
class Rules {
 public:
  using Real = typename Pack::Scalar;
  using In = Operand<Pack>;

  /// Coefficient k of a b, summed from a_0 b_k on.
  static Pack product(const In& a, const In& b, int k) {
    if (!a.varies) return b.varies || k == 0 ? Pack(a.c[0] * b.c[k]) : Pack(Pack::Zero());
    if (!b.varies) return a.c[k] * b.c[0];
    Pack sum = a.c[0] * b.c[k];
    for (int i = 1; i <= k; ++i) sum += a.c[i] * b.c[k - i];
    return sum;
  }

  /// q_k = (a_k - sum_{j<k} q_j b_{k-j}) / b_0
  static Pack quotient(const Pack* q, const In& a, const In& b, int k) {
    Pack rest = a.at(k);
    if (b.varies) {
      for (int j = 0; j < k; ++j) rest -= q[j] * b.c[k - j];
    }
    return rest / b.c[0];
  }

  /// Of these rules y_0 is there already.
  static void sqrt(Pack* y, int top, const In& x) {
    for (int k = 1; k <= top; ++k) {
      Pack rest = x.c[k];
      for (int j = 1; j < k; ++j) rest -= y[j] * y[k - j];
      y[k] = rest / (Real(2.0) * y[0]);
    }
  }

  /// y' = g x' with y_0 there already: k y_k = sum_j j x_j g_{k-j}. g may be y.
  static void integrate(Pack* y, int top, const In& x, const In& g) {
    for (int k = 1; k <= top; ++k) {
      y[k] = weight(1, k) * (x.c[1] * g.at(k - 1));
      for (int j = 2; j <= k; ++j) y[k] += weight(j, k) * (x.c[j] * g.at(k - j));
    }
  }

  /// Sine and cosine (sign = -1) or hyperbolic ones (sign = +1), with s_0 and c_0 there already.
  static void sine_cosine(Pack* s, Pack* c, int top, const In& x, double sign) {
    for (int k = 1; k <= top; ++k) {
      s[k].setZero();
      c[k].setZero();
      for (int j = 1; j <= k; ++j) {
        s[k] += weight(j, k) * (x.c[j] * c[k - j]);
        c[k] += (sign * weight(j, k)) * (x.c[j] * s[k - j]);
      }
    }
  }

  /// y' = (1 - y^2) x', because sinh and cosh overflow for large |x|.
  static void tanh(Pack* y, int top, const In& x) {
    std::array<Pack, max_order> rates;
    for (int k = 1; k <= top; ++k) {
      Pack& rate = rates[static_cast<std::size_t>(k - 1)];
      rate = Pack::Constant(Real(k == 1 ? 1.0 : 0.0));
      for (int i = 0; i < k; ++i) rate -= y[i] * y[k - 1 - i];
      y[k].setZero();
      for (int j = 1; j <= k; ++j) y[k] += weight(j, k) * (x.c[j] * rates[static_cast<std::size_t>(k - j)]);
    }
  }

  static Real weight(int j, int k) { return Real(double(j) / k); }
};

template <class Real, int Lanes>
void Evaluation<Real, Lanes>::run(const Program& program, const std::vector<Functions>& functions) {
  using In = Operand<Pack>;
  using Rule = Rules<Pack>;
  for (const Instruction& i : program.instructions) {
    const auto in = [&](int slot) { return slot < 0 ? In() : In{series(slot), varies(slot)}; };
    const In a = in(i.a), b = in(i.b), c = in(i.c), d = in(i.d);
    Pack* const y = series(i.out);
    // Sets the coefficients of the result, which varies if an operand does.
    const auto set = [&](auto coefficient) {
      const bool any = a.varies || b.varies || c.varies || d.varies;
      set_varies(i.out, any);
      const int top = any ? order_ : 0;
      for (int k = 0; k <= top; ++k) y[k] = coefficient(k);
    };
    switch (i.op) {
      case Operator::add:
        set([&](int k) { return Pack(a.at(k) + b.at(k)); });
        break;
      case Operator::subtract:
        set([&](int k) { return Pack(a.at(k) - b.at(k)); });
        break;
      case Operator::negate:
        set([&](int k) { return Pack(-a.c[k]); });
        break;
      case Operator::multiply:
        set([&](int k) { return Rule::product(a, b, k); });
        break;
      case Operator::multiply_add:
        set([&](int k) { return Pack(Rule::product(a, b, k) + c.at(k)); });
        break;
      case Operator::multiply_behind:
        set([&](int k) { return Pack(c.at(k) - Rule::product(a, b, k)); });
        break;
      case Operator::multiply_two:
        set([&](int k) { return Pack(Rule::product(a, b, k) + Rule::product(c, d, k)); });
        break;
      case Operator::divide:
        set([&](int k) { return Rule::quotient(y, a, b, k); });
        break;
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
