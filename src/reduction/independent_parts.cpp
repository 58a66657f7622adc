#include "eigentrail/reduction/independent_parts.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <utility>

#include "core/singular_vectors.hpp"

namespace eigentrail {
namespace {

/// Eigenvalues of a random combination that are closer than this, relative to the largest one, are treated as
/// possibly equal. Whether they belong together is decided by the coupling, not by this distance: a larger
/// value only costs time.
constexpr double possibly_equal = 1e-6;
/// Coupling between parts up to this is rounding, relative to matrices of norm one: about a hundred units in
/// the last place. A coupling of 1e-13 makes a veering, and no crossing. Where the condition of the
/// coordinates magnifies rounding beyond this, parts are not separated.
constexpr double no_coupling = 3e-14;
/// Largest condition number of the coordinates, and root of that of the matrices they are computed from.
constexpr double worst = 1e4;
/// Distance of eigenvalues of a random X, relative to the largest one, from which they belong to different
/// parts. They are equal up to rounding, or far apart: X is random.
constexpr double different = 1e-4;
/// Largest number of unknowns in X for one group of coupled eigenspaces. Its cost is the third power.
constexpr Eigen::Index most_unknowns = 400;
/// Scaling is left out if all factors lie within this ratio: it would change only rounding.
constexpr double well_scaled = 64.0;
/// The same for first-order equations. Their states are positions and velocities side by side, and the bounds
/// of the certificate are norms of both: with velocities ten times as large it needs twice the
/// factorizations.
constexpr double well_scaled_states = 4.0;

using Random = std::mt19937_64;

/// What a search for parts needs besides the matrices.
struct Search {
  Random random;
  /// Rounding of the matrices in units of their own: more than one where large terms cancel in their entries.
  double rounding = 1.0;
  /// How many times rounding may be magnified in the search for X by the condition of eigenvectors. What a
  /// generous search finds is tested like anything else.
  double slack = 1.0;

  /// Largest share of a matrix that counts as zero.
  double zero() const { return rounding * slack * no_coupling; }
};

double random_number(Random& random) {
  return std::normal_distribution<double>()(random);
}

Matrix random_combination(const std::vector<Matrix>& all, Random& random) {
  Matrix sum = Matrix::Zero(all[0].rows(), all[0].cols());
  for (const Matrix& A : all) sum += random_number(random) * A;
  return sum;
}

/// Scaling of rows and columns by powers of two.
struct Balance {
  Vector rows, columns;

  Matrix of(const Matrix& A) const { return rows.asDiagonal() * A * columns.asDiagonal(); }
  double ratio() const {
    return std::max(rows.maxCoeff() / rows.minCoeff(), columns.maxCoeff() / columns.minCoeff());
  }
};

double power_of_two(double x) {
  return std::exp2(std::round(std::log2(x)));
}

Matrix sum_of_magnitudes(const std::vector<Matrix>& matrices, Eigen::Index n) {
  Matrix sum = Matrix::Zero(n, n);
  for (const Matrix& A : matrices) {
    if (A.size() > 0 && A.allFinite()) sum += A.cwiseAbs();
  }
  return sum;
}

/// The sum |M| w^2 + |C| w + |K| of magnitudes, at the frequency w at which the first and the last have the
/// same norm; without M, the last two. No term then counts for more because of the unit of time. Freedoms
/// that no force holds have no frequency: their mass does not count, or else scaling it up would lower w
/// further and further.
Matrix at_typical_frequency(const Matrix& M, const Matrix& C, const Matrix& K) {
  const Vector held = (K.rowwise().norm().array() > 0.0).cast<double>();
  const double m = (held.asDiagonal() * M).norm();
  const double c = C.norm();
  const double k = K.norm();
  const double w = m > 0.0 && k > 0.0 ? std::sqrt(k / m) : c > 0.0 && k > 0.0 ? k / c : 1.0;
  return M * (w * w) + C * w + K;
}

/// Makes the largest entries of all rows and columns of that sum about equal (Ruiz 2001). The frequency is
/// that of the coordinates found so far: in those given, one unit may hide all others. Symmetric matrices are
/// scaled symmetrically.
Balance balance(const CoefficientMatrices& coefficients, Eigen::Index n) {
  constexpr int most_sweeps =
      200;                        // of which freedoms without stiffness may need a hundred, others about ten
  constexpr double enough = 0.1;  // largest deviation of a norm from one
  const Matrix M = sum_of_magnitudes(coefficients.M, n);
  const Matrix C = sum_of_magnitudes(coefficients.C, n);
  const Matrix K = sum_of_magnitudes(coefficients.K, n);
  Balance scaling{Vector::Ones(n), Vector::Ones(n)};
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const Matrix sum = at_typical_frequency(scaling.of(M), scaling.of(C), scaling.of(K));
    const Vector rows = sum.rowwise().norm();
    const Vector columns = sum.colwise().norm();
    const auto deviates = [](double norm) { return norm > 0.0 && std::abs(norm - 1.0) > enough; };
    if (std::none_of(rows.begin(), rows.end(), deviates) &&
        std::none_of(columns.begin(), columns.end(), deviates))
      break;
    const auto factor = [](double norm) { return norm > 0.0 ? 1.0 / std::sqrt(norm) : 1.0; };
    scaling.rows.array() *= rows.unaryExpr(factor).array();
    scaling.columns.array() *= columns.unaryExpr(factor).array();
  }
  scaling.rows = scaling.rows.unaryExpr(&power_of_two);
  scaling.columns = scaling.columns.unaryExpr(&power_of_two);
  return scaling;
}

/// Groups of indices, as lists, from a label per index.
std::vector<std::vector<Eigen::Index>> groups_of(const std::vector<Eigen::Index>& labels) {
  std::vector<std::vector<Eigen::Index>> groups;
  for (Eigen::Index label = 0; label < static_cast<Eigen::Index>(labels.size()); ++label) {
    std::vector<Eigen::Index> members;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] == label) members.push_back(static_cast<Eigen::Index>(i));
    }
    if (!members.empty()) groups.push_back(std::move(members));
  }
  return groups;
}

