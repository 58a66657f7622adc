// Saving the state of a trace between two points, and restoring it.
//
// The state is everything that changes from one point to the next. Models and options are not part of it.
// Of most structs all members are saved; the functions `fields` below list those of others, which they
// decompose by a structured binding. If a member is added to a struct, the code does not compile until it is
// counted or listed here.
#include "continuation/archived_parts.hpp"
#include "continuation/trace/trace_state.hpp"
#include "core/archive.hpp"
#include "core/fingerprint.hpp"
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
Members<13> archived(const Track*);
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

Members<2> archived(const StepOrigin*);
Members<3> archived(const TraceSettings*);

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

namespace {

/// Largest relative difference, in the Frobenius norm, between a matrix at the last point as saved and as
/// recomputed from the scene. Recomputation on the same machine gives the same bits; the margin allows for
/// numbers that are read from another file with other rounding. With a larger value changed matrices may go
/// unnoticed, with a smaller one rounding may prevent a resume.
constexpr double matrix_rounding = 1e-9;

/// The sizes of a problem on which those of its states depend.
std::vector<Eigen::Index> sizes_of(const PathProblem& problem, const TraceOptions& options) {
  const Model& model = problem.model;
  const auto size_of = [](const auto& list) { return static_cast<Eigen::Index>(list.size()); };
  std::vector<Eigen::Index> sizes{size_of(model.description().parameters),
                                  size_of(model.description().effects),
                                  model.n_coordinates(),
                                  model.n_constraints(),
                                  model.n_multipliers(),
                                  size_of(criteria_of(options.events))};
  if (!problem.parts) return sizes;
  for (const IndependentParts::Range& range : problem.parts->ranges)
    sizes.insert(sizes.end(), {range.size, size_of(range.copies), range.complex_sign});
  return sizes;
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

/// The parts of the problem in the coordinates of a node; null if they have none there.
void restore_parts(const PathProblem& problem, PathNode& node) {
  const bool turns = problem.parts && problem.parts->frame.size() > 0;
  node.basis.parts =
      turns ? turned(problem.parts, ConstraintFactorization(node.linearization.A[0])) : problem.parts;
}

}  // namespace

std::string save_state(const TraceState& state, const PathProblem& problem, const TraceOptions& options) {
  const std::string content =
      packed(sizes_of(problem, options), problem.order, problem.s_ref, problem.s_max, problem.route, state);
  return packed(content, fingerprint(content));
}

TraceState restore_state(std::string_view bytes, PathProblem& problem, const TraceOptions& options) {
  TraceState state;
  std::vector<Eigen::Index> sizes;
  try {
    std::string content;
    std::uint64_t checksum = 0;
    unpack(bytes, content, checksum);
    if (fingerprint(content) != checksum) throw ArchiveError("other bytes than were written");
    unpack(content, sizes, problem.order, problem.s_ref, problem.s_max, problem.route, state);
  } catch (const ArchiveError& error) {
    throw InputError(std::string("the state of the trace is damaged: ") + error.what());
  }
  if (!problem.parts) {
    const SceneOnRange scene = scene_at_start(problem, options);
    problem.rests = scene.rests;
    problem.parts = scene.parts;
  }
  if (problem.parts && state.settings.joins_pairs) join_pairs(problem);
  const auto refuse = [](const std::string& fault) {
    throw InputError("the state of the trace does not fit the scene: " + fault);
  };
  if (sizes != sizes_of(problem, options)) refuse("other sizes");
  restore_parts(problem, state.origin.node);
  state.frame.range = {problem.traced, options.from, options.to};
  if (!same_matrices(problem, state.origin.node))
    refuse("other matrices at " + place_text(options, state.origin.node.p) +
           "; has a file of matrices changed since?");
  return state;
}

}  // namespace eigentrail
