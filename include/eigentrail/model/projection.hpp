// What a projected model stands for: the large model, the space of its modes' vectors, and what is known of
// the difference.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

/// Few motions to which the linearized equations of a large scene are restricted: at a place where the
/// constraints have the Jacobian A, the motions that they allow and whose part that was allowed at the
/// reference is one of these.
struct Motions {
  Matrix basis;              ///< n x k, orthonormal; allowed at the reference
  SparseMatrix constraints;  ///< m x n, A at the reference; 0 x 0 if there are none
};

struct Projection {
  /// n x k, orthonormal columns: x = basis times reduced coordinates. Empty for a scene: its shapes are those
  /// of all its coordinates.
  Matrix basis;
  /// n x k, orthonormal columns: the equations are multiplied with its transpose. Known while the projection
  /// is made; empty where it is `basis`, and afterwards.
  Matrix left_basis = {};
  std::optional<Motions> motions = {};  ///< only of a scene
  Eigen::Index freedoms = 0;            ///< of the large model
  std::vector<std::string> names;       ///< n, of the coordinates of the large model
  std::vector<double>
      sampled_at;              ///< values of the traced parameter (declared unit), in the order of sampling
  int factorizations = 0;      ///< of the large pencil
  long solutions = 0;          ///< with its factors
  std::size_t peak_bytes = 0;  ///< of the factors, one at a time
  std::string method;          ///< of the factorization
  /// Estimated error of the followed eigenvalues against the large model, relative to max(|s|, reference):
  /// the largest one on the range, and where.
  double error = 0.0;
  double error_at = 0.0;
  double target = 0.0;                  ///< what was asked for
  std::vector<std::string> notes = {};  ///< for the user

  bool is_of_family() const { return basis.size() > 0; }
};

}  // namespace eigentrail
