// Saving the state of a trace between two points, and restoring it.
//
// The state is everything that changes from one point to the next. Models and options are not part of it.
// Of most structs all members are saved; the functions `fields` below list those of others, which they
// decompose by a structured binding. If a member is added to a struct, the code does not compile until it is
// counted or listed here.
#include <algorithm>

#include "continuation/archived_parts.hpp"
#include "continuation/trace/complex_parts.hpp"
#include "continuation/trace/trace_state.hpp"
#include "core/archive.hpp"
#include "eigentrail/continuation/event_kinds.hpp"
#include "eigentrail/continuation/scene_parts.hpp"
#include "eigentrail/core/errors.hpp"

namespace eigentrail {

// These functions are in this namespace so that the archive finds them by argument-dependent lookup.

/// The factors are not saved: they are not used after the point.
template <SameAs<InvariantPair> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [status, chart, part, is_real, Z, Lambda, W, backward_error, condition, rounding, factors] = self;
  visit(status, chart, part, is_real, Z, Lambda, W, backward_error, condition, rounding);
}

Members<2> archived(const Track::Departure*);
Members<14> archived(const Track*);
Members<4> archived(const Linearization*);

template <SameAs<TangentBasis> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [T, is_identity, parts, left] = self;  // parts are found again
  visit(T, is_identity, left);
}

Members<6> archived(const ReducedPencil*);
Members<6> archived(const PathNode*);
Members<3> archived(const PathPlane*);
Members<3> archived(const EventOfCopy*);
Members<14> archived(const Event*);
Members<6> archived(const Rejections*);
Members<5> archived(const Regroupings*);
Members<19> archived(const TraceResult*);
Members<2> archived(const PathFrame::BranchPoint*);

/// The range is not saved: the options give it.
template <SameAs<PathFrame> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [range, plane, direction, largest_position, scaled_at, largest_unknowns, rounding, bridge,
         branch_point] = self;
  visit(plane, direction, largest_position, scaled_at, largest_unknowns, rounding, bridge, branch_point);
}

Members<3> archived(const TriedPoint*);
Members<5> archived(const StepOrigin*);
Members<7> archived(const TraceSettings*);

/// The other path is not saved: it is used, or no longer needed, before the next state is saved.
template <SameAs<BranchPassage> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [passed, tries, other] = self;
  visit(passed, tries);
}

Members<6> archived(const StepMemory*);
Members<2> archived(const ModeNumbers*);
Members<1> archived(const ModeCopies*);
Members<2> archived(const EndedTrack*);
Members<3> archived(const LeastKnown*);
Members<13> archived(const TraceState*);

std::string save_state(const TraceState& state) {
  ArchiveWriter archive;
  archive(state);
  return archive.bytes();
}

namespace {

/// Largest relative difference, in the Frobenius norm, between a matrix at the last point as saved and as
/// recomputed from the scene. Recomputation on the same machine gives the same bits; the margin allows for
/// numbers that are read from another file with other rounding. With a larger value changed matrices may go
/// unnoticed, with a smaller one rounding may prevent a resume.
constexpr double matrix_rounding = 1e-9;

/// The sizes of all vectors and matrices at a point.
struct PointSizes {
  Eigen::Index parameters = 0, coordinates = 0, constraints = 0, multipliers = 0, freedoms = 0;
  int columns = 0;  ///< number of modes
};

/// Whether a series has at least one coefficient and all coefficients have that size.
template <class Coefficients>
bool all_are(const Coefficients& series, Eigen::Index rows, Eigen::Index columns) {
  for (const auto& coefficient : series) {
    if (coefficient.rows() != rows || coefficient.cols() != columns) return false;
  }
  return !series.empty();
}

bool fits(const std::vector<int>& modes, Eigen::Index size, int columns) {
  for (const int mode : modes) {
    if (mode < Track::guard || mode >= columns) return false;
  }
  return static_cast<Eigen::Index>(modes.size()) == size;
}

/// `n`: freedoms of the part of the equations that the track belongs to.
bool fits(const Track& track, const PointSizes& sizes, Eigen::Index n) {
  const Eigen::Index k = track.pair.Lambda.rows();
  const Eigen::Index functions = k <= 2 ? k : k * k;
  for (const int root : track.met) {
    if (root < 0 || root >= k) return false;
  }
  return k >= 1 && k <= 2 * n && track.pair.Lambda.cols() == k && track.pair.Z.rows() == n &&
         track.pair.Z.cols() == k && track.pair.W.rows() == 2 * n && track.pair.W.cols() == k &&
         all_are(track.series.Z, sizes.coordinates, k) && all_are(track.series.Lambda, k, k) &&
         track.functions.rows() == functions && track.functions.cols() >= 2 && track.roots.size() == k &&
         fits(track.modes, k, sizes.columns) &&
         (track.arriving.empty() || fits(track.arriving, k, sizes.columns)) &&
         (!track.departure || track.departure->roots.size() == k);
}

bool is_series(const VectorSeries& columns, Eigen::Index rows) {
  return columns.rows() == rows && columns.cols() >= 1 && columns.cols() <= max_order + 1;
}

bool fits(const Path& path, const Model& model) {
  const auto parameters = static_cast<Eigen::Index>(model.description().parameters.size());
  return is_series(path.parameters, parameters) && is_series(path.x, model.n_coordinates()) &&
         is_series(path.lambda, model.n_multipliers());
}

/// Whether a pencil falls apart as the problem does.
bool has_parts(const ReducedPencil& pencil, const IndependentParts* parts) {
  const std::size_t count = parts != nullptr && parts->count() > 1 ? parts->count() : 0;
  if (pencil.parts.size() != count) return false;
  const auto copies = [](const IndependentParts::Range& range) {
    return static_cast<int>(range.copies.size());
  };
  if (parts != nullptr && count == 0 && pencil.copies != copies(parts->ranges.front())) return false;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Index size = parts->ranges[i].size;
    const ReducedPencil& own = pencil.parts[i];
    if (own.copies != copies(parts->ranges[i]) || own.complex_sign != parts->ranges[i].complex_sign)
      return false;
    if (!all_are(own.M, size, size) || !all_are(own.C, size, size) || !all_are(own.K, size, size))
      return false;
  }
  return true;
}

