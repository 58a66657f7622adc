// Families of pencils for tests, as power series about a point.
#pragma once

#include <random>

#include "eigentrail/reduction/reduced_pencil.hpp"

namespace eigentrail::test {

inline Matrix random_matrix(Eigen::Index rows, Eigen::Index columns, std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  return Matrix::NullaryExpr(rows, columns, [&] { return normal(engine); });
}

/// From a seed.
inline Matrix random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937_64 engine(seed);
  return random_matrix(rows, columns, engine);
}

inline ComplexMatrix random_complex(Eigen::Index rows, Eigen::Index columns, std::mt19937_64& engine) {
  ComplexMatrix B(rows, columns);
  B.real() = random_matrix(rows, columns, engine);
  B.imag() = random_matrix(rows, columns, engine);
  return B;
}

inline ComplexMatrix random_complex(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937_64 engine(seed);
  return random_complex(rows, columns, engine);
}

/// Polynomial family with a well-conditioned mass, gyroscopic and circulatory parts: series of length 4 about
/// 0.
inline ReducedPencil random_family(Eigen::Index n, unsigned seed) {
  std::mt19937_64 engine(seed);
  const Matrix I = Matrix::Identity(n, n);
  ReducedPencil family;
  for (int k = 0; k < 4; ++k) {
    const double size = 0.3 / (1 + k);
    const Matrix root = random_matrix(n, n, engine) * size / std::sqrt(static_cast<double>(n));
    family.M.push_back((k == 0 ? 1.0 : 0.0) * I + root * root.transpose());
    family.C.push_back(0.2 * size * random_matrix(n, n, engine));
    family.K.push_back(size * random_matrix(n, n, engine));
    if (k == 0) {
      for (Eigen::Index i = 0; i < n; ++i) family.K[0](i, i) += 1.0 + 2.0 * static_cast<double>(i);
    }
  }
  return family;
}

inline Matrix evaluate(const MatrixSeries& series, double h) {
  Matrix value = series.back();
  for (std::size_t k = series.size() - 1; k-- > 0;) value = value * h + series[k];
  return value;
}

/// The family's pencil at distance h, of order 0.
inline ReducedPencil at(const ReducedPencil& family, double h) {
  return {{evaluate(family.M, h)}, {evaluate(family.C, h)}, {evaluate(family.K, h)}};
}

}  // namespace eigentrail::test