/// Groups of indices that are connected, directly or by others.
template <class Connected>
std::vector<std::vector<Eigen::Index>> connected_groups(Eigen::Index count, const Connected& connected) {
  std::vector<Eigen::Index> labels(static_cast<std::size_t>(count));
  std::iota(labels.begin(), labels.end(), Eigen::Index{0});
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const Eigen::Index a = labels[static_cast<std::size_t>(i)];
      const Eigen::Index b = labels[static_cast<std::size_t>(j)];
      if (a != b && connected(i, j)) std::replace(labels.begin(), labels.end(), a, b);
    }
  }
  return groups_of(labels);
}

std::vector<std::vector<Eigen::Index>> close_groups(const ComplexVector& values, double distance) {
  return connected_groups(values.size(), [&](Eigen::Index i, Eigen::Index j) {
    return std::abs(values[i] - values[j]) <= distance;
  });
}

/// A random X with X H = H X, block diagonal in the given groups of coordinates (eigenspaces of another
/// matrix with which X commutes). Empty if that costs too much.
template <class Values>
std::optional<Values> random_commuting(const Values& H, const std::vector<std::vector<Eigen::Index>>& spaces,
                                       Search& search) {
  using Scalar = typename Values::Scalar;
  const auto count = static_cast<Eigen::Index>(spaces.size());
  const auto block = [&](Eigen::Index i, Eigen::Index j) {
    return Values(H(spaces[static_cast<std::size_t>(i)], spaces[static_cast<std::size_t>(j)]));
  };
  const double size = H.norm();
  // Coupled eigenspaces have their X in common; other groups are independent.
  const auto coupled = connected_groups(count, [&](Eigen::Index i, Eigen::Index j) {
    return block(i, j).norm() + block(j, i).norm() > search.zero() * size;
  });
  Values X = Values::Zero(H.rows(), H.cols());
  for (const auto& members : coupled) {
    std::vector<Eigen::Index> first(1, 0);  // of the unknowns of every space
    Eigen::Index rows = 0;
    for (const Eigen::Index i : members) {
      const auto m = static_cast<Eigen::Index>(spaces[static_cast<std::size_t>(i)].size());
      first.push_back(first.back() + m * m);
      rows += m;
    }
    const Eigen::Index unknowns = first.back();
    if (unknowns == static_cast<Eigen::Index>(members.size())) {
      // All eigenspaces have one dimension: X is a multiple of the unit matrix on them.
      const double value = random_number(search.random);
      for (const Eigen::Index i : members) {
        const Eigen::Index at = spaces[static_cast<std::size_t>(i)].front();
        X(at, at) = value;
      }
      continue;
    }
    if (unknowns > most_unknowns) return std::nullopt;
    // X_i H_ij - H_ij X_j = 0, column by column of every block.
    Values equations = Values::Zero(rows * rows, unknowns);
    Eigen::Index at = 0;
    for (std::size_t a = 0; a < members.size(); ++a) {
      for (std::size_t b = 0; b < members.size(); ++b) {
        const Values Hab = block(members[a], members[b]);
        const Eigen::Index ma = Hab.rows();
        const Eigen::Index mb = Hab.cols();
        for (Eigen::Index c = 0; c < mb; ++c) {
          for (Eigen::Index r = 0; r < ma; ++r, ++at) {
            for (Eigen::Index k = 0; k < ma; ++k) equations(at, first[a] + r + k * ma) += Hab(k, c);
            for (Eigen::Index k = 0; k < mb; ++k) equations(at, first[b] + k + c * mb) -= Hab(r, k);
          }
        }
      }
    }
    const auto right = right_singular_vectors(std::move(equations));
    if (!right.values.allFinite()) return std::nullopt;
    Eigen::Matrix<Scalar, Eigen::Dynamic, 1> x = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>::Zero(unknowns);
    for (Eigen::Index k = 0; k < unknowns; ++k) {
      if (k < right.values.size() && right.values[k] > search.zero() * size) continue;
      x += random_number(search.random) * right.V.col(k);
    }
    for (std::size_t a = 0; a < members.size(); ++a) {
      const auto& space = spaces[static_cast<std::size_t>(members[a])];
      const auto m = static_cast<Eigen::Index>(space.size());
      X(space, space) = x.segment(first[a], m * m).reshaped(m, m);
    }
  }
  return X;
}

