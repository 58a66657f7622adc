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

double RecordedPath::rounding_at(std::size_t node, int mode) const {
  return rounding.size() > 0 ? rounding(static_cast<Eigen::Index>(node), mode) : 0.0;
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

PathPosition RecordedPath::position_at(double in_steps) const {
  const auto step = std::min(static_cast<std::size_t>(in_steps), steps.size() - 1);
  return {step, in_steps - static_cast<double>(step)};
}

const DenseBlock* RecordedPath::block_of(std::size_t step, int mode) const {
  for (const DenseBlock& block : steps[step].blocks) {
    if (std::find(block.modes.begin(), block.modes.end(), mode) != block.modes.end()) return &block;
  }
  return nullptr;
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
    : p_(path.p),
      growing_unfollowed_(path.growing_unfollowed),
      steps_(path.steps),
      n_modes_(static_cast<std::size_t>(path.eigenvalues.cols())) {
  growing_unfollowed_.resize(p_.size(), -1);
  for (Eigen::Index node = 0; node < path.eigenvalues.rows(); ++node) {
    const ComplexVector row = path.eigenvalues.row(node).transpose();
    eigenvalues_.emplace_back(row.begin(), row.end());
    std::vector<double>& rounding = rounding_.emplace_back();
    for (int mode = 0; mode < static_cast<int>(n_modes_); ++mode)
      rounding.push_back(path.rounding_at(static_cast<std::size_t>(node), mode));
  }
}

void PathRecorder::append(const TracePoint& point) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ModeState& state : point.modes)
    n_modes_ = std::max(n_modes_, static_cast<std::size_t>(state.mode) + 1);
  std::vector<Complex>& row = eigenvalues_.emplace_back(n_modes_, Complex(nan, nan));
  std::vector<double>& rounding = rounding_.emplace_back(n_modes_, nan);
  for (const ModeState& state : point.modes) {
    row[static_cast<std::size_t>(state.mode)] = state.s;
    rounding[static_cast<std::size_t>(state.mode)] = state.rounding;
  }
  growing_unfollowed_.push_back(point.growing_unfollowed);
  p_.push_back(point.node.p);
  if (point.step != nullptr) steps_.push_back(*point.step);
}

RecordedPath PathRecorder::path() const {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  RecordedPath path{p_, {}, steps_, {}, growing_unfollowed_};
  path.eigenvalues.setConstant(static_cast<Eigen::Index>(p_.size()), static_cast<Eigen::Index>(n_modes_),
                               Complex(nan, nan));
  path.rounding.setConstant(path.eigenvalues.rows(), path.eigenvalues.cols(), nan);
  for (std::size_t node = 0; node < eigenvalues_.size(); ++node) {
    for (std::size_t mode = 0; mode < eigenvalues_[node].size(); ++mode) {
      const auto row = static_cast<Eigen::Index>(node), column = static_cast<Eigen::Index>(mode);
      path.eigenvalues(row, column) = eigenvalues_[node][mode];
      path.rounding(row, column) = rounding_[node][mode];
    }
  }
  return path;
}

}  // namespace eigentrail
