#include "reduction/splitting.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/connected_groups.hpp"
#include "core/orthonormal.hpp"
#include "core/products.hpp"
#include "core/singular_vectors.hpp"
#include "eigentrail/core/complex_lu.hpp"

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

/// What a search for parts needs besides the matrices.
struct Search {
  Random random;
  /// Rounding of the matrices in units of their own: more than one where large terms cancel in their entries.
  double rounding = 1.0;
  /// How many times rounding may be magnified in the search for X by the condition of eigenvectors. What a
  /// generous search finds is tested like anything else.
  double slack = 1.0;
  /// An eigenspace was found that is too large for X. Others would be as large: a stiff system has many
  /// eigenvalues that are close to each other in relation to the largest.
  bool is_too_large = false;

  /// Largest share of a matrix that counts as zero.
  double zero() const { return rounding * slack * no_coupling; }
};

double random_number(Random& random) {
  return std::normal_distribution<double>()(random);
}

}  // namespace

Matrix random_combination(const std::vector<Matrix>& all, Random& random) {
  Matrix sum = Matrix::Zero(all[0].rows(), all[0].cols());
  for (const Matrix& A : all) sum += random_number(random) * A;
  return sum;
}

namespace {

Groups close_groups(const ComplexVector& values, double distance) {
  return connected_groups(values.size(), [&](Eigen::Index i, Eigen::Index j) {
    return std::abs(values[i] - values[j]) <= distance;
  });
}

/// The unknowns of X on coupled eigenspaces: m^2 for one of m dimensions. Those of one dimension that are
/// coupled with each other have one number in common.
struct UnknownsOfX {
  std::vector<Eigen::Index> first;  ///< of every space
  Eigen::Index count = 0;
};

template <class Coupling>
UnknownsOfX unknowns_of(const std::vector<Eigen::Index>& members, const std::vector<Eigen::Index>& sizes,
                        const Coupling& are_coupled) {
  const auto count = static_cast<Eigen::Index>(members.size());
  const auto size = [&](Eigen::Index i) { return sizes[static_cast<std::size_t>(i)]; };
  const auto common = connected_groups(count, [&](Eigen::Index i, Eigen::Index j) {
    return size(i) == 1 && size(j) == 1 &&
           are_coupled(members[static_cast<std::size_t>(i)], members[static_cast<std::size_t>(j)]);
  });
  UnknownsOfX unknowns{std::vector<Eigen::Index>(members.size()), 0};
  for (const auto& group : common) {
    for (const Eigen::Index i : group) unknowns.first[static_cast<std::size_t>(i)] = unknowns.count;
    unknowns.count += size(group.front()) * size(group.front());
  }
  return unknowns;
}

/// The eigenspaces of eigenvalues that may be equal. Empty, and noted in the search, if one of them has too
/// many unknowns in X by itself.
std::optional<Groups> eigenspace_groups(const ComplexVector& values, Search& search) {
  auto spaces = close_groups(values, possibly_equal * values.cwiseAbs().maxCoeff());
  search.is_too_large = std::any_of(spaces.begin(), spaces.end(), [](const auto& space) {
    return static_cast<Eigen::Index>(space.size() * space.size()) > most_unknowns;
  });
  if (search.is_too_large) return std::nullopt;
  return spaces;
}

/// A random X with X H = H X, block diagonal in the given groups of coordinates (eigenspaces of another
/// matrix with which X commutes). Empty if that costs too much.
template <class Values>
std::optional<Values> random_commuting(const Values& H, const Groups& spaces, Search& search) {
  using Scalar = typename Values::Scalar;
  const auto count = static_cast<Eigen::Index>(spaces.size());
  const auto block = [&](Eigen::Index i, Eigen::Index j) {
    return Values(H(spaces[static_cast<std::size_t>(i)], spaces[static_cast<std::size_t>(j)]));
  };
  const double size = H.norm();
  const auto are_coupled = [&](Eigen::Index i, Eigen::Index j) {
    return block(i, j).norm() + block(j, i).norm() > search.zero() * size;
  };
  Values X = Values::Zero(H.rows(), H.cols());
  // Coupled eigenspaces have their X in common; other groups are independent.
  for (const auto& members : connected_groups(count, are_coupled)) {
    std::vector<Eigen::Index> sizes;
    Eigen::Index in_all = 0, in_larger = 0;
    for (const Eigen::Index i : members) {
      sizes.push_back(static_cast<Eigen::Index>(spaces[static_cast<std::size_t>(i)].size()));
      in_all += sizes.back();
      if (sizes.back() > 1) in_larger += sizes.back();
    }
    const auto [first, unknowns] = unknowns_of(members, sizes, are_coupled);
    if (unknowns > most_unknowns) return std::nullopt;
    // X_i H_ij - H_ij X_j = 0, column by column of every block. Between two of one dimension it holds.
    Values equations = Values::Zero(in_larger * (2 * in_all - in_larger), unknowns);
    Eigen::Index at = 0;
    for (std::size_t a = 0; a < members.size(); ++a) {
      for (std::size_t b = 0; b < members.size(); ++b) {
        const Eigen::Index ma = sizes[a];
        const Eigen::Index mb = sizes[b];
        if (ma == 1 && mb == 1) continue;
        const Values Hab = block(members[a], members[b]);
        if (Hab.norm() <= search.zero() * size) continue;
        for (Eigen::Index c = 0; c < mb; ++c) {
          for (Eigen::Index r = 0; r < ma; ++r, ++at) {
            for (Eigen::Index k = 0; k < ma; ++k) equations(at, first[a] + r + k * ma) += Hab(k, c);
            for (Eigen::Index k = 0; k < mb; ++k) equations(at, first[b] + k + c * mb) -= Hab(r, k);
          }
        }
      }
    }
    const auto right = right_singular_vectors(Values(equations.topRows(at)));
    if (!right.values.allFinite()) return std::nullopt;
    Eigen::Matrix<Scalar, Eigen::Dynamic, 1> x = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>::Zero(unknowns);
    for (Eigen::Index k = 0; k < unknowns; ++k) {
      if (k < right.values.size() && right.values[k] > search.zero() * size) continue;
      x += random_number(search.random) * right.V.col(k);
    }
    for (std::size_t a = 0; a < members.size(); ++a) {
      const auto& space = spaces[static_cast<std::size_t>(members[a])];
      X(space, space) = x.segment(first[a], sizes[a] * sizes[a]).reshaped(sizes[a], sizes[a]);
    }
  }
  return X;
}

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
  const auto spaces = eigenspace_groups(values, search);
  if (!spaces) return std::nullopt;
  const Matrix H = V.transpose() * reduced(random_combination(all, search.random)) * V;
  const auto X = random_commuting(H, *spaces, search);
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
  return columns_of_Q(qr, size);
}