/// Coordinates of parts in balanced coordinates: columns of `right` and `left`, part after part.
struct Splitting {
  Matrix right, left;
  std::vector<Eigen::Index> sizes;
  /// Per part, whether it belongs to a complex pair of eigenvalues of X. Then it is a complex pair of parts
  /// that no real coordinates separate, or two equal parts of which another X would tell.
  std::vector<bool> of_pair;
};

/// Whether all matrices are symmetric or skew-symmetric, up to rounding.
bool all_symmetric_or_skew(const std::vector<Matrix>& all, double magnified) {
  const double rounding = 1e-14 * magnified;
  return std::all_of(all.begin(), all.end(), [&](const Matrix& A) {
    const double size = rounding * A.norm();
    return (A - A.transpose()).norm() <= size || (A + A.transpose()).norm() <= size;
  });
}

/// The splitting of symmetric and skew-symmetric matrices, which keeps their symmetry: left = right. Empty if
/// no combination of them is found positive definite.
std::optional<Splitting> split_symmetric(const std::vector<Matrix>& all, Search& search) {
  const Eigen::Index n = all[0].rows();
  Matrix definite = Matrix::Zero(n, n);
  for (const Matrix& A : all) {
    const Matrix symmetric = 0.5 * (A + A.transpose());
    const Eigen::LLT<Matrix> alone(symmetric);
    if (symmetric.diagonal().minCoeff() >= 0.0 && alone.info() == Eigen::Success) definite += symmetric;
  }
  const Eigen::LLT<Matrix> cholesky(definite);
  if (definite.isZero(0.0) || cholesky.info() != Eigen::Success ||
      !(cholesky.rcond() > 1.0 / (worst * worst)))
    return std::nullopt;
  const auto reduced = [&](const Matrix& A) {
    const Matrix B = cholesky.matrixL().solve(A);
    return Matrix(cholesky.matrixL().solve(B.transpose()).transpose());
  };
  const Matrix some = random_combination(all, search.random);
  const Matrix G = reduced(0.5 * (some + some.transpose()));
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(Matrix(0.5 * (G + G.transpose())));
  const Matrix& V = eigen.eigenvectors();
  const ComplexVector values = eigen.eigenvalues().cast<Complex>();
  const Matrix H = V.transpose() * reduced(random_combination(all, search.random)) * V;
  const auto X =
      random_commuting(H, close_groups(values, possibly_equal * values.cwiseAbs().maxCoeff()), search);
  if (!X) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Matrix> parts(Matrix(0.5 * (*X + X->transpose())));
  const Vector& x = parts.eigenvalues();
  const Matrix Q = cholesky.matrixU().solve(V * parts.eigenvectors());
  Splitting result{Q, Q, {}, {}};
  const double apart = different * x.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i > 0 && x[i] - x[i - 1] <= apart) {
      ++result.sizes.back();
    } else {
      result.sizes.push_back(1);
    }
  }
  result.of_pair.assign(result.sizes.size(), false);
  return result;
}

