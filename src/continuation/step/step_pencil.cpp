#include <algorithm>
#include <cmath>

#include "continuation/step/ball_norm.hpp"
#include "core/band_matrix.hpp"
#include "core/diagonal_blocks.hpp"
#include "core/matrix_series.hpp"
#include "core/products.hpp"
#include "eigentrail/continuation/certificate.hpp"
#include "eigentrail/continuation/dense_output.hpp"

namespace eigentrail {
namespace {

/// Number of interpolated pencils that are cached per step: many large ones would fill the memory.
constexpr std::size_t most_samples = 64;

/// The inverse of a series of matrices, block by block where they are square.
MatrixSeries inverse_by_blocks(const MatrixSeries& A) {
  const std::vector<DiagonalBlock> blocks = diagonal_blocks(A);
  const auto is_square = [](const DiagonalBlock& b) { return b.rows.size() == b.columns.size(); };
  if (!std::all_of(blocks.begin(), blocks.end(), is_square)) return inverse_series(A);
  MatrixSeries inverse(A.size(), Matrix::Zero(A[0].rows(), A[0].cols()));
  for (const DiagonalBlock& block : blocks) {
    MatrixSeries part;
    for (const Matrix& coefficient : A) part.emplace_back(coefficient(block.rows, block.columns));
    part = inverse_series(part);
    for (std::size_t k = 0; k < A.size(); ++k) inverse[k](block.columns, block.rows) = part[k];
  }
  return inverse;
}

/// One and a half times the geometric mean of the magnitudes of a part's finite eigenvalues but zeros: not
/// the mean itself, which is an eigenvalue where a single one is followed that grows without oscillation.
double typical_magnitude(const PathNode& node, int part, const PencilAtPoint& pencil) {
  double sum = 0.0;
  int count = 0;
  for (const Track& track : node.tracks) {
    if (track.pair.part != part) continue;
    for (const Complex root : track.roots) {
      const double magnitude = std::abs(root);
      if (!(magnitude > 0.0)) continue;
      sum += (track.pair.chart == Chart::finite ? 1.0 : -1.0) * std::log(magnitude);
      ++count;
    }
  }
  constexpr double beside = 1.5;
  if (count > 0) return beside * std::exp(sum / count);
  const double inertia = pencil.norm_M > 0.0 ? pencil.norm_M : 1.0;
  return pencil.norm_K > 0.0 ? std::sqrt(pencil.norm_K / inertia) : 1.0;
}

}  // namespace

StepPencil::StepPencil(const PathNode& left, const PathNode& right, double length, int part)
    : left_(left),
      left_pencil_(left.pencil.of(part)),
      length_(length),
      count_(0),
      part_(part),
      right_(right.pencil.of(part)) {
  for (const ReducedPencil* pencil : {&left_pencil_, &std::as_const(right_)}) {
    count_ =
        std::max({count_, static_cast<Eigen::Index>(pencil->M.size()),
                  static_cast<Eigen::Index>(pencil->C.size()), static_cast<Eigen::Index>(pencil->K.size())});
  }
  for (const Track& track : left.tracks) {
    count_ = std::max(count_, static_cast<Eigen::Index>(track.series.Z.size()));
  }
  const IndependentParts* parts = left.basis.parts.get();
  if (left.basis.is_identity || (parts != nullptr && parts->frame.size() == 0))
    return;  // the same coordinates
  if (parts == nullptr) {
    const MatrixSeries G = change_of(left.basis.T[0], right.basis.T);
    turn(G, G);
    return;
  }
  // The coordinates of a part at the left point are those with the inverse of its own columns, and likewise
  // for its equations.
  const IndependentParts::Range& range = parts->ranges[static_cast<std::size_t>(part)];
  const auto columns = [&](const MatrixSeries& all) {
    MatrixSeries own;
    for (const Matrix& coefficient : all) own.push_back(coefficient.middleCols(range.first, range.size));
    return own;
  };
  const TangentBasis& there = right.basis;
  const Matrix own_rows = columns({parts->left}).front();
  const Matrix identity = Matrix::Identity(own_rows.rows(), own_rows.rows());
  const Matrix equations = own_rows.completeOrthogonalDecomposition().solve(identity).transpose();
  turn(change_of(equations, columns(there.left.empty() ? MatrixSeries{there.parts->left} : there.left)),
       change_of(parts->coordinates(static_cast<std::size_t>(part)).transpose(), columns(there.T)));
}

MatrixSeries StepPencil::change_of(const Matrix& dual, const MatrixSeries& right) const {
  MatrixSeries overlap = transposed_product(MatrixSeries{dual}, right, right.size());
  if (overlap.size() > 1)
    overlap.resize(static_cast<std::size_t>(count_), Matrix::Zero(overlap[0].rows(), overlap[0].cols()));
  return inverse_by_blocks(overlap);
}

void StepPencil::turn(const MatrixSeries& equations, const MatrixSeries& coordinates) {
  const auto count = static_cast<std::size_t>(count_);
  for (MatrixSeries* B : {&right_.M, &right_.C, &right_.K}) {
    const MatrixSeries BG = product(*B, coordinates, std::min(count, B->size() + coordinates.size() - 1));
    *B = transposed_product(equations, BG, std::min(count, BG.size() + equations.size() - 1));
  }
}

bool StepPencil::has_constant_leading_matrix() const {
  const bool constant_M = left_pencil_.M.size() == 1 && right_.M.size() == 1;
  const bool constant_C = left_pencil_.C.size() == 1 && right_.C.size() == 1;
  return constant_M && (constant_C || state_size(left_pencil_.M[0]) == 2 * left_pencil_.size());
}

std::optional<Eigen::Index> StepPencil::find_width() const {
  const Eigen::Index n = left_pencil_.size();
  if (!is_narrow_band(0, n) || left_pencil_.complex_sign != 0) return std::nullopt;
  Eigen::Index width = 0;
  for (const ReducedPencil* pencil : {&left_pencil_, &right_}) {
    for (const MatrixSeries* series : {&pencil->K, &pencil->C, &pencil->M}) {
      for (const Matrix& coefficient : *series) {
        width = band_width(coefficient, width);
        if (!is_narrow_band(width, n)) return std::nullopt;
      }
    }
  }
  return width;
}

Matrix StepPencil::interpolate(const MatrixSeries& left, const MatrixSeries& right,
                               const Vector& weights) const {
  if (left.size() == 1 && right.size() == 1) return left[0];
  Matrix sum = Matrix::Zero(left[0].rows(), left[0].cols());
  const auto add = [&](const MatrixSeries& series, Eigen::Index first) {
    const auto weight = [&](std::size_t i) { return weights[first + static_cast<Eigen::Index>(i)]; };
    std::size_t i = 0;
    // Three at a time: large matrices are in no cache, and the sum is read and written less often.
    for (; i + 3 <= series.size(); i += 3)
      sum += weight(i) * series[i] + weight(i + 1) * series[i + 1] + weight(i + 2) * series[i + 2];
    for (; i < series.size(); ++i) sum += weight(i) * series[i];
  };
  add(left, 0);
  add(right, count_);
  return sum;
}

std::shared_ptr<const StepPencil::Sample> StepPencil::sample(double t) const {
  ComplexMatrix left = ComplexMatrix::Zero(2 * count_, count_);
  ComplexMatrix right = left;
  left.topRows(count_).setIdentity();
  right.bottomRows(count_).setIdentity();
  Vector weights = HermiteInterpolant(length_, left, right)(t).real();
  ReducedPencil pencil{{interpolate(left_pencil_.M, right_.M, weights)},
                       {interpolate(left_pencil_.C, right_.C, weights)},
                       {interpolate(left_pencil_.K, right_.K, weights)}};
  pencil.complex_sign = left_pencil_.complex_sign;
  auto sample = std::make_shared<Sample>(std::move(weights), std::move(pencil));
  if (!width_) width_ = find_width();
  if (const auto& width = *width_) {
    const auto band = [&](const Matrix& B) { return std::make_shared<const Matrix>(band_of(B, *width)); };
    sample->at.bands = {band(sample->at.M), band(sample->at.C), band(sample->at.K)};
  }
  return sample;
}

std::shared_ptr<const StepPencil::Sample> StepPencil::at(double t) const {
  const std::lock_guard lock(mutex_);
  const auto known = samples_.find(t);
  if (known != samples_.end()) return known->second;
  if (samples_.size() >= most_samples) samples_.clear();
  return samples_.emplace(t, sample(t)).first->second;
}

std::shared_ptr<const EnergyNorm> StepPencil::energy_norm() const {
  const std::shared_ptr<const Sample> middle = at(0.5);
  const std::lock_guard lock(mutex_);
  if (!energy_norm_) energy_norm_ = EnergyNorm::of(middle->at, typical_magnitude(left_, part_, middle->at));
  return *energy_norm_;
}

}  // namespace eigentrail
