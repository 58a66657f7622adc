#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "continuation/event_tools.hpp"
#include "continuation/shared_basis.hpp"
#include "continuation/strands.hpp"
#include "continuation/tracer.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

constexpr double glimpse = 1e-5;  ///< of a step: how far beside a meeting its modes are told apart
constexpr double coinciding =
    1e-6;  ///< relative distance below which a derivative of one eigenvalue means nothing

/// Eigenvalues of the block a little behind its point, told by the series.
ComplexVector roots_beside(const Track& track, double distance) {
  return block_roots(evaluate_series(track.functions, distance));
}

}  // namespace

/// Orders the eigenvalues of every block at the end of a step as they come from its beginning.
void Tracer::label_arrival(double h, PathNode& next) const {
  for (std::size_t i = 0; i < next.tracks.size(); ++i) {
    const Track& left = node_.tracks[i];
    Track& right = next.tracks[i];
    right.modes = right.arriving = left.modes;
    if (right.size() == 1) continue;
    double from = 0.0;
    const ComplexVector start = departing_roots(left, h, from);
    const HermiteInterpolant functions = functions_on_step(node_, next, i, h);
    right.roots = in_order_of(follow_roots(functions, start, from, 1.0, &right.told_apart), right.roots);
  }
}

/// Where eigenvalues of a block coincide its modes are ordered anew; elsewhere nothing changes.
void Tracer::label_departure(double h, PathNode& next, const std::vector<bool>& coincide) {
  if (leaves_path_at(next)) return;  // the other path has its own
  for (std::size_t i = 0; i < next.tracks.size(); ++i) {
    Track& track = next.tracks[i];
    track.departure.reset();
    if (!coincide[i]) continue;
    const HermiteInterpolant functions = functions_on_step(node_, next, i, h);
    const double distance = glimpse * h;
    double from = 0.0;
    const ComplexVector start = departing_roots(node_.tracks[i], h, from);
    const ComplexVector before = follow_roots(functions, start, from, 1.0 - glimpse, &track.told_apart);
    const ComplexVector earlier = follow_roots(functions, before, 1.0 - glimpse, 1.0 - 2.0 * glimpse);
    // Straight on through a crossing. At an exceptional point no order is the right one; this one is as good.
    const ComplexVector expected = before + 2.0 * (before - earlier);
    track.roots = in_order_of(before, track.roots);
    track.departure = Track::Departure{distance, in_order_of(expected, roots_beside(track, distance))};
    if (track.pair.is_real) settle_real_block(track);
  }
}

int Tracer::partner_of(int mode) {
  const auto found = partners_.find(mode);
  if (found != partners_.end()) return found->second;
  const int born = result_.n_columns++;
  partners_[mode] = born;
  partners_[born] = mode;
  return born;
}

/// A collision at this point was recorded before it was known that a mode begins there.
void Tracer::name_in_collisions(int parent, int born) {
  for (Event& event : result_.events) {
    if (event.node != result_.nodes || event.kind != EventKind::collision) continue;
    const auto has = [&event](int mode) {
      return std::find(event.modes.begin(), event.modes.end(), mode) != event.modes.end();
    };
    if (has(parent) && !has(born)) event.modes = sorted_modes(united(event.modes, {born}));
  }
}

/// In a real block every real eigenvalue is a mode, and of a complex pair the upper member is.
void Tracer::settle_real_block(Track& track) {
  ComplexVector& roots = track.departure ? track.departure->roots : track.roots;
  const Eigen::Index k = roots.size();
  for (Eigen::Index i = 0; i < k; ++i) {
    if (roots[i].imag() == 0.0) continue;
    Eigen::Index j = 0;
    (roots.array() - std::conj(roots[i])).abs().minCoeff(&j);
    if (j <= i) continue;
    int& a = track.modes[static_cast<std::size_t>(i)];
    int& b = track.modes[static_cast<std::size_t>(j)];
    const bool followed = a >= 0 || b >= 0;
    const int upper = a >= 0 && b >= 0 ? std::min(a, b) : std::max(a, b);
    if (a >= 0 && b >= 0) {
      partners_[a] = b;
      partners_[b] = a;
    }
    a = upper;
    b = followed ? Track::no_mode : Track::guest;
    if (roots[i].imag() < 0.0) std::swap(a, b);
  }
  for (Eigen::Index i = 0; i < k; ++i) {
    int& mode = track.modes[static_cast<std::size_t>(i)];
    if (roots[i].imag() != 0.0 || mode != Track::no_mode) continue;
    // The lower member of a pair that has come apart on the real axis: born as a mode of its own.
    int parent = 0;
    double nearest = INFINITY;
    for (Eigen::Index j = 0; j < k; ++j) {
      const int other = track.modes[static_cast<std::size_t>(j)];
      if (j == i || other < 0 || roots[j].imag() != 0.0) continue;
      const double distance = std::abs(roots[j] - roots[i]);
      const auto known = partners_.find(other);
      const bool taken = known != partners_.end() && std::find(track.modes.begin(), track.modes.end(),
                                                               known->second) != track.modes.end();
      if (taken || distance >= nearest) continue;
      nearest = distance;
      parent = other;
    }
    mode = partner_of(parent);
    name_in_collisions(parent, mode);
    // It comes from where its parent was: what it crosses at once is not missed.
    for (std::size_t c = 0; c < criteria_.size(); ++c) {
      if (!criteria_[c].asks_for_pairs()) watches_[{mode, c}] = watches_[{parent, c}];
    }
  }
}

