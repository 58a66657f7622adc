// Conjugate pairs of complex parts (see complex_blocks.hpp and independent_parts.hpp).
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/connected_groups.hpp"
#include "core/products.hpp"
#include "eigentrail/reduction/complex_blocks.hpp"
#include "eigentrail/reduction/independent_parts.hpp"
#include "reduction/splitting.hpp"

namespace eigentrail {
namespace {

/// Distance of eigenvalues of a random combination, relative to the largest one, from which they are
/// different. Those of a conjugate pair of parts are all different, as the combination is random.
constexpr double told_apart = 1e-6;
/// Couplings of eigenvectors up to this share of the largest one are taken for rounding. What is found is
/// tested; a larger value overlooks parts whose only connections are weaker.
constexpr double weak = 1e-7;
/// Largest condition number of canonical coordinates.
constexpr double worst_condition = 1e4;

/// Canonical coordinates of one part.
struct Canonical {
  Matrix right, left;  ///< 2m x 2m
};

/// A part with its matrices.
struct PartMatrices {
  Matrix left, right;         ///< n x 2m
  std::vector<Matrix> given;  ///< n x n, in units of the norms that they have in the part
  std::vector<Matrix> own;    ///< left^T A right of the given ones, of norm one
};

/// Matrices that are nothing but rounding in the part are left out.
PartMatrices matrices_of_part(const CoefficientMatrices& coefficients, Matrix left, Matrix right) {
  constexpr double nothing = 1e-13;
  PartMatrices part{std::move(left), std::move(right), {}, {}};
  for (const auto* matrices : {&coefficients.M, &coefficients.C, &coefficients.K}) {
    for (const Matrix& A : *matrices) {
      if (A.size() == 0 || !A.allFinite()) continue;
      const Matrix here = part.left.transpose() * A * part.right;
      const double size = here.norm();
      if (!(size > nothing * magnitudes_of_terms(part.left, A, part.right).norm())) continue;
      part.given.emplace_back(A / size);
      part.own.emplace_back(here / size);
    }
  }
  return part;
}

/// Indices that are connected with the first one by entries of H.
std::vector<Eigen::Index> connected_with_first(const ComplexMatrix& H) {
  const double least = weak * H.cwiseAbs().maxCoeff();
  const Groups groups = connected_groups(H.rows(), [&](Eigen::Index i, Eigen::Index j) {
    return std::max(std::abs(H(i, j)), std::abs(H(j, i))) > least;
  });
  return *std::find_if(groups.begin(), groups.end(),
                       [](const auto& members) { return members.front() == 0; });
}

/// Whether all eigenvalues are different from each other and from the real axis.
bool are_different(const ComplexVector& values) {
  const double apart = told_apart * values.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (std::abs(values[i].imag()) <= apart) return false;
    for (Eigen::Index j = 0; j < i; ++j) {
      if (std::abs(values[i] - values[j]) <= apart) return false;
    }
  }
  return true;
}

/// Whether the eigenvalues of the members are the conjugates of the others.
bool is_half(const ComplexVector& values, const std::vector<Eigen::Index>& members) {
  if (2 * static_cast<Eigen::Index>(members.size()) != values.size()) return false;
  const double apart = told_apart * values.cwiseAbs().maxCoeff();
  for (const Eigen::Index i : members) {
    for (const Eigen::Index j : members) {
      if (std::abs(values[i] - std::conj(values[j])) <= apart) return false;
    }
  }
  return true;
}

/// Entries next to 0, 1 or -1 are these numbers: rounding, where the parts are turned about an axis of the
/// given coordinates.
double rounded(double entry) {
  constexpr double rounding = 1e-10;
  const double nearest = std::round(entry);
  return std::abs(nearest) <= 1.0 && std::abs(entry - nearest) <= rounding ? nearest : entry;
}

/// The basis of a space that has the unit matrix in some of its rows: first ones, as far as they are
/// independent. Its columns are the fewest coordinates.
ComplexMatrix in_echelon_form(const ComplexMatrix& space) {
  constexpr double preference = 0.01;  // for rows that come first, where others would do as well
  const Eigen::Index n = space.rows();
  const Vector weights = Vector::LinSpaced(n, 1.0, 1.0 - preference);
  const Eigen::ColPivHouseholderQR<ComplexMatrix> qr((weights.asDiagonal() * space).adjoint());
  const auto& pivots = qr.colsPermutation().indices();
  std::vector<Eigen::Index> rows(pivots.begin(), pivots.begin() + space.cols());
  std::sort(rows.begin(), rows.end());
  const ComplexMatrix basis = space * ComplexMatrix(space(rows, Eigen::all)).inverse();
  return basis.unaryExpr([](Complex z) { return Complex(rounded(z.real()), rounded(z.imag())); });
}

/// Whether a space holds motions that turn from earlier coordinates to later ones, x to y: forward whirl.
bool turns_forward(const ComplexMatrix& basis) {
  Eigen::Index pivot = 0, other = 0;
  basis.col(0).real().cwiseAbs().maxCoeff(&pivot);
  basis.col(0).imag().cwiseAbs().maxCoeff(&other);
  return (basis(other, 0).imag() * basis(pivot, 0).real() < 0.0) == (other > pivot);
}

/// [Re U, -Im U]: the coordinates of which [v; -iv] is U v.
Matrix real_coordinates(const ComplexMatrix& U) {
  Matrix result(U.rows(), 2 * U.cols());
  result << U.real(), -U.imag();
  return result;
}

/// The spaces of one half: right and left vectors of all matrices that are coupled with each other.
std::optional<Canonical> canonical_coordinates(const std::vector<Matrix>& all, Random& random) {
  const Eigen::PartialPivLU<Matrix> B(random_combination(all, random));
  if (!(B.rcond() > 1.0 / (worst_condition * worst_condition))) return std::nullopt;
  const Matrix G = B.solve(random_combination(all, random));
  // Most matrices have real eigenvalues, and are no pair. Vectors take three times as long.
  if (!are_different(Eigen::EigenSolver<Matrix>(G, false).eigenvalues())) return std::nullopt;
  const Eigen::EigenSolver<Matrix> eigen(G);
  if (eigen.info() != Eigen::Success || !are_different(eigen.eigenvalues())) return std::nullopt;
  const ComplexMatrix V = eigen.eigenvectors();
  const Eigen::PartialPivLU<ComplexMatrix> lu(V);
  if (!(lu.rcond() > 1.0 / (worst_condition * worst_condition))) return std::nullopt;
  const ComplexMatrix coupling = lu.solve(product(Matrix(B.solve(random_combination(all, random))), V));
  const std::vector<Eigen::Index> half = connected_with_first(coupling);
  if (!is_half(eigen.eigenvalues(), half)) return std::nullopt;
  ComplexMatrix right = in_echelon_form(V(Eigen::all, half));
  const ComplexMatrix rows = lu.inverse() * B.inverse().cast<Complex>();  // (B V)^-1
  ComplexMatrix left = in_echelon_form(ComplexMatrix(rows(half, Eigen::all)).adjoint());
  if (!turns_forward(right)) {
    right = right.conjugate().eval();
    left = left.conjugate().eval();
  }
  // Where both are the same up to rounding, equations and coordinates keep their symmetry.
  constexpr double same = 1e-9;
  if ((left - right).norm() <= same * right.norm()) left = right;
  return Canonical{without_rounding_of_columns(real_coordinates(right)),
                   without_rounding_of_columns(real_coordinates(left))};
}

/// Whether all matrices have the canonical form in these coordinates up to rounding, as a whole and entry by
/// entry, as independent parts are tested: compared with the terms that they are sums of.
bool holds(const Canonical& canonical, const PartMatrices& part) {
  constexpr double most = 100.0;  // beyond that, rounding would hide a difference that matters
  const double rcond = std::min(Eigen::PartialPivLU<Matrix>(canonical.right).rcond(),
                                Eigen::PartialPivLU<Matrix>(canonical.left).rcond());
  if (!(rcond > 1.0 / worst_condition)) return false;
  const Matrix left = part.left * canonical.left, right = part.right * canonical.right;
  const double size = std::max(canonical.left.norm() * canonical.right.norm(), 1.0);
  return std::all_of(part.given.begin(), part.given.end(), [&](const Matrix& A) {
    const Matrix there = left.transpose() * A * right;
    const Matrix apart = there - canonical_form(there);
    const double terms = magnitudes_of_terms(part.left, A, part.right).norm();
    return apart.norm() <= largest_coupling(std::clamp(terms, 1.0, most)) * size &&
           (apart.cwiseAbs().array() <= rounding_of_entries(left, A, right, 1.0 / rcond).array()).all();
  });
}

std::optional<Canonical> find_canonical(const PartMatrices& part, Random& random) {
  constexpr int attempts = 2;  // some combinations are worse conditioned than others
  if (part.own.size() < 2) return std::nullopt;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    auto found = canonical_coordinates(part.own, random);
    if (found && holds(*found, part)) return found;
  }
  return std::nullopt;
}

