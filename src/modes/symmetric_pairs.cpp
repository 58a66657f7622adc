#include "eigentrail/modes/symmetric_pairs.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/connected_groups.hpp"
#include "core/products.hpp"
#include "modes/real_blocks.hpp"

namespace eigentrail {
namespace {

constexpr double least_mass = 1e-12;  ///< smallest v^T M v of a mode, relative to |M| |v|^2
/// Relative asymmetry of M and K up to which it counts as rounding.
constexpr double largest_asymmetry = 1e-10;
/// Relative change of a vector; beyond it the correction may lead to another mode.
constexpr double largest_change = 0.3;
/// Entry of E above which two vectors count as mixing; they are then treated together.
constexpr double largest_turn = 0.1;
/// Relative change of the eigenvalues from the start; beyond it the mode may be another one.
constexpr double largest_drift = 0.1;

bool is_symmetric(const Matrix& B, double norm) {
  return (B - B.transpose()).norm() <= largest_asymmetry * norm;
}

/// The block of the positive roots whose negatives the pair `negative` follows, if it is not yet taken.
std::optional<std::size_t> mirrored(const std::vector<InvariantPair>& starts, std::size_t negative,
                                    const SymmetricPairs& pairs, std::vector<bool>& taken) {
  std::optional<std::size_t> nearest;
  double distance = largest_drift * starts[negative].Lambda.norm();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (taken[i] || pairs.pairs[i].root != Root::positive || starts[i].size() != starts[negative].size())
      continue;
    const double apart = std::abs(starts[i].Lambda.trace() + starts[negative].Lambda.trace());
    if (apart > distance) continue;
    distance = apart;
    nearest = i;
  }
  if (!nearest) return std::nullopt;
  taken[*nearest] = true;
  return pairs.pairs[*nearest].block;
}

/// Gives every pair of negative roots the block of its positive roots; false if there is none.
bool share_blocks(const std::vector<InvariantPair>& starts, SymmetricPairs& pairs) {
  std::vector<bool> taken(starts.size(), false);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (pairs.pairs[i].root != Root::negative) continue;
    const std::optional<std::size_t> block = mirrored(starts, i, pairs, taken);
    if (!block) return false;
    pairs.pairs[i].block = *block;
  }
  return true;
}

/// The starts as modes of the real pencil; empty if they are not all modes or if the method does not apply.
std::optional<SymmetricPairs> real_modes(const std::vector<InvariantPair>& starts, Eigen::Index n,
                                         double reference) {
  SymmetricPairs pairs;
  pairs.X.resize(n, n);
  Eigen::Index first = 0;
  for (const InvariantPair& start : starts) {
    const std::optional<Root> root = root_of(start);
    if (!root) return std::nullopt;
    pairs.pairs.push_back({pairs.blocks.size(), *root, {}});
    ComplexMatrix Z = start.Z;
    ComplexMatrix Lambda = start.Lambda;
    normalize_pair(Z, Lambda, pairs.pairs.back().W, reference);
    if (*root == Root::negative) continue;
    const Eigen::Index size = *root == Root::both ? start.size() / 2 : start.size();
    const std::optional<Matrix> X = first + size <= n ? real_basis(start.Z, size) : std::nullopt;
    if (!X) return std::nullopt;
    pairs.X.middleCols(first, size) = *X;
    pairs.blocks.push_back({first, size});
    first += size;
  }
  if (first != n || !share_blocks(starts, pairs)) return std::nullopt;
  return pairs;
}

/// Products of M and K with the current vectors.
struct Products {
  Matrix MX, KX;
};

using Columns = std::vector<Eigen::Index>;

/// Scales one vector to unit mass; lambda becomes its Rayleigh quotient.
bool settle_one(Eigen::Index column, double norm_M, SymmetricPairs& pairs, Products& products) {
  auto x = pairs.X.col(column);
  const double mass = x.dot(products.MX.col(column));
  if (!(mass > least_mass * norm_M * x.squaredNorm()) || !std::isfinite(mass)) return false;
  pairs.lambda[column] = -x.dot(products.KX.col(column)) / mass;
  const double scale = 1.0 / std::sqrt(mass);
  x *= scale;
  products.MX.col(column) *= scale;
  products.KX.col(column) *= scale;
  return true;
}