namespace {

/// Whether the dense output leads from the labels at one end to those at the other, in both directions: where
/// the tolerance is wider than a veering it may take another way than the series with one coefficient more,
/// which the labels are from.
bool keeps_labels(const DenseBlock& block, double h, const Track& left, const Track& right) {
  constexpr double same = 1e-8;  // nearer ones cannot be told apart
  if (left.size() == 1 || right.departure) return true;
  double from = 0.0;
  const ComplexVector start = departing_roots(left, h, from);
  const auto leads = [&](const ComplexVector& a, double at_a, const ComplexVector& b, double at_b) {
    const ComplexVector found = in_order_of(follow_roots(block, h, a, at_a, at_b), b);
    return (found - b).cwiseAbs().maxCoeff() <= same * b.cwiseAbs().maxCoeff();
  };
  return leads(start, from, right.roots, 1.0) && leads(right.roots, 1.0, start, from);
}

}  // namespace

PathStep Tracer::make_step(double h, const PathNode& next) const {
  PathStep step;
  step.length = h;
  const Eigen::Index count = problem_.order + 1;
  step.parameter = Matrix::Zero(2, count);
  const auto& left = node_.path.parameters;
  const auto& right = next.path.parameters;
  const Eigen::Index traced = problem_.traced;
  for (Eigen::Index k = 0; k < count; ++k) {
    step.parameter(0, k) = coefficient(left, traced, k);
    step.parameter(1, k) = coefficient(right, traced, k);
  }
  for (std::size_t i = 0; i < next.tracks.size(); ++i) {
    const Track& track = node_.tracks[i];
    DenseBlock block = block_on_step(node_, next, i);
    block.left = block.left.leftCols(count).eval();
    block.right = block.right.leftCols(count).eval();
    block.certified = i < certified_.size() && certified_[i] && next.tracks[i].told_apart &&
                      keeps_labels(block, h, track, next.tracks[i]);
    for (const int mode : track.modes) {
      if (mode >= 0) block.modes.push_back(mode);
    }
    step.blocks.push_back(std::move(block));
  }
  return step;
}

/// Every mode that exists just before or just behind the point.
std::vector<ModeState> Tracer::mode_states(const PathNode& node) const {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<ModeState> states;
  const double speed = coefficient(node.path.parameters, problem_.traced, 1);
  for (const Track& track : node.tracks) {
    ComplexMatrix vectors = ComplexMatrix::Identity(1, 1);
    ComplexVector values = track.pair.Lambda.col(0);
    if (track.size() > 1) {
      const Eigen::ComplexEigenSolver<ComplexMatrix> solver(track.pair.Lambda);
      vectors = solver.eigenvectors();
      values = in_order_of(track.roots, solver.eigenvalues());
      ComplexMatrix ordered = vectors;
      for (Eigen::Index i = 0; i < track.size(); ++i) {
        Eigen::Index at = 0;
        (solver.eigenvalues().array() - values[i]).abs().minCoeff(&at);
        ordered.col(i) = vectors.col(at);
      }
      vectors = ordered;
    }
    const double scale = std::max(track.pair.Lambda.norm(), 1e-300);
    for (Eigen::Index i = 0; i < track.size(); ++i) {
      for (const std::vector<int>* modes : {&track.arriving, &track.modes}) {
        const int mode = (*modes)[static_cast<std::size_t>(i)];
        const bool seen = std::any_of(states.begin(), states.end(),
                                      [mode](const ModeState& state) { return state.mode == mode; });
        if (mode < 0 || seen) continue;
        ModeState state;
        state.mode = mode;
        const Complex root = track.roots[i];
        double nearest = INFINITY;
        for (Eigen::Index j = 0; j < track.size(); ++j) {
          if (j != i) nearest = std::min(nearest, std::abs(track.roots[j] - root));
        }
        const ComplexVector series =
            nearest > coinciding * scale ? root_series(track.functions, root) : ComplexVector();
        const Complex slope = series.size() > 1 ? series[1] / speed : Complex(nan, nan);
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
        states.push_back(std::move(state));
      }
    }
  }
  return states;
}

}  // namespace eigentrail
