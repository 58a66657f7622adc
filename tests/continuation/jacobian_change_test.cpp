// The change of the linearized equations along a step, against their definition.
#include "continuation/step/jacobian_change.hpp"

#include <gtest/gtest.h>

#include "core/band_matrix.hpp"
#include "support/families.hpp"

namespace eigentrail::test::jacobian_change_test {
namespace {

constexpr Eigen::Index n = 20;  // products by BLAS
constexpr double scale = 0.3;
constexpr Eigen::Index width = 3;  // of bands

struct Pair {
  ComplexMatrix Z, Lambda;
};

/// J(v): what the residual and the normalization change by when (Z, Lambda) changes by (X, scale Y).
ComplexVector linearized(const PencilAtPoint& pencil, const Pair& at, const ComplexMatrix& W1,
                         const ComplexVector& v) {
  const Eigen::Index k = at.Z.cols();
  const ComplexMatrix X = v.head(n * k).reshaped(n, k);
  const ComplexMatrix Y = scale * v.tail(k * k).reshaped(k, k);
  const ComplexMatrix M = pencil.M.cast<Complex>();
  const ComplexMatrix C = pencil.C.cast<Complex>();
  const ComplexMatrix R = M * X * at.Lambda * at.Lambda + C * X * at.Lambda + pencil.K * X +
                          M * at.Z * (at.Lambda * Y + Y * at.Lambda) + C * at.Z * Y;
  const ComplexMatrix N = W1.adjoint() * (X * at.Lambda + at.Z * Y);
  ComplexVector result(v.size());
  result << R.reshaped(), N.reshaped();
  return result;
}

struct Place {
  std::string name;
  int k;
  bool constant_mass;
  bool banded = false;
};

void PrintTo(const Place& place, std::ostream* out) {
  *out << place.name;
}

class ChangeOfJacobian : public testing::TestWithParam<Place> {
 protected:
  ChangeOfJacobian() {
    if (GetParam().constant_mass) there.M = here.M;
    if (k == 1) W1.setZero();
    if (!GetParam().banded) return;
    for (PencilAtPoint* pencil : {&pencil_here, &pencil_there}) pencil->bands = bands_of(*pencil);
  }

  /// The pencil's matrices are cut to a band.
  static ReducedPencil family(unsigned seed) {
    ReducedPencil family = random_family(n, seed);
    if (!GetParam().banded) return family;
    for (Matrix* B : {&family.M[0], &family.C[0], &family.K[0]}) {
      for (Eigen::Index j = 0; j < n; ++j) {
        for (Eigen::Index i = 0; i < n; ++i) {
          if (std::abs(i - j) > width) (*B)(i, j) = 0.0;
        }
      }
    }
    return family;
  }
  static PencilBands bands_of(const PencilAtPoint& pencil) {
    const auto band = [](const Matrix& B) { return std::make_shared<const Matrix>(band_of(B, width)); };
    return {band(pencil.M), band(pencil.C), band(pencil.K)};
  }

  Pair random_pair() { return {random_complex(n, k, engine), random_complex(k, k, engine)}; }

  int k = GetParam().k;
  std::mt19937_64 engine{11};
  ReducedPencil here = family(1);
  ReducedPencil there = family(2);
  ComplexMatrix W1 = random_complex(n, k, engine);
  Pair from = random_pair(), to = random_pair();
  PencilAtPoint pencil_here{here}, pencil_there{there};
  ComplexVector u = random_complex(n * k + k * k, 1, engine);
  ComplexVector v = random_complex(n * k + k * k, 1, engine);
};

TEST_P(ChangeOfJacobian, IsTheDifferenceOfBoth) {
  const PairAtPlace here_{pencil_here, from.Z, from.Lambda};
  const PairAtPlace there_{pencil_there, to.Z, to.Lambda};
  const JacobianChange change(here_, there_, W1, scale);
  const ComplexVector expected = linearized(pencil_there, to, W1, v) - linearized(pencil_here, from, W1, v);
  EXPECT_LT((change.times(v) - expected).norm(), 1e-13 * expected.norm());
}

TEST_P(ChangeOfJacobian, HasAnAdjoint) {
  const PairAtPlace here_{pencil_here, from.Z, from.Lambda};
  const PairAtPlace there_{pencil_there, to.Z, to.Lambda};
  const JacobianChange change(here_, there_, W1, scale);
  const ComplexVector image = change.times(v), of_adjoint = change.adjoint_times(u);
  const Complex expected = u.dot(image);
  EXPECT_LT(std::abs(of_adjoint.dot(v) - expected), 1e-12 * std::abs(expected));
}

TEST_P(ChangeOfJacobian, IsTheSameOfColumns) {
  const PairAtPlace here_{pencil_here, from.Z, from.Lambda};
  const PairAtPlace there_{pencil_there, to.Z, to.Lambda};
  const JacobianChange change(here_, there_, W1, scale);
  ComplexMatrix columns(v.size(), 2);
  columns << v, u;
  ComplexMatrix expected(v.size(), 2), adjoint(v.size(), 2);
  expected << change.times(v), change.times(u);
  adjoint << change.adjoint_times(v), change.adjoint_times(u);
  EXPECT_LT((change.times(columns) - expected).norm(), 1e-13 * expected.norm());
  EXPECT_LT((change.adjoint_times(columns) - adjoint).norm(), 1e-13 * adjoint.norm());
}

INSTANTIATE_TEST_SUITE_P(Pairs, ChangeOfJacobian,
                         testing::Values(Place{"mode", 1, false}, Place{"mode_constant_mass", 1, true},
                                         Place{"two", 2, false}, Place{"two_constant_mass", 2, true},
                                         Place{"three", 3, false}, Place{"banded_mode", 1, false, true},
                                         Place{"banded_two", 2, false, true}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace eigentrail::test::jacobian_change_test