/// Order of the columns of V in which every column is closest to the old vector at its place; also changes
/// signs of columns accordingly.
Columns closest_order(Matrix& V) {
  Columns order(static_cast<std::size_t>(V.cols()));
  Matrix overlaps = V.cwiseAbs();
  for (Eigen::Index i = 0; i < V.cols(); ++i) {
    Eigen::Index old = 0, now = 0;
    overlaps.maxCoeff(&old, &now);
    if (V(old, now) < 0.0) V.col(now) *= -1.0;
    order[static_cast<std::size_t>(old)] = now;
    overlaps.row(old).setConstant(-1.0);
    overlaps.col(now).setConstant(-1.0);
  }
  return order;
}

/// Makes several vectors M-orthonormal and their L diagonal (Rayleigh-Ritz).
bool settle(const Columns& columns, double norm_M, SymmetricPairs& pairs, Products& products) {
  if (columns.size() == 1) return settle_one(columns[0], norm_M, pairs, products);
  const Matrix X = pairs.X(Eigen::all, columns);
  const Matrix MX = products.MX(Eigen::all, columns);
  const Matrix KX = products.KX(Eigen::all, columns);
  const Matrix mass = X.transpose() * MX;
  if (!mass.allFinite()) return false;
  const Eigen::SelfAdjointEigenSolver<Matrix> masses(mass, Eigen::EigenvaluesOnly);
  if (!(masses.eigenvalues()[0] > least_mass * norm_M * X.squaredNorm())) return false;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> ritz(X.transpose() * KX, mass);
  if (ritz.info() != Eigen::Success) return false;
  Matrix V = ritz.eigenvectors();
  const Columns order = closest_order(V);
  V = V(Eigen::all, order).eval();
  pairs.lambda(columns) = -ritz.eigenvalues()(order);
  pairs.X(Eigen::all, columns) = X * V;
  products.MX(Eigen::all, columns) = MX * V;
  products.KX(Eigen::all, columns) = KX * V;
  return true;
}

bool settle(const PencilAtPoint& pencil, SymmetricPairs& pairs, Products& products) {
  products.MX = product(pencil.M, pairs.X);
  products.KX = product(pencil.K, pairs.X);
  pairs.lambda.resize(pairs.X.cols());
  return std::all_of(pairs.blocks.begin(), pairs.blocks.end(), [&](const SymmetricPairs::Block& block) {
    Columns columns(static_cast<std::size_t>(block.size));
    std::iota(columns.begin(), columns.end(), block.first);
    return settle(columns, pencil.norm_M, pairs, products);
  });
}

Matrix residual(const SymmetricPairs& pairs, const Products& products) {
  return products.KX + products.MX * pairs.lambda.asDiagonal();
}

/// Whether a correction of relative size `size`, after one of size `last`, leaves an error below the
/// tolerance. The convergence is quadratic: the next correction has the size (size / last)^2 size.
bool suffices(double size, double last, double tolerance) {
  if (size <= tolerance) return true;
  if (!std::isfinite(last)) return false;
  const double ratio = size / last;
  return ratio * ratio * size <= 0.1 * tolerance || (ratio > 0.5 && size < 1e-10);
}

/// Groups of columns that mix strongly in a first-order correction: close modes with a prediction error
/// larger than their distance.
std::vector<Columns> turning(const Matrix& E) {
  Groups members = connected_groups(E.cols(), [&](Eigen::Index a, Eigen::Index b) {
    return std::max(std::abs(E(a, b)), std::abs(E(b, a))) > largest_turn;
  });
  std::erase_if(members, [](const Columns& columns) { return columns.size() < 2; });
  return members;
}

Matrix correction(const SymmetricPairs& pairs, const Products& products) {
  const Matrix G = transposed_product(pairs.X, residual(pairs, products));
  return G.cwiseProduct(pairs.divisors());
}