/// Orthonormal basis of the space of the `size` eigenvalues of G next to s, by inverse iteration: the
/// eigenvalues of a group are equal up to rounding, so that few passes are enough. Empty if it is not finite.
ComplexMatrix invariant_space(const Matrix& G, Complex s, Eigen::Index size, Random& random) {
  constexpr int passes = 3;
  // As far from the eigenvalue as rounding: exactly on it the factors are singular.
  const double beside = 1e-14 * G.norm();
  const Eigen::Index n = G.rows();
  const ComplexLu lu(G.cast<Complex>() - (s + beside) * ComplexMatrix::Identity(n, n));
  ComplexMatrix space = ComplexMatrix::NullaryExpr(n, size, [&] { return Complex(random_number(random)); });
  for (int i = 0; i < passes; ++i) {
    lu.solve_in_place(space);
    if (!space.allFinite()) return {};
    space = orthonormal(space);
  }
  return space;
}

/// Orthonormal bases of the eigenspaces of G, one after the other, for groups of close eigenvalues. Computed
/// eigenvectors of equal eigenvalues may be nearly parallel; a basis of their invariant space is not. Empty
/// if an eigenspace has fewer dimensions than eigenvalues.
ComplexMatrix eigenspaces(const Matrix& G, const ComplexVector& values, const ComplexMatrix& vectors,
                          const Groups& groups, Random& random) {
  const Eigen::Index n = G.rows();
  ComplexMatrix V(n, n);
  for (const auto& members : groups) {
    const auto size = static_cast<Eigen::Index>(members.size());
    if (size == 1) {
      V.col(members.front()) = vectors.col(members.front());
      continue;
    }
    const Complex mean = values(members).mean();
    const ComplexMatrix space = invariant_space(G, mean, size, random);
    if (space.size() == 0 || (product(G, space) - mean * space).norm() > possibly_equal * G.norm()) return {};
    V(Eigen::all, members) = space;
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
  const auto spaces = eigenspace_groups(values, search);
  if (!spaces) return std::nullopt;
  const ComplexMatrix V = eigenspaces(G, values, eigen.eigenvectors(), *spaces, search.random);
  if (V.size() == 0) return std::nullopt;
  const Eigen::PartialPivLU<ComplexMatrix> lu(V);
  if (!(lu.rcond() > 1.0 / (worst * worst))) return std::nullopt;
  const Matrix other = B.solve(random_combination(all, search.random));
  const ComplexMatrix H = lu.solve(product(other, V));
  const auto X = random_commuting(H, *spaces, search);
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
    result.left.middleCols(at, size) = orthonormal(Matrix(result.left.middleCols(at, size)));
    at += size;
  }
  return result;
}

}  // namespace