/// Real orthonormal basis of the space of some columns and their conjugates; empty if it has not `size`
/// dimensions.
Matrix real_basis(const ComplexMatrix& columns, Eigen::Index size) {
  constexpr double dependent = 1e-6;
  Matrix parts(columns.rows(), 2 * columns.cols());
  parts << columns.real(), columns.imag();
  Eigen::ColPivHouseholderQR<Matrix> qr(parts);
  qr.setThreshold(dependent);
  if (qr.rank() != size) return {};
  return qr.householderQ() * Matrix::Identity(columns.rows(), size);
}

/// Orthonormal bases of the eigenspaces of G, one after the other, for groups of close eigenvalues. Computed
/// eigenvectors of equal eigenvalues may be nearly parallel; null vectors of G - s I are not. Empty if an
/// eigenspace has fewer dimensions than eigenvalues.
ComplexMatrix eigenspaces(const Matrix& G, const ComplexVector& values, const ComplexMatrix& vectors,
                          const std::vector<std::vector<Eigen::Index>>& groups) {
  const Eigen::Index n = G.rows();
  ComplexMatrix V(n, n);
  for (const auto& members : groups) {
    const auto size = static_cast<Eigen::Index>(members.size());
    if (size == 1) {
      V.col(members.front()) = vectors.col(members.front());
      continue;
    }
    const Complex mean = values(members).mean();
    ComplexMatrix shifted = G.cast<Complex>() - mean * ComplexMatrix::Identity(n, n);
    const auto right = right_singular_vectors(std::move(shifted));
    if (!right.values.allFinite() || right.values[n - size] > possibly_equal * G.norm()) return {};
    V(Eigen::all, members) = right.V.rightCols(size);
  }
  return V;
}

/// The splitting of any matrices. Empty if no combination of them is well-conditioned, or their eigenvectors
/// are not.
std::optional<Splitting> split_any(const std::vector<Matrix>& all, Search& search) {
  const Eigen::Index n = all[0].rows();
  const Eigen::PartialPivLU<Matrix> B(random_combination(all, search.random));
  if (!(B.rcond() > 1.0 / (worst * worst))) return std::nullopt;
  const Matrix G = B.solve(random_combination(all, search.random));
  const Eigen::EigenSolver<Matrix> eigen(G);
  if (eigen.info() != Eigen::Success) return std::nullopt;
  const ComplexVector values = eigen.eigenvalues();
  const auto spaces = close_groups(values, possibly_equal * values.cwiseAbs().maxCoeff());
  const ComplexMatrix V = eigenspaces(G, values, eigen.eigenvectors(), spaces);
  if (V.size() == 0) return std::nullopt;
  const Eigen::PartialPivLU<ComplexMatrix> lu(V);
  if (!(lu.rcond() > 1.0 / (worst * worst))) return std::nullopt;
  const Matrix other = B.solve(random_combination(all, search.random));
  const ComplexMatrix H = lu.solve(other.cast<Complex>() * V);
  const auto X = random_commuting(H, spaces, search);
  if (!X) return std::nullopt;
  const Matrix real_X = ((V * *X) * lu.inverse()).real();
  const Eigen::EigenSolver<Matrix> parts(real_X);
  if (parts.info() != Eigen::Success) return std::nullopt;
  // An eigenvalue and its conjugate belong to one real part.
  const ComplexVector& x = parts.eigenvalues();
  const double apart = different * x.cwiseAbs().maxCoeff();
  const auto groups = connected_groups(n, [&](Eigen::Index i, Eigen::Index j) {
    return std::min(std::abs(x[i] - x[j]), std::abs(x[i] - std::conj(x[j]))) <= apart;
  });
  Splitting result{Matrix(n, n), {}, {}, {}};
  Eigen::Index at = 0;
  for (const auto& members : groups) {
    const auto size = static_cast<Eigen::Index>(members.size());
    const Matrix basis = real_basis(parts.eigenvectors()(Eigen::all, members), size);
    if (basis.size() == 0) return std::nullopt;
    result.right.middleCols(at, size) = basis;
    result.sizes.push_back(size);
    result.of_pair.push_back(std::abs(x[members.front()].imag()) > apart);
    at += size;
  }
  const Eigen::PartialPivLU<Matrix> right(result.right);
  if (!(right.rcond() > 1.0 / worst)) return std::nullopt;
  // (B right)^-1 makes the rows independent, too. Orthonormal rows within a part keep sizes.
  const Matrix rows = B.solve(Matrix::Identity(n, n));
  result.left = right.solve(rows).transpose();
  at = 0;
  for (const Eigen::Index size : result.sizes) {
    const Matrix columns = result.left.middleCols(at, size);
    result.left.middleCols(at, size) = columns.householderQr().householderQ() * Matrix::Identity(n, size);
    at += size;
  }
  return result;
}