/// Tracks of equations that fall apart as those of a pencil do.
bool fits(const std::vector<Track>& tracks, const ReducedPencil& pencil, const PointSizes& sizes) {
  const auto count = static_cast<int>(std::max<std::size_t>(pencil.parts.size(), 1));
  return std::all_of(tracks.begin(), tracks.end(), [&](const Track& track) {
    const int part = track.pair.part;
    return part >= 0 && part < count && !pencil.of(part).M.empty() &&
           fits(track, sizes, pencil.of(part).size());
  });
}

bool fits(const PathNode& node, const PointSizes& sizes, const IndependentParts* parts) {
  const Eigen::Index n = sizes.coordinates;
  if (!has_parts(node.pencil, parts) || !fits(node.tracks, node.pencil, sizes)) return false;
  const Linearization& full = node.linearization;
  return is_series(node.path.parameters, sizes.parameters) && is_series(node.path.x, n) &&
         is_series(node.path.lambda, sizes.multipliers) && all_are(full.M, n, n) && all_are(full.C, n, n) &&
         all_are(full.K, n, n) && all_are(full.A, sizes.constraints, n) &&
         all_are(node.basis.T, n, sizes.freedoms) &&
         (node.basis.left.empty() || all_are(node.basis.left, n, sizes.freedoms)) &&
         all_are(node.pencil.M, sizes.freedoms, sizes.freedoms) &&
         all_are(node.pencil.C, sizes.freedoms, sizes.freedoms) &&
         all_are(node.pencil.K, sizes.freedoms, sizes.freedoms);
}

/// Whether M, C, K and A that the model gives at a saved point equal the saved ones up to rounding. They
/// differ if a file of matrices that the scene reads has changed.
bool same_matrices(const PathProblem& problem, const PathNode& node) {
  const Model& model = problem.model;
  const Path here{parameters_at(problem, node.p), node.path.x.col(0), node.path.lambda.col(0)};
  EvaluationCounts counts = model.new_counts();
  Linearization found;
  if (model.linearize(here, 0, found, counts)) return false;
  const auto same = [](SystemMatrix now, const SystemMatrix& before) {
    if (now.is_sparse() != before.is_sparse()) return false;
    now.add_scaled(-1.0, before);
    return now.norm() <= matrix_rounding * before.norm();
  };
  const Linearization& before = node.linearization;
  return same(found.M[0], before.M[0]) && same(found.C[0], before.C[0]) && same(found.K[0], before.K[0]) &&
         same(found.A[0], before.A[0]);
}

/// Whether the modes of a track stand for at most as many others as its part for other parts.
bool fits(const ModeCopies& copies, const Track& track, const IndependentParts* parts) {
  const auto part = static_cast<std::size_t>(track.pair.part);
  const std::size_t most = parts != nullptr ? parts->ranges[part].copies.size() : 0;
  return std::all_of(track.modes.begin(), track.modes.end(),
                     [&](int mode) { return copies.of(mode).size() <= most; }) &&
         std::all_of(track.arriving.begin(), track.arriving.end(),
                     [&](int mode) { return copies.of(mode).size() <= most; });
}