Matrix without_rounding_of_columns(Matrix coordinates) {
  constexpr double rounding = 2e-15;
  for (auto column : coordinates.colwise()) {
    const double least = rounding * column.cwiseAbs().maxCoeff();
    column = (column.array().abs() > least).select(column, 0.0).eval();
  }
  return coordinates;
}

double largest_coupling(double magnified) {
  return magnified * no_coupling;
}

namespace {

/// Whether the matrices are block diagonal in the coordinates of a splitting, up to rounding: as a whole, and
/// every entry compared with the terms it is the sum of. The second keeps a weak coupling of freedoms with
/// small entries, which is no rounding however large other entries are.
bool holds(const Splitting& splitting, const std::vector<Matrix>& all, double magnified) {
  const double size = std::max(splitting.left.norm() * splitting.right.norm(), 1.0);
  const double of_entries = magnified_by(splitting, magnified);
  return std::all_of(all.begin(), all.end(), [&](const Matrix& A) {
    Matrix there = congruence(splitting.left, A, splitting.right);
    const Matrix rounding = rounding_of_entries(splitting.left, A, splitting.right, of_entries);
    Eigen::Index at = 0;
    for (const Eigen::Index m : splitting.sizes) {
      there.block(at, at, m, m).setZero();
      at += m;
    }
    return there.norm() <= largest_coupling(magnified) * size &&
           (there.cwiseAbs().array() <= rounding.array()).all();
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
    search.is_too_large = false;
    std::optional<Splitting> found;
    if (keeps_symmetry) found = split_symmetric(all, search);
    if (!found && !search.is_too_large) found = split_any(all, search);
    if (search.is_too_large) break;
    if (!found) continue;
    const bool is_one = found->sizes.size() == 1 && !found->of_pair[0];
    if (is_one && search.slack > 1.0) break;  // X is a multiple of the unit matrix
    if (is_one) continue;
    Splitting finer = refined(*found, all, search);
    finer.right = without_rounding_of_columns(std::move(finer.right));
    finer.left = without_rounding_of_columns(std::move(finer.left));
    if (finer.sizes.size() == 1 || !holds(finer, all, search.rounding)) continue;
    if (finer.sizes.size() == best.sizes.size()) break;  // twice the same
    if (finer.sizes.size() > best.sizes.size()) best = finer;
  }
  return best;
}

}  // namespace

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
  return result;
}

double magnified_by(const Splitting& splitting, double magnified) {
  const double rcond = Eigen::PartialPivLU<Matrix>(splitting.right).rcond();
  return rcond > 0.0 ? magnified / rcond : magnified;
}

Matrix rounding_of_entries(const Matrix& left, const Matrix& A, const Matrix& right, double magnified) {
  constexpr double rounding = 1e-13;
  return magnified * rounding * magnitudes_of_terms(left, A, right);
}

Matrix pattern_of_entries(const Matrix& left, const std::vector<Matrix>& matrices, const Matrix& right,
                          double magnified) {
  Matrix pattern = Matrix::Zero(left.cols(), right.cols());
  for (const Matrix& A : matrices) {
    const Matrix there = congruence(left, A, right).cwiseAbs();
    const Matrix rounding = rounding_of_entries(left, A, right, magnified);
    pattern = pattern.cwiseMax((there.array() > rounding.array()).cast<double>().matrix());
  }
  return pattern;
}

}  // namespace eigentrail