/// Whether the matrices are block diagonal in the coordinates of a splitting, up to rounding: as a whole, and
/// every entry compared with the terms it is the sum of. The second keeps a weak coupling of freedoms with
/// small entries, which is no rounding however large other entries are.
bool holds(const Splitting& splitting, const std::vector<Matrix>& all, double magnified) {
  // Of an entry, relative to the sum of the magnitudes of its terms.
  const double rounding = 1e-13 * magnified;
  const double size = std::max(splitting.left.norm() * splitting.right.norm(), 1.0);
  return std::all_of(all.begin(), all.end(), [&](const Matrix& A) {
    Matrix there = splitting.left.transpose() * A * splitting.right;
    const Matrix terms = splitting.left.cwiseAbs().transpose() * A.cwiseAbs() * splitting.right.cwiseAbs();
    Eigen::Index at = 0;
    for (const Eigen::Index m : splitting.sizes) {
      there.block(at, at, m, m).setZero();
      at += m;
    }
    return there.norm() <= magnified * no_coupling * size &&
           (there.cwiseAbs().array() <= rounding * terms.array()).all();
  });
}

/// The same splitting, with the parts of complex pairs of eigenvalues split once more where another X does
/// that.
Splitting refined(const Splitting& splitting, const std::vector<Matrix>& all, Search& search) {
  constexpr int tries = 8;  // a random real matrix of size two has complex eigenvalues in 3 of 10 cases
  Splitting result{splitting.right, splitting.left, {}, {}};
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < splitting.sizes.size(); ++i) {
    const Eigen::Index size = splitting.sizes[i];
    std::optional<Splitting> finer;
    if (splitting.of_pair[i] && size > 1) {
      const Matrix right = splitting.right.middleCols(at, size);
      const Matrix left = splitting.left.middleCols(at, size);
      std::vector<Matrix> own;
      for (const Matrix& A : all) own.emplace_back(left.transpose() * A * right);
      for (int attempt = 0; attempt < tries && (!finer || finer->sizes.size() < 2); ++attempt)
        finer = split_any(own, search);
      if (finer && (finer->sizes.size() < 2 || !holds(*finer, own, search.rounding))) finer.reset();
      if (finer) finer = refined(*finer, own, search);
      if (finer) {
        result.right.middleCols(at, size) = right * finer->right;
        result.left.middleCols(at, size) = left * finer->left;
      }
    }
    const std::vector<Eigen::Index> sizes = finer ? finer->sizes : std::vector<Eigen::Index>{size};
    result.sizes.insert(result.sizes.end(), sizes.begin(), sizes.end());
    at += size;
  }
  result.of_pair.assign(result.sizes.size(), false);
  return result;
}

/// The parts of matrices that no permutation makes block diagonal.
Splitting split_connected(const std::vector<Matrix>& all, Search& search) {
  const Eigen::Index n = all[0].rows();
  const Splitting whole{Matrix::Identity(n, n), Matrix::Identity(n, n), {n}, {false}};
  if (n == 1) return whole;
  const bool keeps_symmetry = all_symmetric_or_skew(all, search.rounding);
  // The coordinates of one X may be worse conditioned than those of another, and it may tell fewer parts.
  constexpr int attempts = 6;
  constexpr double generous = 1e3;
  Splitting best = whole;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    search.slack = attempt % 2 == 0 ? 1.0 : generous;
    std::optional<Splitting> found;
    if (keeps_symmetry) found = split_symmetric(all, search);
    if (!found) found = split_any(all, search);
    if (!found) continue;
    const bool is_one = found->sizes.size() == 1 && !found->of_pair[0];
    if (is_one && search.slack > 1.0) break;  // X is a multiple of the unit matrix
    if (is_one) continue;
    const Splitting finer = refined(*found, all, search);
    if (finer.sizes.size() == 1 || !holds(finer, all, search.rounding)) continue;
    if (finer.sizes.size() == best.sizes.size()) break;  // twice the same
    if (finer.sizes.size() > best.sizes.size()) best = finer;
  }
  return best;
}