/// All coordinates as one part.
IndependentParts one_part(Eigen::Index n) {
  IndependentParts parts;
  parts.right = parts.left = parts.inverse = Matrix::Identity(n, n);
  parts.pattern_M = parts.pattern_C = parts.pattern_K = Matrix::Ones(n, n);
  parts.ranges = {{0, n}};
  return parts;
}

/// One where an entry or its partner in the canonical form is one.
Matrix canonical_pattern(const Matrix& pattern) {
  const Eigen::Index m = pattern.rows() / 2;
  const Matrix A = pattern.topLeftCorner(m, m).cwiseMax(pattern.bottomRightCorner(m, m));
  const Matrix B = pattern.topRightCorner(m, m).cwiseMax(pattern.bottomLeftCorner(m, m));
  Matrix result(2 * m, 2 * m);
  result << A, B, B, A;
  return result;
}

/// Changes the coordinates of a part, and of its copies, to canonical ones.
void change_coordinates(const CoefficientMatrices& coefficients, const Canonical& canonical,
                        IndependentParts::Range& range, IndependentParts& parts) {
  const Matrix back = canonical.right.inverse();
  const auto columns = Eigen::seqN(range.first, range.size);
  const auto change = [&](Matrix& right, Matrix& left, Matrix& inverse) {
    right = right * canonical.right;
    left = left * canonical.left;
    inverse = back * inverse;
  };
  Matrix right = parts.right(Eigen::all, columns), left = parts.left(Eigen::all, columns);
  Matrix inverse = parts.inverse(columns, Eigen::all);
  change(right, left, inverse);
  for (PartCopy& copy : range.copies) change(copy.right, copy.left, copy.inverse);
  const double magnified = 1.0 / Eigen::PartialPivLU<Matrix>(canonical.right).rcond();
  const auto set_pattern = [&](const std::vector<Matrix>& matrices, Matrix& pattern) {
    pattern(columns, columns) = canonical_pattern(pattern_of_entries(left, matrices, right, magnified));
  };
  set_pattern(coefficients.M, parts.pattern_M);
  set_pattern(coefficients.C, parts.pattern_C);
  set_pattern(coefficients.K, parts.pattern_K);
  parts.right(Eigen::all, columns) = right;
  parts.left(Eigen::all, columns) = left;
  parts.inverse(columns, Eigen::all) = inverse;
}

