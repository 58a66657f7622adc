#include "continuation/point/continued_mode.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/step/shared_basis.hpp"
#include "eigentrail/continuation/dense_output.hpp"

namespace eigentrail {
namespace {

/// Series of a mode as one matrix: the vector scaled such that w^H V = 1, and below it the eigenvalue; one
/// column per coefficient.
ComplexMatrix stacked(const ComplexVector& w, const PairSeries& series) {
  std::vector<ComplexMatrix> V = series.Z;
  fix_length(w, V);
  const Eigen::Index n = V[0].rows();
  ComplexMatrix rows(n + 1, static_cast<Eigen::Index>(V.size()));
  for (Eigen::Index j = 0; j < rows.cols(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    rows.col(j) << V[at], series.Lambda[at](0, 0);
  }
  return rows;
}

}  // namespace

std::optional<ContinuedMode> continue_mode(const std::vector<Track>& previous, const PathNode& node,
                                           std::size_t index, double last, double h) {
  const Track& track = node.tracks[index];
  // A mode that was itself accepted as extrapolated has no new information to extrapolate from.
  if (track.size() > 1 || track.lineage == 0 || track.passed) return std::nullopt;
  const auto before = std::find_if(previous.begin(), previous.end(),
                                   [&](const Track& other) { return other.lineage == track.lineage; });
  if (before == previous.end() || before->passed) return std::nullopt;
  const ComplexVector w = before->series.Z[0].col(0);
  const HermiteInterpolant step(last, stacked(w, before->series), stacked(w, track.series));
  const auto count = static_cast<Eigen::Index>(track.series.Z.size());
  const ComplexMatrix ahead = step.series(1.0 + h / last, static_cast<int>(count) - 1);
  const Eigen::Index n = ahead.rows() - 1;
  const double length = ahead.col(0).head(n).norm();
  if (!ahead.allFinite() || !(length > 0.0)) return std::nullopt;
  ContinuedMode mode;
  double power = 1.0;
  for (Eigen::Index j = 0; j < count; ++j) {
    mode.series.Z.emplace_back(ahead.col(j).head(n) / (length * power));
    mode.series.Lambda.emplace_back(ComplexMatrix::Constant(1, 1, ahead(n, j) / power));
    power *= last;
  }
  mode.pair.chart = track.pair.chart;
  mode.pair.part = track.pair.part;
  mode.pair.is_real = track.pair.is_real;
  mode.pair.condition = track.pair.condition;
  mode.pair.rounding = track.pair.rounding;
  mode.pair.Z = mode.series.Z[0];
  mode.pair.Lambda = mode.series.Lambda[0];
  if (track.pair.is_real) {
    mode.pair.Z.imag().setZero();
    mode.pair.Lambda.imag().setZero();
  }
  return mode;
}

}  // namespace eigentrail