/// The parts of any matrices. Coordinates that no entry connects come first: they are separated without
/// rounding.
Splitting split(const std::vector<Matrix>& all, double magnified) {
  constexpr std::uint64_t seed = 20101;  // the same coordinates in every run
  Search search{Random(seed), magnified};
  const Eigen::Index n = all[0].rows();
  Matrix pattern = Matrix::Zero(n, n);
  for (const Matrix& A : all) pattern += A.cwiseAbs();
  const auto connected = connected_groups(
      n, [&](Eigen::Index i, Eigen::Index j) { return pattern(i, j) != 0.0 || pattern(j, i) != 0.0; });
  Splitting result{Matrix::Zero(n, n), Matrix::Zero(n, n), {}, {}};
  Eigen::Index at = 0;
  for (const auto& members : connected) {
    std::vector<Matrix> own;
    for (const Matrix& A : all) {
      own.emplace_back(A(members, members));
      if (own.back().isZero(0.0)) own.pop_back();
    }
    const auto size = static_cast<Eigen::Index>(members.size());
    const Splitting finer =
        own.empty() ? Splitting{Matrix::Identity(size, size), Matrix::Identity(size, size), {size}, {false}}
                    : split_connected(own, search);
    result.right(members, Eigen::seqN(at, size)) = finer.right;
    result.left(members, Eigen::seqN(at, size)) = finer.left;
    result.sizes.insert(result.sizes.end(), finer.sizes.begin(), finer.sizes.end());
    at += size;
  }
  result.of_pair.assign(result.sizes.size(), false);
  return result;
}

/// For every part the first one that equals it up to a change of coordinates: random combinations of the
/// matrices have the same eigenvalues in both.
std::vector<std::size_t> copies(const Splitting& splitting, const std::vector<Matrix>& all,
                                double magnified) {
  // Relative difference of eigenvalues. Mistuning of 1e-10 makes different parts.
  constexpr double equal = 1e-12;
  constexpr std::uint64_t seed = 20102;
  Random random(seed);
  const Matrix B = random_combination(all, random);
  const Matrix G = random_combination(all, random);
  std::vector<ComplexVector> values;
  std::vector<std::size_t> first;
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < splitting.sizes.size(); ++i) {
    const Eigen::Index size = splitting.sizes[i];
    const auto right = splitting.right.middleCols(at, size);
    const auto left = splitting.left.middleCols(at, size);
    const Matrix own = (left.transpose() * B * right).partialPivLu().solve(left.transpose() * G * right);
    ComplexVector spectrum = Eigen::EigenSolver<Matrix>(own, false).eigenvalues();
    const double scale = spectrum.cwiseAbs().maxCoeff();
    const auto is_same = [&](const ComplexVector& other) {
      if (other.size() != size) return false;
      return std::all_of(other.begin(), other.end(), [&](Complex s) {
        return (spectrum.array() - s).abs().minCoeff() <=
               magnified * equal * static_cast<double>(size) * scale;
      });
    };
    first.push_back(
        static_cast<std::size_t>(std::find_if(values.begin(), values.end(), is_same) - values.begin()));
    values.push_back(std::move(spectrum));
    at += size;
  }
  return first;
}

/// Whether the entries of left^T A right are more than rounding, for any of the matrices; within the parts.
Matrix pattern_of(const std::vector<Matrix>& matrices, const IndependentParts& parts, double magnified) {
  // Of an entry, relative to the sum of the magnitudes of its terms.
  const double rounding = 1e-13 * magnified;
  const Eigen::Index n = parts.right.rows();
  Matrix pattern = Matrix::Zero(n, n);
  const Matrix left = parts.left.cwiseAbs().transpose();
  const Matrix right = parts.right.cwiseAbs();
  for (const Matrix& A : matrices) {
    const Matrix there = parts.left.transpose() * A * parts.right;
    const Matrix terms = left * A.cwiseAbs() * right;
    pattern = pattern.cwiseMax((there.cwiseAbs().array() > rounding * terms.array()).cast<double>().matrix());
  }
  Matrix within = Matrix::Zero(n, n);
  for (const IndependentParts::Range& range : parts.ranges)
    within.block(range.first, range.first, range.size, range.size).setOnes();
  return pattern.cwiseProduct(within);
}

