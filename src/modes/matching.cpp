#include "eigentrail/modes/matching.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "eigentrail/modes/pencil_at_point.hpp"

namespace eigentrail {

double mass_norm_squared(const ComplexVector& v, const SystemMatrix& M) {
  const double square = v.dot(multiply(M, v).col(0)).real();
  return square > 1e-12 * M.norm() * v.squaredNorm() ? square : 0.0;
}

ComplexVector normalize_shape(const ComplexVector& v, const SystemMatrix& M, const ComplexVector& reference) {
  ComplexVector Mv = multiply(M, v);
  double square = mass_norm_squared(v, M);
  if (square == 0.0) {
    Mv = v;
    square = v.squaredNorm();
  }
  // The reference has unit norm, so |anchor| lies between 0 and sqrt(square). Below 1e-8 of that v counts as
  // orthogonal to it.
  Complex anchor = reference.size() == v.size() ? reference.dot(Mv) : Complex(0.0);
  if (std::abs(anchor) <= 1e-8 * std::sqrt(square)) {
    Eigen::Index largest = 0;
    v.cwiseAbs().maxCoeff(&largest);
    anchor = v[largest];
  }
  return v * (std::abs(anchor) / anchor / std::sqrt(square));
}

namespace {

Vector mass_norms_squared(const ComplexMatrix& shapes, const SystemMatrix& M) {
  Vector norms(shapes.cols());
  for (Eigen::Index i = 0; i < shapes.cols(); ++i) norms[i] = mass_norm_squared(shapes.col(i), M);
  return norms;
}

}  // namespace

Matrix modal_assurance(const ComplexMatrix& V, const ComplexMatrix& W, const SystemMatrix& M) {
  const Vector v = mass_norms_squared(V, M);
  const Vector w = mass_norms_squared(W, M);
  Matrix assurance = (V.adjoint() * multiply(M, W)).cwiseAbs2();
  for (Eigen::Index i = 0; i < V.cols(); ++i) {
    for (Eigen::Index j = 0; j < W.cols(); ++j) {
      if (v[i] > 0.0 && w[j] > 0.0) {
        assurance(i, j) /= v[i] * w[j];
      } else {
        assurance(i, j) =
            std::norm(V.col(i).dot(W.col(j))) / (V.col(i).squaredNorm() * W.col(j).squaredNorm());
      }
    }
  }
  return assurance;
}

std::vector<int> optimal_assignment(const Matrix& cost) {
  const int n = static_cast<int>(cost.rows());
  const int columns = static_cast<int>(cost.cols());
  if (columns < n || !cost.allFinite()) {
    throw std::invalid_argument(
        "optimal_assignment: expected finite costs, at least as many columns as rows");
  }
  constexpr double unreached = std::numeric_limits<double>::infinity();
  // Row 0 and column 0 are auxiliary; row_of[j] is the row assigned to column j.
  std::vector<double> row_price(n + 1, 0.0), column_price(columns + 1, 0.0);
  std::vector<int> row_of(columns + 1, 0), previous(columns + 1, 0);
  for (int row = 1; row <= n; ++row) {
    std::vector<double> distance(columns + 1, unreached);
    std::vector<bool> visited(columns + 1, false);
    row_of[0] = row;
    int column = 0;
    do {
      visited[column] = true;
      const int current = row_of[column];
      double step = unreached;
      int next = 0;
      for (int j = 1; j <= columns; ++j) {
        if (visited[j]) continue;
        const double reduced = cost(current - 1, j - 1) - row_price[current] - column_price[j];
        if (reduced < distance[j]) {
          distance[j] = reduced;
          previous[j] = column;
        }
        if (distance[j] < step) {
          step = distance[j];
          next = j;
        }
      }
      if (next == 0)
        throw std::invalid_argument("optimal_assignment: costs too far apart for their differences");
      for (int j = 0; j <= columns; ++j) {
        if (visited[j]) {
          row_price[row_of[j]] += step;
          column_price[j] -= step;
        } else {
          distance[j] -= step;
        }
      }
      column = next;
    } while (row_of[column] != 0);
    for (; column != 0; column = previous[column]) row_of[column] = row_of[previous[column]];
  }
  std::vector<int> column_of(n);
  for (int j = 1; j <= columns; ++j) {
    if (row_of[j] != 0) column_of[row_of[j] - 1] = j - 1;
  }
  return column_of;
}

}  // namespace eigentrail