/// Newton's method. lambda and the products belong to the final vectors.
bool newton(const PencilAtPoint& pencil, const CorrectorOptions& options, SymmetricPairs& pairs,
            Products& products, ModeCounts& counts) {
  double last = INFINITY;
  for (int i = 0; i < options.max_iterations; ++i) {
    if (!settle(pencil, pairs, products)) return false;
    Matrix E = correction(pairs, products);
    const std::vector<Columns> groups = turning(E);
    for (const Columns& columns : groups)
      if (!settle(columns, pencil.norm_M, pairs, products)) return false;
    if (!groups.empty()) E = correction(pairs, products);
    const Matrix change = product(pairs.X, E);
    const double size =
        std::sqrt(change.colwise().squaredNorm().cwiseQuotient(pairs.X.colwise().squaredNorm()).maxCoeff());
    counts.modal_solves += 1;
    counts.iterations += pairs.pairs.size();
    if (!change.allFinite() || size > largest_change || size > 2.0 * last) return false;
    pairs.X += change;
    if (suffices(size, last, options.tolerance)) return settle(pencil, pairs, products);
    last = size;
  }
  return false;
}

/// Whether lambda of the modes of a pair has the sign that its root requires. Modes with lambda near zero
/// must be followed with both roots.
bool has_root(Root root, const Vector& lambda, double reference) {
  const double least = reference * reference;
  if (root == Root::imaginary) return lambda.maxCoeff() < -least;
  return root == Root::both || lambda.minCoeff() > least;
}

/// A pair at the point; R (n x k) is the residual of its modes.
InvariantPair pair_of(const PencilAtPoint& pencil, const SymmetricPairs::Pair& of, const Matrix& X,
                      const Vector& lambda, const Matrix& R, double reference) {
  PairSeries values = pair_series(of.root, {{X}, {Matrix(lambda.asDiagonal())}}, of.W);
  InvariantPair pair;
  pair.status = PairStatus::converged;
  pair.is_real = of.root != Root::imaginary;
  pair.Z = std::move(values.Z[0]);
  pair.Lambda = std::move(values.Lambda[0]);
  pair.W = of.W;
  // Z = X T with a matrix T, so the residual of the pair scales with |Z| / |X|.
  settle_accuracy(pencil, pair.Z.norm() * R.norm() / X.norm(),
                  sensitivity(of.root, X, lambda, of.W, pencil.terms(pair.Z, pair.Lambda)), reference, pair);
  return pair;
}

/// Whether a corrected pair is still the predicted one.
bool stays(const InvariantPair& start, const InvariantPair& pair, double reference) {
  const double k = static_cast<double>(pair.size());
  const double moved = std::abs(pair.Lambda.trace() - start.Lambda.trace()) / k;
  return moved <= largest_drift * std::max(pair.Lambda.norm() / std::sqrt(k), reference);
}

}  // namespace

Matrix SymmetricPairs::divisors() const {
  const Eigen::Index n = lambda.size();
  Matrix result = (lambda.replicate(1, n) - lambda.transpose().replicate(n, 1)).cwiseInverse();
  for (const SymmetricPairs::Block& block : blocks)
    result.block(block.first, block.first, block.size, block.size).setZero();
  return result;
}

std::shared_ptr<const SymmetricPairs> correct_symmetric(const PencilAtPoint& pencil,
                                                        const std::vector<InvariantPair>& starts,
                                                        double reference, const CorrectorOptions& options,
                                                        ModeCounts& counts,
                                                        std::vector<InvariantPair>& corrected) {
  if (!pencil.is_undamped() || !is_symmetric(pencil.M, pencil.norm_M) ||
      !is_symmetric(pencil.K, pencil.norm_K))
    return nullptr;
  std::optional<SymmetricPairs> pairs = real_modes(starts, pencil.size(), reference);
  Products products;
  if (!pairs || !newton(pencil, options, *pairs, products, counts)) return nullptr;
  ++counts.modal_bases;
  const Matrix R = residual(*pairs, products);
  corrected.clear();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const SymmetricPairs::Pair& pair = pairs->pairs[i];
    const SymmetricPairs::Block& block = pairs->blocks[pair.block];
    const Vector lambda = pairs->lambda.segment(block.first, block.size);
    if (!has_root(pair.root, lambda, reference)) return nullptr;
    corrected.push_back(pair_of(pencil, pair, pairs->X.middleCols(block.first, block.size), lambda,
                                R.middleCols(block.first, block.size), reference));
    if (!stays(starts[i], corrected.back(), reference)) return nullptr;
  }
  return std::make_shared<const SymmetricPairs>(std::move(*pairs));
}

