#include "model/record/evaluation.hpp"

#include <cmath>

#include "model/record/series_rules.hpp"

namespace eigentrail {
template <class Real, int Lanes>
void Evaluation<Real, Lanes>::run(const Program& program,
                                  const std::vector<std::array<const SmoothFunction*, Lanes>>& functions) {
  using In = Operand<Pack>;
  using Rule = Rules<Pack>;
  for (const Instruction& i : program.instructions) {
    const auto in = [&](int slot) { return In{series(slot), varies(slot)}; };
    const auto vary = [&](auto... operands) {
      const bool any = (operands.varies || ...);
      set_varies(i.out, any);
      return any ? order_ : 0;
    };
    Pack* const y = series(i.out);
    switch (i.kernel) {
      case Kernel::constant:
        break;
      case Kernel::add: {
        const In a = in(i.a), b = in(i.b);
        const int top = vary(a, b);
        y[0] = a.c[0] + b.c[0];
        for (int k = 1; k <= top; ++k) y[k] = Rule::coefficient(a, k) + Rule::coefficient(b, k);
        break;
      }
      case Kernel::subtract: {
        const In a = in(i.a), b = in(i.b);
        const int top = vary(a, b);
        y[0] = a.c[0] - b.c[0];
        for (int k = 1; k <= top; ++k) y[k] = Rule::coefficient(a, k) - Rule::coefficient(b, k);
        break;
      }
      case Kernel::negate: {
        const In a = in(i.a);
        const int top = vary(a);
        for (int k = 0; k <= top; ++k) y[k] = -a.c[k];
        break;
      }
      case Kernel::multiply: {
        const In a = in(i.a), b = in(i.b);
        Rule::multiply(y, vary(a, b), a, b);
        break;
      }
      case Kernel::multiply_add: {
        const In a = in(i.a), b = in(i.b), c = in(i.c);
        const int top = vary(a, b, c);
        for (int k = 0; k <= top; ++k) y[k] = Rule::product(a, b, k) + Rule::coefficient(c, k);
        break;
      }
      case Kernel::multiply_two: {
        const In a = in(i.a), b = in(i.b), c = in(i.c), d = in(i.d);
        const int top = vary(a, b, c, d);
        for (int k = 0; k <= top; ++k) y[k] = Rule::product(a, b, k) + Rule::product(c, d, k);
        break;
      }
      case Kernel::multiply_behind: {
        const In a = in(i.a), b = in(i.b), c = in(i.c);
        const int top = vary(a, b, c);
        for (int k = 0; k <= top; ++k) y[k] = Rule::coefficient(c, k) - Rule::product(a, b, k);
        break;
      }
      case Kernel::divide: {
        const In a = in(i.a), b = in(i.b);
        Rule::divide(y, vary(a, b), a, b);
        break;
      }
      default:
        run_function(i, functions);
    }
  }
}

/// Functions of one variable, and what chooses by the leading values.
template <class Real, int Lanes>
void Evaluation<Real, Lanes>::run_function(
    const Instruction& i, const std::vector<std::array<const SmoothFunction*, Lanes>>& functions) {
  using In = Operand<Pack>;
  using Rule = Rules<Pack>;
  using std::sqrt, std::exp, std::log, std::sin, std::cos, std::sinh, std::cosh, std::tanh, std::asin,
      std::acos, std::atan;
  const In x{series(i.a), varies(i.a)};
  const int top = x.top(order_);
  Pack* const y = series(i.out);
  Pack* const second = i.second < 0 ? nullptr : series(i.second);
  set_varies(i.out, x.varies);
  if (i.second >= 0) set_varies(i.second, x.varies);
  const auto each = [&](Pack& result, auto function) {
    for (int l = 0; l < Lanes; ++l) result[l] = Real(function(x.c[0][l]));
  };
  const auto integrate = [&] { Rule::integrate(y, top, x, {series(i.b), varies(i.b)}); };
  switch (i.kernel) {
    case Kernel::sqrt:
      Rule::sqrt(y, top, x);
      break;
    case Kernel::exp:
      each(y[0], [](const Real& v) { return exp(v); });
      Rule::integrate(y, top, x, {y, x.varies});
      break;
    case Kernel::log:
      each(y[0], [](const Real& v) { return log(v); });
      integrate();
      break;
    case Kernel::asin:
      each(y[0], [](const Real& v) { return asin(v); });
      integrate();
      break;
    case Kernel::acos:
      each(y[0], [](const Real& v) { return acos(v); });
      integrate();
      break;
    case Kernel::atan:
      each(y[0], [](const Real& v) { return atan(v); });
      integrate();
      break;
    case Kernel::tanh:
      each(y[0], [](const Real& v) { return tanh(v); });
      Rule::tanh(y, top, x);
      break;
    case Kernel::sine_cosine:
      each(y[0], [](const Real& v) { return sin(v); });
      each(second[0], [](const Real& v) { return cos(v); });
      Rule::sine_cosine(y, second, top, x, -1.0);
      break;
    case Kernel::sinh_cosh:
      each(y[0], [](const Real& v) { return sinh(v); });
      each(second[0], [](const Real& v) { return cosh(v); });
      Rule::sine_cosine(y, second, top, x, 1.0);
      break;
    case Kernel::step:
      each(y[0], [](const Real& v) { return v >= Real(0.0) ? 1.0 : 0.0; });
      set_varies(i.out, false);
      break;
    case Kernel::function:
      compose(i, functions[static_cast<std::size_t>(i.b)]);
      break;
    default:
      run_choice(i);
  }
}

/// What chooses by the leading values, and powers.
template <class Real, int Lanes>
void Evaluation<Real, Lanes>::run_choice(const Instruction& i) {
  using std::abs, std::floor;
  using In = Operand<Pack>;
  using Rule = Rules<Pack>;
  const In a{series(i.a), varies(i.a)}, b{series(i.b), varies(i.b)};
  Pack* const y = series(i.out);
  const bool minimum = i.kernel == Kernel::min || i.kernel == Kernel::choose_min;
  const auto choose = [&](const In& first, const In& other) {
    set_varies(i.out, first.varies || other.varies);
    for (int k = 0; k <= (varies(i.out) ? order_ : 0); ++k) {
      const Pack p = Rule::coefficient(first, k), q = Rule::coefficient(other, k);
      for (int l = 0; l < Lanes; ++l) {
        const bool takes_other = minimum ? b.c[0][l] < a.c[0][l] : a.c[0][l] < b.c[0][l];
        y[k][l] = takes_other ? q[l] : p[l];
      }
    }
  };
  switch (i.kernel) {
    case Kernel::min:
    case Kernel::max:
      choose(a, b);
      return;
    case Kernel::choose_min:
    case Kernel::choose_max:
      choose({series(i.c), varies(i.c)}, {series(i.d), varies(i.d)});
      return;
    case Kernel::leading_angle:
      for (int l = 0; l < Lanes; ++l)
        y[0][l] = Real(std::atan2(static_cast<double>(a.c[0][l]), static_cast<double>(b.c[0][l])));
      set_varies(i.out, false);
      return;
    default:
      power(i);
  }
}

/// x^y by repeated squaring for integers, else exp(y log(x)).
template <class Real, int Lanes>
void Evaluation<Real, Lanes>::power(const Instruction& i) {
  set_varies(i.out, varies(i.a) || varies(i.b));
  for (int l = 0; l < Lanes; ++l) set_lane(i.out, l, pow(lane(i.a, l), lane(i.b, l)));
}

/// f(x(h)) and f'(x(h)).
template <class Real, int Lanes>
void Evaluation<Real, Lanes>::compose(const Instruction& i, const Functions& functions) {
  for (int l = 0; l < Lanes; ++l) {
    const SmoothFunction& f = *functions[static_cast<std::size_t>(l)];
    const LongSeries x = lane(i.a, l);
    set_lane(i.out, l, apply(f, x));
    set_lane(i.second, l, apply(Derivative(f), x));
  }
}

template class Evaluation<double, 1>;
template class Evaluation<double, lanes>;
template class Evaluation<Extended, 1>;

}  // namespace eigentrail
