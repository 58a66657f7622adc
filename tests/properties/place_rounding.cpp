#include "properties/place_rounding.hpp"

#include <Eigen/SVD>
#include <cmath>
#include <limits>

namespace eigentrail::test {
namespace {

using WideComplexMatrix = Eigen::Matrix<WideComplex, Eigen::Dynamic, Eigen::Dynamic>;
using WideComplexVector = Eigen::Matrix<WideComplex, Eigen::Dynamic, 1>;

/// A polynomial of matrices at a complex parameter, its derivative, and the sum of the magnitudes of its
/// terms.
struct Terms {
  WideComplexMatrix value, slope;
  WideMatrix size;
};

Terms terms_of(const MatrixSeries& series, WideComplex p) {
  const Eigen::Index n = series[0].rows();
  Terms terms{WideComplexMatrix::Zero(n, n), WideComplexMatrix::Zero(n, n), WideMatrix::Zero(n, n)};
  for (std::size_t k = series.size(); k-- > 0;) {
    terms.slope = terms.slope * p + terms.value;
    terms.value = terms.value * p + series[k].cast<WideComplex>();
    terms.size = terms.size * std::abs(p) + series[k].cast<Wide>().cwiseAbs();
  }
  return terms;
}

/// The place at one of the two complex parameters of a veering, and how singular the pencil is there.
struct WidePlace {
  WidePlace(const Family& family, WideComplex s, WideComplex p) {
    const Terms M = terms_of(family.M, p), C = terms_of(family.C, p), K = terms_of(family.K, p);
    const WideComplexMatrix P = s * s * M.value + s * C.value + K.value;
    const Eigen::JacobiSVD<WideComplexMatrix> svd(P, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Index last = P.rows() - 1;
    singular_value = svd.singularValues()[last];
    const WideComplexVector y = svd.matrixU().col(last), z = svd.matrixV().col(last);
    const Wide size = std::abs(s);
    const Wide changed = y.cwiseAbs().dot((size * size * M.size + size * C.size + K.size) * z.cwiseAbs());
    const WideComplex slope = y.dot((s * s * M.slope + s * C.slope + K.slope) * z);
    moves = std::numeric_limits<double>::epsilon() * static_cast<double>(changed / std::abs(slope));
  }
  Wide singular_value;
  double moves;
};

}  // namespace

double place_rounding(const Family& family, const SpecialPoint& point) {
  if (point.kind != "collision" && point.kind != "veering") return 0.0;
  const WideComplex s(point.s.real(), point.s.imag());
  const WidePlace above(family, s, WideComplex(point.parameter, point.half_width));
  const WidePlace below(family, s, WideComplex(point.parameter, -point.half_width));
  return above.singular_value < below.singular_value ? above.moves : below.moves;
}

}  // namespace eigentrail::test
