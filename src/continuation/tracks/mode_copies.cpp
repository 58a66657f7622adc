#include "continuation/tracks/mode_copies.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "continuation/tracks/members.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/reduction/tangent_basis.hpp"

namespace eigentrail {
namespace {

/// Numbers of some modes in a copy, counted from 0; empty where one of them is not followed there.
std::vector<int> in_copy(const ModeCopies& copies, const std::vector<int>& modes, std::size_t copy) {
  std::vector<int> there;
  for (const int mode : modes) {
    const std::vector<int>& numbers = copies.of(mode);
    if (copy < numbers.size()) there.push_back(numbers[copy]);
  }
  return there;
}

std::size_t most_copies(const ModeCopies& copies, const std::vector<int>& modes) {
  std::size_t most = 0;
  for (const int mode : modes) most = std::max(most, copies.of(mode).size());
  return most;
}

}  // namespace

const std::vector<int>& ModeCopies::of(int mode) const {
  static const std::vector<int> none;
  const auto found = numbers.find(mode);
  return found == numbers.end() ? none : found->second;
}

ModeCopies starting_copies(const std::vector<StartingMode>& modes, int n_modes) {
  ModeCopies copies;
  // Equal modes are equal numbers. Where a part has an eigenvalue more than once, its modes and those of a
  // copy belong together in their order.
  const auto same_before = [&](int i) {
    return std::count_if(modes.begin(), modes.begin() + i, [&](const StartingMode& other) {
      const StartingMode& mode = modes[static_cast<std::size_t>(i)];
      return other.part == mode.part && other.copy == mode.copy && other.s == mode.s;
    });
  };
  for (int i = 0; i < n_modes; ++i) {
    const StartingMode& mode = modes[static_cast<std::size_t>(i)];
    if (mode.copy == 0) continue;
    for (int j = 0; j < n_modes; ++j) {
      const StartingMode& first = modes[static_cast<std::size_t>(j)];
      if (first.part != mode.part || first.copy != 0 || first.s != mode.s || same_before(j) != same_before(i))
        continue;
      std::vector<int>& numbers = copies.numbers[j];
      if (static_cast<int>(numbers.size()) == mode.copy - 1) numbers.push_back(i);
    }
  }
  for (int i = 0; i < n_modes; ++i) {
    if (modes[static_cast<std::size_t>(i)].copy == 0) copies.numbers.try_emplace(i);
  }
  return copies;
}

void number_copies(const PathNode& node, ModeNumbers& numbers, ModeCopies& copies) {
  for (const Track& track : node.tracks) {
    const auto count = static_cast<std::size_t>(n_copies(node.basis, track.pair.part));
    for (const int mode : track.modes) {
      if (mode < 0 || count == 0 || copies.numbers.contains(mode)) continue;
      const auto partner = numbers.partners.find(mode);
      const bool known = partner != numbers.partners.end() && copies.numbers.contains(partner->second);
      const std::size_t own = known ? copies.of(partner->second).size() : count;
      for (std::size_t i = 0; i < own; ++i) copies.numbers[mode].push_back(numbers.count++);
      copies.numbers.try_emplace(mode);
    }
  }
}

PathStep with_copies(const ModeCopies& copies, PathStep step) {
  const std::size_t tracks = step.blocks.size();
  for (std::size_t i = 0; i < tracks; ++i) {
    const std::size_t count = most_copies(copies, step.blocks[i].modes);
    for (std::size_t copy = 0; copy < count; ++copy) {
      DenseBlock block = step.blocks[i];
      block.modes = in_copy(copies, block.modes, copy);
      step.blocks.push_back(std::move(block));
    }
  }
  return step;
}

std::vector<Event> with_copies(const ModeCopies& copies, const Event& event) {
  std::vector<Event> all{event};
  all.front().copies.clear();
  for (std::size_t copy = 0; copy < event.copies.size(); ++copy) {
    Event other = all.front();
    other.modes = sorted_modes(in_copy(copies, event.modes, copy));
    if (other.modes.empty()) continue;
    other.shape = event.copies[copy].shape;
    other.sensitivity = event.copies[copy].sensitivity;
    other.shift = event.copies[copy].shift;
    all.push_back(std::move(other));
  }
  if (!event.copies.empty()) return all;
  std::vector<int>& modes = all.front().modes;
  for (const int mode : event.modes) modes = united(modes, copies.of(mode));
  modes = sorted_modes(std::move(modes));
  return all;
}

std::string equal_modes_text(const ModeCopies& copies, const std::vector<int>& modes) {
  std::string text;
  for (const int mode : modes) {
    for (const int other : copies.of(mode))
      text += (text.empty() ? " and the equal modes " : ", ") + std::to_string(other + 1);
  }
  return text;
}

namespace {

/// Eigenvalues of a block get no derivative if their distance from another one, relative to the norm of the
/// block, is at most this. Beside an exceptional point the slope is proportional to 1 / distance, and
/// rounding changes it by eps / distance^2, relatively: 2e-4 at this limit, times the condition of the block.
constexpr double coinciding_roots = 1e-6;
/// Smallest norm of a block as a scale: keeps the limit above zero where all eigenvalues are zero.
constexpr double least_block_norm = 1e-300;

/// Eigenvectors of Lambda as columns, in the order of the roots of the track.
ComplexMatrix vectors_of(const Track& track) {
  if (track.size() == 1) return ComplexMatrix::Identity(1, 1);
  const Eigen::ComplexEigenSolver<ComplexMatrix> solver(track.pair.Lambda);
  const ComplexVector values = in_order_of(track.roots, solver.eigenvalues());
  ComplexMatrix ordered(track.size(), track.size());
  for (Eigen::Index i = 0; i < track.size(); ++i) {
    ordered.col(i) = solver.eigenvectors().col(nearest_root(solver.eigenvalues(), values[i]));
  }
  return ordered;
}

/// Derivative of root i of a track along the path, in its chart. NaN where another root is too close.
Complex slope_of(const Track& track, Eigen::Index i) {
  const double scale = std::max(track.pair.Lambda.norm(), least_block_norm);
  const double nearest = distance_from_others(track.roots, {static_cast<int>(i)});
  if (!(nearest > coinciding_roots * scale)) return {NAN, NAN};
  const ComplexVector series = root_series(track.functions, track.roots[i]);
  return series.size() > 1 ? series[1] : Complex(NAN, NAN);
}

/// The mode of root i of a track; `vectors` as from vectors_of. `rounding`: of the root at its place,
/// `along`: of the place. `speed` = dp / d(coordinate).
ModeState state_of(const Track& track, Eigen::Index i, int mode, const ComplexMatrix& vectors,
                   double rounding, double along, double speed) {
  ModeState state;
  state.mode = mode;
  // Infinite is what 1/s cannot be told from zero.
  const bool is_infinite = track.pair.chart == Chart::reciprocal && std::abs(track.roots[i]) <= rounding;
  const Complex root = is_infinite ? Complex(0.0) : track.roots[i];
  const Complex derivative = slope_of(track, i), slope = derivative / speed;
  if (along > 0.0 && std::isfinite(std::abs(derivative))) rounding += along * std::abs(derivative);
  state.s = chart_value(root, track.pair.chart);
  state.slope = track.pair.chart == Chart::finite ? slope : -slope * state.s * state.s;
  state.shape = track.series.Z[0] * vectors.col(i);
  if (state.s.imag() < 0.0) {
    state.s = std::conj(state.s);
    state.slope = std::conj(state.slope);
    state.shape = state.shape.conjugate();
  }
  state.backward_error = track.pair.backward_error;
  state.condition = track.pair.condition;
  state.rounding = track.pair.chart == Chart::finite ? rounding : rounding * std::norm(state.s);
  return state;
}

/// Adds the states of the copies of the last mode: the same but for their shapes.
void add_copies(const TangentBasis& basis, int part, const std::vector<int>& numbers,
                std::vector<ModeState>& states) {
  if (numbers.empty()) return;
  const ModeState mode = states.back();
  const ComplexVector z = basis.coordinates(mode.shape, part);
  for (std::size_t copy = 0; copy < numbers.size(); ++copy) {
    states.push_back(mode);
    states.back().mode = numbers[copy];
    states.back().shape = basis.shapes(z, part, static_cast<int>(copy) + 1);
  }
}

}  // namespace

std::vector<ModeState> mode_states(const PathNode& node, int traced, const ModeCopies& copies,
                                   const RoundingThresholds& thresholds, double along) {
  std::vector<ModeState> states;
  const double speed = coefficient(node.path.parameters, traced, 1);
  for (const Track& track : node.tracks) {
    const ComplexMatrix vectors = vectors_of(track);
    const Vector rounding = rounding_of_roots(track, thresholds);
    for (Eigen::Index i = 0; i < track.size(); ++i) {
      for (const std::vector<int>* modes : {&track.arriving, &track.modes}) {
        const int mode = (*modes)[static_cast<std::size_t>(i)];
        const bool seen = std::any_of(states.begin(), states.end(),
                                      [mode](const ModeState& state) { return state.mode == mode; });
        if (mode < 0 || seen) continue;
        states.push_back(state_of(track, i, mode, vectors, rounding[i], along, speed));
        add_copies(node.basis, track.pair.part, copies.of(mode), states);
      }
    }
  }
  return states;
}

}  // namespace eigentrail
