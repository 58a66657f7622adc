#include "properties/blocks.hpp"

#include <cmath>
#include <utility>

namespace eigentrail::test {
namespace {

/// Roots with Im >= 0 of factor - shift and factor + shift, of degree one or two, with the mean eigenvalue
/// there.
void add_exceptional(PlantedBlock& block, const Polynomial& factor, WideComplex shift) {
  const Polynomial twice_mean = block.K(0, 0) + block.K(1, 1);
  for (const Wide sign : {1, -1}) {
    const WideComplex square = factor.c.size() > 2 ? factor.c[2] : 0;
    for (const WideComplex p : roots_of_quadratic(factor.c[0] - sign * shift, factor.c[1], square)) {
      if (p.imag() >= 0) block.exceptional.push_back({p, twice_mean(p) / Wide(2)});
    }
  }
}

/// A steep mode that meets two others at `first` and `second`: [[a, e1, e2], [e1, b, 0], [e2, 0, d]].
class Arrow {
 public:
  Arrow(Wide base, Wide slope, Wide first, Wide second, Wide e1, Wide e2)
      : base_(rounded(base)),
        a_(rounded(Polynomial(base) + Polynomial(slope) * from_root(first))),
        d_(rounded(base + slope * (second - first))),
        e1_(rounded(e1)),
        e2_(rounded(e2)) {
    if (e1_ < 4 * quantum || e2_ < 4 * quantum) throw UnusableFamily("coupling below the quantum");
  }

  PlantedBlock block(Wide c) const {
    PlantedBlock result{"shared veerings", 3, rounded(Polynomial(c)), {}, {}};
    const Polynomial zero;
    result.stiffness = {
        a_,   Polynomial(e1_), Polynomial(e2_), Polynomial(e1_), Polynomial(base_), zero, Polynomial(e2_),
        zero, Polynomial(d_)};
    const Wide slope = a_.c[1];
    for (const auto& [level, e] : {std::pair{base_, e1_}, std::pair{d_, e2_}}) {
      const Wide p = (level - a_.c[0]) / slope;
      result.exceptional.push_back(refined({p, 2 * e / std::abs(slope)}, level));
    }
    const auto& found = result.exceptional;
    if (std::abs(found[0].p - found[1].p) < std::abs((d_ - base_) / slope) / 2)
      throw UnusableFamily("two veerings are one");
    return result;
  }

 private:
  /// Newton's method on f = f_x = 0, f = det(K - (level + x) I) written so that nothing cancels near the
  /// level.
  PlantedBlock::Exceptional refined(WideComplex p, Wide level) const {
    const WideComplex half(Wide(0.5));
    const Wide slope = a_.c[1];
    // p = centre + u, a - level = slope u + rest.
    const Wide centre = p.real();
    const Wide rest = a_(centre) - level;
    WideComplex u = p - centre;
    WideComplex x = half * (slope * u + rest);
    const WideComplex B = base_ - level;
    const WideComplex D = d_ - level;
    const WideComplex f1 = e1_ * e1_;
    const WideComplex f2 = e2_ * e2_;
    for (int i = 0; i < 60; ++i) {
      const WideComplex A = slope * u + rest;
      const WideComplex f = (A - x) * (B - x) * (D - x) - f1 * (D - x) - f2 * (B - x);
      const WideComplex fx = -(B - x) * (D - x) - (A - x) * (D - x) - (A - x) * (B - x) + f1 + f2;
      const WideComplex fxx = Wide(2) * ((A - x) + (B - x) + (D - x));
      const WideComplex fu = slope * (B - x) * (D - x);
      const WideComplex fxu = -slope * ((D - x) + (B - x));
      const WideComplex det = fx * fxu - fu * fxx;
      const WideComplex dx = (f * fxu - fu * fx) / det;
      const WideComplex du = (fx * fx - fxx * f) / det;
      x -= dx;
      u -= du;
      if (std::abs(du) <= Wide(1e-17) * std::abs(u)) {
        if (u.imag() < 0) return {std::conj(centre + u), std::conj(level + x)};
        return {centre + u, level + x};
      }
    }
    throw UnusableFamily("no exceptional point found near the planted veering");
  }

  Wide base_;
  Polynomial a_;
  Wide d_, e1_, e2_;
};

}  // namespace

Wide rounded(Wide value, Wide unit) {
  return std::round(value / unit) * unit;
}

Polynomial rounded(Polynomial a, Wide unit) {
  for (Wide& coefficient : a.c) coefficient = rounded(coefficient, unit);
  return a;
}

PlantedBlock single(const std::string& kind, const Polynomial& damping, const Polynomial& stiffness) {
  return {kind, 1, rounded(damping), {rounded(stiffness)}, {}};
}

PlantedBlock two_coupled(const std::string& kind, Wide c, const Polynomial& mean, Polynomial g, Wide e,
                         bool symmetric) {
  g = rounded(g);
  e = rounded(e);
  if (e < 4 * quantum) throw UnusableFamily("coupling below the quantum");
  PlantedBlock block{kind, 2, rounded(Polynomial(c)), {}, {}};
  const Polynomial m = rounded(mean);
  block.stiffness = {m + g, Polynomial(e), Polynomial(symmetric ? e : -e), m - g};
  add_exceptional(block, g, symmetric ? WideComplex(0, e) : WideComplex(e));
  return block;
}

PlantedBlock companion(const std::string& kind, Wide c, const Polynomial& mean, Polynomial delta) {
  constexpr Wide b = 0.25;
  delta = rounded(delta);
  PlantedBlock block{kind, 2, rounded(Polynomial(c)), {}, {}};
  const Polynomial m = rounded(mean);
  block.stiffness = {m, Polynomial(b), Polynomial(1 / b) * delta, m};
  const std::vector<Wide> roots = real_roots(delta, -1, 1);
  if (roots.size() + 1 != delta.c.size()) throw UnusableFamily("rounding made two roots complex");
  for (const Wide p : roots) block.exceptional.push_back({p, m(p)});
  return block;
}

PlantedBlock shared_veerings(Wide c, Wide base, Wide slope, Wide first, Wide second, Wide e1, Wide e2) {
  return Arrow(base, slope, first, second, e1, e2).block(c);
}

}  // namespace eigentrail::test
