#include "eigentrail/modes/symmetric_pairs.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "modes/real_blocks.hpp"

namespace eigentrail {
namespace {

constexpr double least_mass = 1e-12;         ///< of a mode, relative to |M| |x|^2
constexpr double largest_asymmetry = 1e-10;  ///< of M and K, relative: rounding of what is symmetric
constexpr double largest_change = 0.3;  ///< of a vector: beyond, it is not known whose correction this is
constexpr double largest_drift = 0.1;   ///< of the eigenvalues of a start, relative
constexpr double least_frequency =
    1.0;  ///< of an oscillation followed without its conjugate, over the reference

bool is_symmetric(const Matrix& B, double norm) {
  return (B - B.transpose()).norm() <= largest_asymmetry * norm;
}

/// The starts as modes of the real pencil; empty where they are not all of them, or of another kind.
std::optional<SymmetricPairs> real_modes(const std::vector<InvariantPair>& starts, Eigen::Index n,
                                         double reference) {
  SymmetricPairs pairs;
  pairs.X.resize(n, n);
  Eigen::Index first = 0;
  for (const InvariantPair& start : starts) {
    const std::optional<Root> root = root_of(start);
    if (!root) return std::nullopt;
    const Eigen::Index size = *root == Root::both ? start.size() / 2 : start.size();
    if (first + size > n) return std::nullopt;
    const std::optional<Matrix> X = real_basis(start.Z, size);
    if (!X) return std::nullopt;
    pairs.X.middleCols(first, size) = *X;
    ComplexMatrix Z = start.Z;
    ComplexMatrix Lambda = start.Lambda;
    pairs.blocks.push_back({first, size, *root, {}});
    normalize_pair(Z, Lambda, pairs.blocks.back().W, reference);
    first += size;
  }
  if (first != n) return std::nullopt;
  return pairs;
}

/// The current vectors with their products.
struct Products {
  Matrix MX, KX;
};

/// Makes the vectors of a block M-orthonormal and L diagonal (Rayleigh-Ritz within the block).
bool settle(const RealBlock& block, double norm_M, SymmetricPairs& pairs, Products& products) {
  auto X = pairs.X.middleCols(block.first, block.size);
  auto MX = products.MX.middleCols(block.first, block.size);
  auto KX = products.KX.middleCols(block.first, block.size);
  auto lambda = pairs.lambda.segment(block.first, block.size);
  const Matrix mass = X.transpose() * MX;
  const Matrix stiffness = X.transpose() * KX;
  if (!mass.allFinite() || !stiffness.allFinite()) return false;
  const Eigen::SelfAdjointEigenSolver<Matrix> masses(mass, Eigen::EigenvaluesOnly);
  if (!(masses.eigenvalues()[0] > least_mass * norm_M * X.squaredNorm())) return false;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> ritz(stiffness, mass);
  if (ritz.info() != Eigen::Success) return false;
  lambda = -ritz.eigenvalues();
  X = (X * ritz.eigenvectors()).eval();
  MX = (MX * ritz.eigenvectors()).eval();
  KX = (KX * ritz.eigenvectors()).eval();
  return true;
}

bool settle(const PencilAtPoint& pencil, SymmetricPairs& pairs, Products& products) {
  products.MX.noalias() = pencil.M * pairs.X;
  products.KX.noalias() = pencil.K * pairs.X;
  pairs.lambda.resize(pairs.X.cols());
  return std::all_of(pairs.blocks.begin(), pairs.blocks.end(),
                     [&](const RealBlock& block) { return settle(block, pencil.norm_M, pairs, products); });
}

Matrix residual(const SymmetricPairs& pairs, const Products& products) {
  return products.KX + products.MX * pairs.lambda.asDiagonal();
}

/// Whether a correction of relative size `size` after one of size `last` leaves an error below the tolerance:
/// it is proportional to the square of the one before.
bool suffices(double size, double last, double tolerance) {
  if (size <= tolerance) return true;
  if (!std::isfinite(last)) return false;
  const double ratio = size / last;
  return ratio * ratio * size <= 0.1 * tolerance || (ratio > 0.5 && size < 1e-10);
}

/// Newton's method; lambda and the products are those of the vectors it ends with.
bool newton(const PencilAtPoint& pencil, const CorrectorOptions& options, SymmetricPairs& pairs,
            Products& products, ModeCounts& counts) {
  double last = INFINITY;
  for (int i = 0; i < options.max_iterations; ++i) {
    if (!settle(pencil, pairs, products)) return false;
    Matrix E = pairs.X.transpose() * residual(pairs, products);
    E = E.cwiseProduct(pairs.divisors());
    const Matrix change = pairs.X * E;
    const double size =
        std::sqrt(change.colwise().squaredNorm().cwiseQuotient(pairs.X.colwise().squaredNorm()).maxCoeff());
    counts.modal_solves += 1;
    counts.iterations += pairs.blocks.size();
    if (!change.allFinite() || size > largest_change || size > 2.0 * last) return false;
    pairs.X += change;
    if (suffices(size, last, options.tolerance)) return settle(pencil, pairs, products);
    last = size;
  }
  return false;
}

/// The pair of a block at the point; R holds the residuals of all modes.
InvariantPair pair_of(const PencilAtPoint& pencil, const SymmetricPairs& pairs, const RealBlock& block,
                      const Matrix& R, double reference) {
  const Matrix X = pairs.X.middleCols(block.first, block.size);
  const Vector lambda = pairs.lambda.segment(block.first, block.size);
  PairSeries values = pair_series(block.root, {{X}, {Matrix(lambda.asDiagonal())}}, block.W);
  InvariantPair pair;
  pair.status = PairStatus::converged;
  pair.is_real = block.root == Root::both;
  pair.Z = std::move(values.Z[0]);
  pair.Lambda = std::move(values.Lambda[0]);
  pair.W = block.W;
  const double size = pair.Lambda.norm() / std::sqrt(static_cast<double>(pair.size()));
  const double scale = pencil.magnitude(size) * pair.Z.norm();
  // Z = X T, and so is what remains of the equations.
  const double rest = pair.Z.norm() * R.middleCols(block.first, block.size).norm() / X.norm();
  pair.backward_error = scale > 0.0 ? rest / scale : 0.0;
  pair.condition = sensitivity(block.root, X, lambda, block.W) * scale / std::max(size, reference);
  return pair;
}

/// Whether a corrected pair still is the predicted one.
bool stays(const InvariantPair& start, const InvariantPair& pair, double reference) {
  const double k = static_cast<double>(pair.size());
  const double moved = std::abs(pair.Lambda.trace() - start.Lambda.trace()) / k;
  return moved <= largest_drift * std::max(pair.Lambda.norm() / std::sqrt(k), reference);
}

}  // namespace

Matrix SymmetricPairs::divisors() const {
  const Eigen::Index n = lambda.size();
  Matrix result = (lambda.replicate(1, n) - lambda.transpose().replicate(n, 1)).cwiseInverse();
  for (const RealBlock& block : blocks)
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
    const RealBlock& block = pairs->blocks[i];
    const double highest = pairs->lambda.segment(block.first, block.size).maxCoeff();
    const double least = least_frequency * reference;
    if (block.root == Root::imaginary && !(highest < -least * least)) return nullptr;
    corrected.push_back(pair_of(pencil, *pairs, block, R, reference));
    if (!stays(starts[i], corrected.back(), reference)) return nullptr;
  }
  return std::make_shared<const SymmetricPairs>(std::move(*pairs));
}

}  // namespace eigentrail
