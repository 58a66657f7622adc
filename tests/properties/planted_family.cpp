#include "properties/planted_family.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace eigentrail::test {
namespace {

using WideSeries = std::vector<WideMatrix>;

WideSeries widened(const MatrixSeries& series) {
  WideSeries result;
  for (const Matrix& coefficient : series) result.push_back(coefficient.cast<Wide>());
  return result;
}

WideSeries product(const WideSeries& a, const WideSeries& b) {
  WideSeries result(a.size() + b.size() - 1, WideMatrix::Zero(a[0].rows(), b[0].cols()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) result[i + j] += a[i] * b[j];
  }
  return result;
}

/// In double precision; a polynomial of matrices that rounding would change is refused.
MatrixSeries exactly(const WideSeries& series) {
  MatrixSeries result;
  for (const WideMatrix& coefficient : series) {
    result.push_back(coefficient.cast<double>());
    if (result.back().cast<Wide>() != coefficient) throw UnusableFamily("coefficients are not exact");
  }
  while (result.size() > 1 && result.back().isZero(0.0)) result.pop_back();
  return result;
}

}  // namespace

std::vector<WideComplex> PlantedBlock::mu(Wide p) const {
  if (size == 1) return {K(0, 0)(p)};
  if (size == 2) {
    const Wide mean = (K(0, 0)(p) + K(1, 1)(p)) / 2;
    const Wide half = (K(0, 0)(p) - K(1, 1)(p)) / 2;
    const WideComplex root = std::sqrt(WideComplex(half * half + K(0, 1)(p) * K(1, 0)(p)));
    return {mean - root, mean + root};
  }
  WideMatrix value(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) value(i, j) = K(i, j)(p);
  }
  const std::vector<Wide> sorted = jacobi_eigenvalues(value);
  return {sorted.begin(), sorted.end()};
}

std::vector<WideComplex> PlantedBlock::modes(Wide p) const {
  const Wide c = damping(p);
  std::vector<WideComplex> result;
  for (const WideComplex value : mu(p)) {
    const WideComplex excess = c * c - value;
    if (excess.imag() == 0 && excess.real() >= 0) {
      const Wide root = std::sqrt(excess.real());
      result.insert(result.end(), {-c - root, -c + root});
    } else {
      // Of a complex mu both roots are needed: the conjugate of one belongs to the conjugate of mu.
      const WideComplex root = std::sqrt(-excess);
      result.push_back(-c + WideComplex(0, 1) * root);
    }
  }
  return result;
}

Polynomial PlantedBlock::overdamping() const {
  return damping * damping - K(0, 0);
}

std::vector<Complex> PlantedFamily::spectrum(Wide p) const {
  std::vector<Complex> result;
  for (const PlantedBlock& block : blocks) {
    for (const WideComplex s : block.modes(p)) {
      result.push_back(narrow(s));
      if (s.imag() != 0) result.push_back(std::conj(narrow(s)));
    }
  }
  return result;
}

std::vector<LabelledMode> PlantedFamily::labelled(double p) const {
  std::vector<LabelledMode> result;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const auto passed = std::lower_bound(breaks[b].begin(), breaks[b].end(), static_cast<Wide>(p));
    const auto version = static_cast<int>(passed - breaks[b].begin());
    int label = 0;
    for (const WideComplex s : blocks[b].modes(p))
      result.push_back({narrow(s), static_cast<int>(b), version, label++});
  }
  return result;
}

HardCase PlantedFamily::as_case() const {
  HardCase result = family_case("planted_" + std::to_string(seed), "planted", from, to, matrices, special);
  const PlantedFamily copy = *this;
  set_spectrum(result, [copy](Wide p) { return copy.spectrum(p); });
  return result;
}

std::string PlantedFamily::description() const {
  std::ostringstream text;
  text.precision(10);
  text << "seed " << seed << ": " << size() << " freedoms, p from " << from << " to " << to << ", " << mixing
       << "\n";
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    text << "  block " << b << " " << blocks[b].kind << ", modes at the middle";
    for (const WideComplex s : blocks[b].modes((from + to) / 2)) text << " " << narrow(s);
    text << "\n";
  }
  for (std::size_t i = 0; i < special.size(); ++i) {
    const SpecialPoint& point = special[i];
    text << "  " << point.kind << " at " << point.parameter << " s " << point.s;
    if (point.kind == "veering") text << " half-width " << point.half_width;
    text << ", block";
    for (const int block : meeting[i]) text << " " << block;
    text << "\n";
  }
  return text.str();
}

Family mixed(const std::vector<PlantedBlock>& blocks, const MatrixSeries& P, const MatrixSeries& T) {
  const Eigen::Index n = T[0].rows();
  std::size_t terms = 1;
  for (const PlantedBlock& block : blocks) {
    terms = std::max(terms, block.damping.c.size());
    for (const Polynomial& entry : block.stiffness) terms = std::max(terms, entry.c.size());
  }
  WideSeries C(terms, WideMatrix::Zero(n, n));
  WideSeries K = C;
  Eigen::Index first = 0;
  for (const PlantedBlock& block : blocks) {
    for (Eigen::Index i = 0; i < block.size; ++i) {
      for (std::size_t k = 0; k < block.damping.c.size(); ++k)
        C[k](first + i, first + i) = 2 * block.damping.c[k];
      for (Eigen::Index j = 0; j < block.size; ++j) {
        const std::vector<Wide>& entry = block.K(i, j).c;
        for (std::size_t k = 0; k < entry.size(); ++k) K[k](first + i, first + j) = entry[k];
      }
    }
    first += block.size;
  }
  if (first != n) throw std::invalid_argument("mixed: blocks and mixing matrices differ in size");
  WideSeries left = widened(P);
  for (WideMatrix& coefficient : left) coefficient.transposeInPlace();
  const WideSeries right = widened(T);
  return {exactly(product(left, right)), exactly(product(product(left, C), right)),
          exactly(product(product(left, K), right))};
}

}  // namespace eigentrail::test