namespace {

/// X^T B_i X for the coefficients i >= 1; empty matrices if B_i is zero.
std::vector<Matrix> in_modes(const MatrixSeries& B, const Matrix& X, std::size_t count) {
  std::vector<Matrix> result(count);
  for (std::size_t i = 1; i < count && i < B.size(); ++i) {
    if (!B[i].isZero(0.0)) result[i] = transposed_product(X, product(B[i], X));
  }
  return result;
}

/// Coefficients E_j of X(h) = X E(h), L_j of the blocks and N_j of N(h) = X^T M(h) X E(h), computed order by
/// order. E_j is zero within the blocks for j > 0: the pairs are normalized afterwards.
class ModalSeries {
 public:
  ModalSeries(const ReducedPencil& pencil, const SymmetricPairs& pairs, std::size_t count)
      : pairs_(pairs),
        divisors_(pairs.divisors()),
        M_(in_modes(pencil.M, pairs.X, count)),
        K_(in_modes(pencil.K, pairs.X, count)),
        E_{Matrix::Identity(pairs.X.cols(), pairs.X.cols())},
        N_{E_[0]},
        L_{pairs.lambda.asDiagonal()} {
    for (std::size_t j = 1; j < count; ++j) append(j);
  }

  /// Coefficient j of all vectors, n x n.
  Matrix vectors(std::size_t j) const { return j == 0 ? pairs_.X : product(pairs_.X, E_[j]); }

  Matrix of_block(const SymmetricPairs::Block& block, std::size_t j) const {
    return L_[j].block(block.first, block.first, block.size, block.size);
  }

 private:
  void append(std::size_t j) {
    const Matrix inertia = sum_of(M_, j);
    Matrix known = sum_of(K_, j) + inertia * pairs_.lambda.asDiagonal();
    Matrix L = Matrix::Zero(known.rows(), known.cols());
    for (const SymmetricPairs::Block& block : pairs_.blocks) {
      auto columns = known.middleCols(block.first, block.size);
      for (std::size_t i = 1; i < j; ++i)
        columns += N_[j - i].middleCols(block.first, block.size) * of_block(block, i);
      L.block(block.first, block.first, block.size, block.size) =
          -columns.middleRows(block.first, block.size);
    }
    E_.emplace_back(known.cwiseProduct(divisors_));
    N_.emplace_back(E_[j] + inertia);
    L_.push_back(std::move(L));
  }

  /// Coefficient j of B(h) E(h) without the term B_0 E_j.
  Matrix sum_of(const std::vector<Matrix>& B, std::size_t j) const {
    Matrix sum = j < B.size() && B[j].size() > 0 ? B[j] : Matrix(Matrix::Zero(E_[0].rows(), E_[0].cols()));
    for (std::size_t i = 1; i < j; ++i) {
      if (B[i].size() > 0) sum += product(B[i], E_[j - i]);
    }
    return sum;
  }

  const SymmetricPairs& pairs_;
  Matrix divisors_;
  std::vector<Matrix> M_, K_, E_, N_, L_;
};

}  // namespace

std::vector<PairSeries> differentiate_symmetric(const ReducedPencil& pencil, const SymmetricPairs& pairs,
                                                int order, ModeCounts& counts) {
  const auto count = static_cast<std::size_t>(order) + 1;
  const ModalSeries series(pencil, pairs, count);
  counts.modal_solves += count - 1;
  std::vector<Matrix> X;
  for (std::size_t j = 0; j < count; ++j) X.push_back(series.vectors(j));
  std::vector<PairSeries> result;
  for (const SymmetricPairs::Pair& pair : pairs.pairs) {
    const SymmetricPairs::Block& block = pairs.blocks[pair.block];
    RealSeries modes;
    for (std::size_t j = 0; j < count; ++j) {
      modes.X.emplace_back(X[j].middleCols(block.first, block.size));
      modes.L.push_back(series.of_block(block, j));
    }
    result.push_back(pair_series(pair.root, modes, pair.W));
  }
  return result;
}

}  // namespace eigentrail
