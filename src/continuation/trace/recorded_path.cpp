#include "eigentrail/continuation/recorded_path.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/continuation/eigenvalue_error.hpp"

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

double RecordedPath::rounding_at(const Position& position, int mode) const {
  const std::size_t left = position.t == 1.0 ? position.step + 1 : position.step;
  const std::size_t right = position.t == 0.0 ? position.step : position.step + 1;
  return std::fmin(rounding_at(left, mode), rounding_at(right, mode));  // not NaN
}

ComplexVector RecordedPath::shown_at(const Position& position) const {
  ComplexVector s = eigenvalues_at(position);
  for (Eigen::Index mode = 0; mode < s.size(); ++mode)
    s[mode] = shown(s[mode], rounding_at(position, static_cast<int>(mode)));
  return s;
}

PathRecorder::PathRecorder(const RecordedPath& path) : path_(path), n_modes_(path.eigenvalues.cols()) {
  path_.growing_unfollowed.resize(path.n_nodes(), -1);
  if (path.rounding.size() == 0) path_.rounding.setZero(path.eigenvalues.rows(), n_modes_);
  for (Eigen::Index node = 0; node < path.eigenvalues.rows(); ++node) {
    eigenvalues_.emplace_back(path.eigenvalues.row(node).transpose());
    rounding_.emplace_back(path_.rounding.row(node).transpose());
  }
}

void PathRecorder::append(const TracePoint& point) {
  for (const ModeState& state : point.modes) n_modes_ = std::max<Eigen::Index>(n_modes_, state.mode + 1);
  ComplexVector& row = eigenvalues_.emplace_back(ComplexVector::Constant(n_modes_, Complex(NAN, NAN)));
  Vector& rounding = rounding_.emplace_back(Vector::Constant(n_modes_, NAN));
  for (const ModeState& state : point.modes) {
    row[state.mode] = state.s;
    rounding[state.mode] = state.rounding;
  }
  path_.growing_unfollowed.push_back(point.growing_unfollowed);
  path_.p.push_back(point.node.p);
  if (point.step != nullptr) path_.steps.push_back(*point.step);
}

RecordedPath PathRecorder::path() const {
  RecordedPath path = path_;
  path.eigenvalues.setConstant(points(), n_modes_, Complex(NAN, NAN));
  path.rounding.setConstant(points(), n_modes_, NAN);
  for (std::size_t i = 0; i < eigenvalues_.size(); ++i) {
    const auto node = static_cast<Eigen::Index>(i);
    path.eigenvalues.row(node).head(eigenvalues_[i].size()) = eigenvalues_[i].transpose();
    path.rounding.row(node).head(rounding_[i].size()) = rounding_[i].transpose();
  }
  return path;
}

}  // namespace eigentrail