std::shared_ptr<IndependentParts> find_parts(const CoefficientMatrices& coefficients, double magnified) {
  std::vector<Matrix> all;
  for (const auto* matrices : {&coefficients.M, &coefficients.C, &coefficients.K}) {
    for (const Matrix& A : *matrices) {
      if (A.size() > 0 && !A.isZero(0.0) && A.allFinite()) all.push_back(A);
    }
  }
  if (all.empty() || all[0].rows() < 2) return nullptr;
  const Eigen::Index n = all[0].rows();
  const Balance scaling = balance(coefficients, n);
  for (Matrix& A : all) {
    A = scaling.of(A);
    A /= A.norm();
  }
  const Splitting splitting = split(all, magnified);
  const bool falls_apart = splitting.sizes.size() > 1;
  const bool first_order = std::all_of(coefficients.M.begin(), coefficients.M.end(),
                                       [](const Matrix& M) { return M.size() == 0 || M.isZero(0.0); });
  if (!falls_apart && scaling.ratio() <= (first_order ? well_scaled_states : well_scaled)) return nullptr;
  auto parts = std::make_shared<IndependentParts>();
  parts->is_diagonal = !falls_apart;
  parts->right = scaling.columns.asDiagonal() * splitting.right;
  parts->left = scaling.rows.asDiagonal() * splitting.left;
  parts->inverse = splitting.right.inverse() * scaling.columns.cwiseInverse().asDiagonal();
  if (!falls_apart) {
    parts->ranges = {{0, n, 0}};
    parts->pattern_M = parts->pattern_C = parts->pattern_K = Matrix::Ones(n, n);
    return parts;
  }
  const std::vector<std::size_t> copy_of = copies(splitting, all, magnified);
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < copy_of.size(); ++i) {
    parts->ranges.push_back({first, splitting.sizes[i], copy_of[i]});
    first += splitting.sizes[i];
  }
  parts->pattern_M = pattern_of(coefficients.M, *parts, magnified);
  parts->pattern_C = pattern_of(coefficients.C, *parts, magnified);
  parts->pattern_K = pattern_of(coefficients.K, *parts, magnified);
  return parts;
}

/// T^T A T for all matrices. `magnified` is raised to how many times larger than the result the terms are
/// that cancel in it, up to a bound: beyond that, rounding would hide a coupling that matters. A result that
/// is nothing but rounding is zero.
std::vector<Matrix> projected(const std::vector<Matrix>& matrices, const Matrix& T, double& magnified) {
  constexpr double most = 100.0;
  constexpr double nothing = 1e-14;
  std::vector<Matrix> result;
  for (const Matrix& A : matrices) {
    result.emplace_back(T.transpose() * A * T);
    const double terms = (T.cwiseAbs().transpose() * A.cwiseAbs() * T.cwiseAbs()).norm();
    if (result.back().norm() <= nothing * terms) {
      result.back().setZero();
      continue;
    }
    magnified = std::clamp(terms / result.back().norm(), magnified, most);
  }
  return result;
}

}  // namespace

std::shared_ptr<const IndependentParts> find_independent_parts(const CoefficientMatrices& coefficients) {
  return find_parts(coefficients, 1.0);
}

std::shared_ptr<const IndependentParts> find_independent_parts(const CoefficientMatrices& coefficients,
                                                               const Matrix& T) {
  double magnified = 1.0;
  const CoefficientMatrices inner{projected(coefficients.M, T, magnified),
                                  projected(coefficients.C, T, magnified),
                                  projected(coefficients.K, T, magnified)};
  const auto within = find_parts(inner, magnified);
  if (within == nullptr || within->count() == 1) return nullptr;
  within->right = T * within->right;
  within->left = T * within->left;
  within->inverse = within->inverse * T.transpose();
  return within;
}

}  // namespace eigentrail