bool fits(const ModeCopies& copies, const TraceState& state, const IndependentParts* parts) {
  for (const auto& [mode, others] : copies.numbers) {
    for (const int other : others) {
      if (other < 0 || other >= state.result.n_columns) return false;
    }
  }
  const auto& tracks = state.origin.node.tracks;
  return std::all_of(tracks.begin(), tracks.end(),
                     [&](const Track& track) { return fits(copies, track, parts); }) &&
         std::all_of(state.ended.begin(), state.ended.end(),
                     [&](const EndedTrack& one) { return fits(copies, one.track, parts); });
}

/// The first part of a state that does not fit the problem, in words; empty if all of it fits.
std::string misfit(const TraceState& state, const PathProblem& problem, const TraceOptions& options) {
  const Model& model = problem.model;
  const TraceResult& result = state.result;
  const StepOrigin& origin = state.origin;
  const PointSizes sizes{static_cast<Eigen::Index>(model.description().parameters.size()),
                         model.n_coordinates(),
                         model.n_constraints(),
                         model.n_multipliers(),
                         problem.parts ? problem.parts->right.cols() : result.n_independent,
                         result.n_columns};
  const std::size_t effects = model.description().effects.size();
  const EvaluationCounts& counts = result.counts.evaluations;
  if (counts.residual.size() != effects || counts.linearization.size() != effects) return "other effects";
  const int order = state.settings.order;
  if (order < 1 || order >= max_order || result.order != order) return "no order of a series";
  if (sizes.freedoms < 1 || sizes.freedoms > sizes.coordinates || sizes.columns < 1) return "other freedoms";
  if (state.numbers.count != sizes.columns) return "another number of modes";
  if (!fits(origin.node, sizes, problem.parts.get())) return "another size of the last point";
  if (origin.last_step != 0.0 && !fits(origin.previous, origin.node.pencil, sizes))
    return "another size of the point before it";
  if (origin.tried && !fits(origin.tried->tracks, origin.node.pencil, sizes))
    return "another size of a point that was tried";
  if (origin.tried && origin.tried->equations && !fits(*origin.tried->equations, sizes, problem.parts.get()))
    return "another size of the equations that were tried";
  for (const EndedTrack& one : state.ended) {
    const auto parts = static_cast<int>(std::max<std::size_t>(origin.node.pencil.parts.size(), 1));
    const int part = one.track.pair.part;
    if (part < 0 || part >= parts || !fits(one.track, sizes, origin.node.pencil.of(part).size()))
      return "another size of a mode that ended";
  }
  if (state.frame.plane && state.frame.plane->x.size() != sizes.coordinates) return "another size of a plane";
  const std::size_t criteria = criteria_of(options.events).size();
  for (const auto& [key, history] : state.histories) {
    if (key.first < 0 || key.second >= criteria) return "other events";
  }
  if (!fits(state.copies, state, problem.parts.get())) return "modes of equal parts that are not there";
  for (const auto* list : {&result.events, &state.events}) {
    for (const Event& event : *list) {
      if (!is_event_kind(event.kind)) return "no kind of an event";
      for (const int mode : event.modes) {
        if (mode < 0 || mode >= sizes.columns) return "an event of a mode that is not there";
      }
    }
  }
  if (!same_matrices(problem, origin.node))
    return "other matrices at " + place_text(options, origin.node.p) +
           "; has a file of matrices changed since?";
  return "";
}

/// The parts of the problem in the coordinates of a node; null if they have none there.
void restore_parts(const PathProblem& problem, PathNode& node) {
  node.basis.parts = problem.parts;
  const bool turns = problem.parts && problem.parts->frame.size() > 0;
  if (turns && !node.linearization.A.empty() && node.linearization.A[0].cols() == problem.parts->frame.rows())
    node.basis.parts = turned(problem.parts, ConstraintFactorization(node.linearization.A[0]));
}

}  // namespace

TraceState restore_state(std::string_view bytes, PathProblem& problem, const TraceOptions& options) {
  TraceState state;
  try {
    ArchiveReader archive(bytes);
    archive(state);
    archive.finish();
  } catch (const ArchiveError& error) {
    throw InputError(std::string("the state of the trace is damaged: ") + error.what());
  }
  if (!problem.parts && fits(state.origin.node.path, problem.model)) {
    const SceneOnRange scene = scene_at_start(problem, options);
    problem.rests = scene.rests;
    problem.parts = scene.parts;
  }
  if (problem.parts && state.settings.joins_pairs) join_pairs(problem);
  restore_parts(problem, state.origin.node);
  if (state.origin.tried && state.origin.tried->equations)
    restore_parts(problem, *state.origin.tried->equations);
  state.frame.range = {problem.traced, options.from, options.to};
  if (const std::string fault = misfit(state, problem, options); !fault.empty())
    throw InputError("the state of the trace does not fit the scene: " + fault);
  return state;
}

}  // namespace eigentrail
