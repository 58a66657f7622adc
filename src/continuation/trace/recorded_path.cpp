#include "eigentrail/continuation/recorded_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "eigentrail/continuation/dense_output.hpp"

namespace eigentrail {

double RecordedPath::lowest() const {
  return p.empty() ? NAN : *std::min_element(p.begin(), p.end());
}
double RecordedPath::highest() const {
  return p.empty() ? NAN : *std::max_element(p.begin(), p.end());
}

std::vector<PathPosition> RecordedPath::positions(double value) const {
  std::vector<Position> found;
  for (std::size_t step = 0; step < steps.size(); ++step) {
    for (const double t : step_positions(steps[step], value)) {
      // A position on a node is listed once, on the step that ends there.
      const bool repeated =
          t == 0.0 && !found.empty() && found.back().step + 1 == step && found.back().t == 1.0;
      if (!repeated) found.push_back({step, t});
    }
  }
  return found;
}

double RecordedPath::parameter_at(const Position& position) const {
  if (position.t == 0.0) return p[position.step];
  if (position.t == 1.0) return p[position.step + 1];
  const PathStep& step = steps[position.step];
  const ComplexMatrix ends = step.parameter.cast<Complex>();
  return HermiteInterpolant(step.length, ends.row(0), ends.row(1))(position.t)[0].real();
}

Vector RecordedPath::trimmed_at(const Position& position) const {
  const PathStep& step = steps[position.step];
  Vector values(static_cast<Eigen::Index>(step.trimmed.size()));
  for (std::size_t i = 0; i < step.trimmed.size(); ++i) {
    const ComplexMatrix ends = step.trimmed[i].cast<Complex>();
    values[static_cast<Eigen::Index>(i)] =
        HermiteInterpolant(step.length, ends.row(0), ends.row(1))(position.t)[0].real();
  }
  return values;
}

ComplexVector RecordedPath::eigenvalues_at(const Position& position) const {
  const auto left = static_cast<Eigen::Index>(position.step);
  if (position.t == 0.0) return eigenvalues.row(left).transpose();
  if (position.t == 1.0) return eigenvalues.row(left + 1).transpose();
  return step_eigenvalues(steps[position.step], eigenvalues.row(left).transpose(),
                          eigenvalues.row(left + 1).transpose(), position.t);
}

PathRecorder::PathRecorder(const RecordedPath& path)
    : p_(path.p), steps_(path.steps), n_modes_(static_cast<std::size_t>(path.eigenvalues.cols())) {
  for (Eigen::Index node = 0; node < path.eigenvalues.rows(); ++node) {
    const ComplexVector row = path.eigenvalues.row(node).transpose();
    eigenvalues_.emplace_back(row.begin(), row.end());
  }
}

void PathRecorder::append(const TracePoint& point) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ModeState& state : point.modes)
    n_modes_ = std::max(n_modes_, static_cast<std::size_t>(state.mode) + 1);
  std::vector<Complex>& row = eigenvalues_.emplace_back(n_modes_, Complex(nan, nan));
  for (const ModeState& state : point.modes) row[static_cast<std::size_t>(state.mode)] = state.s;
  p_.push_back(point.node.p);
  if (point.step != nullptr) steps_.push_back(*point.step);
}

RecordedPath PathRecorder::path() const {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  RecordedPath path{p_, {}, steps_};
  path.eigenvalues.setConstant(static_cast<Eigen::Index>(p_.size()), static_cast<Eigen::Index>(n_modes_),
                               Complex(nan, nan));
  for (std::size_t node = 0; node < eigenvalues_.size(); ++node) {
    const std::vector<Complex>& row = eigenvalues_[node];
    for (std::size_t mode = 0; mode < row.size(); ++mode)
      path.eigenvalues(static_cast<Eigen::Index>(node), static_cast<Eigen::Index>(mode)) = row[mode];
  }
  return path;
}

}  // namespace eigentrail