/// Ranges with another entry behind every one that is marked in `is_pair`.
std::vector<IndependentParts::Range> doubled(std::vector<IndependentParts::Range> ranges,
                                             const std::vector<bool>& is_pair) {
  std::vector<std::size_t> first(ranges.size(), 0);
  for (std::size_t i = 1; i < ranges.size(); ++i) first[i] = first[i - 1] + (is_pair[i - 1] ? 2 : 1);
  std::vector<IndependentParts::Range> result;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    ranges[i].like = first[ranges[i].like];
    result.push_back(ranges[i]);
    if (!is_pair[i]) continue;
    result.back().complex_sign = 1;
    ranges[i].complex_sign = -1;
    if (ranges[i].like == first[i]) ++ranges[i].like;  // not like its conjugate part
    result.push_back(std::move(ranges[i]));
  }
  return result;
}

}  // namespace

std::shared_ptr<const IndependentParts> find_conjugate_parts(const CoefficientMatrices& coefficients,
                                                             const IndependentParts* parts) {
  constexpr std::uint64_t seed = 20103;  // the same coordinates in every run
  Random random(seed);
  if (coefficients.K.empty() || (parts != nullptr && parts->frame.size() > 0)) return nullptr;
  const Eigen::Index n = coefficients.K[0].rows();
  auto found = std::make_shared<IndependentParts>(parts != nullptr ? *parts : one_part(n));
  std::vector<bool> is_pair;
  for (IndependentParts::Range& range : found->ranges) {
    std::optional<Canonical> canonical;
    if (range.size % 2 == 0) {
      const auto columns = Eigen::seqN(range.first, range.size);
      canonical = find_canonical(matrices_of_part(coefficients, Matrix(found->left(Eigen::all, columns)),
                                                  Matrix(found->right(Eigen::all, columns))),
                                 random);
    }
    if (canonical) change_coordinates(coefficients, *canonical, range, *found);
    is_pair.push_back(canonical.has_value());
  }
  if (std::find(is_pair.begin(), is_pair.end(), true) == is_pair.end()) return nullptr;
  found->is_diagonal = false;
  found->ranges = doubled(std::move(found->ranges), is_pair);
  return found;
}

std::shared_ptr<const IndependentParts> joined_pairs(const IndependentParts& parts,
                                                     const std::vector<bool>& which,
                                                     std::vector<int>& numbers) {
  auto joined = std::make_shared<IndependentParts>(parts);
  joined->ranges.clear();
  numbers.clear();
  for (std::size_t i = 0; i < parts.count(); ++i) {
    IndependentParts::Range range = parts.ranges[i];
    const bool is_second = range.complex_sign < 0 && which[i - 1];
    if (!is_second) {
      if (which[i]) range.complex_sign = 0;
      joined->ranges.push_back(std::move(range));
    }
    numbers.push_back(static_cast<int>(joined->ranges.size()) - 1);
  }
  for (IndependentParts::Range& range : joined->ranges)
    range.like = static_cast<std::size_t>(numbers[range.like]);
  return joined;
}

}  // namespace eigentrail
