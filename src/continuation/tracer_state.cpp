// Leaving a trace between two points, and going on with it.
//
// The state is all that changes from one point to the next; models and options are not part of it. The lists
// below take structs apart by structured bindings, so that a member that is added and forgotten here does not
// compile.
#include "continuation/tracer.hpp"
#include "core/archive.hpp"
#include "eigentrail/core/errors.hpp"

namespace eigentrail {

// In this namespace, where the archive finds them by their argument.

template <SameAs<Path> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [parameters, x, lambda] = self;
  visit(parameters, x, lambda);
}

template <SameAs<PairSeries> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [Z, Lambda] = self;
  visit(Z, Lambda);
}

/// Without its factors, which no point needs once it is left.
template <SameAs<InvariantPair> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [status, chart, is_real, Z, Lambda, W, backward_error, condition, factors] = self;
  visit(status, chart, is_real, Z, Lambda, W, backward_error, condition);
}

template <SameAs<Track::Departure> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [distance, roots] = self;
  visit(distance, roots);
}

template <SameAs<Track> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [pair, series, functions, roots, modes, arriving, departure, told_apart, strand, passed, met] = self;
  visit(pair, series, functions, roots, modes, arriving, departure, told_apart, strand, passed, met);
}

template <SameAs<Linearization> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [M, C, K, A] = self;
  visit(M, C, K, A);
}

template <SameAs<TangentBasis> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [T, is_identity] = self;
  visit(T, is_identity);
}

template <SameAs<ReducedPencil> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [M, C, K] = self;
  visit(M, C, K);
}

template <SameAs<PathNode> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [p, path, tracks, linearization, basis, pencil] = self;
  visit(p, path, tracks, linearization, basis, pencil);
}

template <SameAs<PathPlane> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [x, p] = self;
  visit(x, p);
}

template <SameAs<Event> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [kind, p, s, modes, half_width, puiseux, direction, value, shape, sensitivity, shift, retrackings,
         node] = self;
  visit(kind, p, s, modes, half_width, puiseux, direction, value, shape, sensitivity, shift, retrackings,
        node);
}

template <SameAs<EvaluationCounts> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [residual, linearization] = self;
  visit(residual, linearization);
}

template <SameAs<ModeCounts> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [factorizations, iterations, solves, passed, modal_bases, modal_solves] = self;
  visit(factorizations, iterations, solves, passed, modal_bases, modal_solves);
}

template <SameAs<RunCounts> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [evaluations, modes, iterations, factorizations, spectra, event_factorizations,
         certificate_factorizations, certificate_bases, equilibrium, reduction, correction, differentiation,
         matching, certificate, events, output] = self;
  visit(evaluations, modes, iterations, factorizations, spectra, event_factorizations,
        certificate_factorizations, certificate_bases, equilibrium, reduction, correction, differentiation,
        matching, certificate, events, output);
}

template <SameAs<Rejections> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [inaccurate, no_equilibrium, mode_lost, mismatch, merged, uncertified] = self;
  visit(inaccurate, no_equilibrium, mode_lost, mismatch, merged, uncertified);
}

template <SameAs<Regroupings> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [joined, parted, charts, repaired, planes] = self;
  visit(joined, parted, charts, repaired, planes);
}

template <SameAs<TraceResult> Self, class Visit>
static void fields(Self& self, Visit& visit) {
  auto& [status, message, notes, nodes, n_modes, n_columns, n_available, n_infinite, n_independent, order,
         reached, s_ref, events, mode_steps, certified_steps, rejections, regroupings, counts, seconds] =
      self;
  visit(status, message, notes, nodes, n_modes, n_columns, n_available, n_infinite, n_independent, order,
        reached, s_ref, events, mode_steps, certified_steps, rejections, regroupings, counts, seconds);
}

template <class Self, class Visit>
void Tracer::fields(Self& self, Visit& visit) {
  visit(self.problem_.order, self.problem_.s_ref, self.problem_.s_max, self.problem_.route);
  visit(self.result_, self.control_, self.direction_, self.node_, self.previous_, self.last_step_,
        self.tried_, self.tried_step_, self.strands_, self.plane_, self.bridge_, self.branch_.coordinate,
        self.branch_.p, self.branch_points_, self.bridges_tried_, self.uncertified_below_, self.follows_all_,
        self.partners_, self.part_reach_, self.watches_, self.no_veerings_, self.merges_at_node_,
        self.largest_position_, self.turned_step_, self.longest_step_);
}

std::string Tracer::save() const {
  ArchiveWriter archive;
  fields(*this, archive);
  return archive.bytes();
}

void Tracer::restore(std::string_view bytes) {
  try {
    ArchiveReader archive(bytes);
    fields(*this, archive);
    archive.finish();
  } catch (const ArchiveError& error) {
    throw InputError(std::string("the state of the trace is damaged: ") + error.what());
  }
  if (const std::string fault = misfit(); !fault.empty())
    throw InputError("the state of the trace does not fit the scene: " + fault);
  seconds_before_ = result_.seconds;
  begin_ = std::chrono::steady_clock::now();
}

TraceResult Tracer::resume() {
  follow();
  result_.seconds = seconds_so_far();
  return std::move(result_);
}

namespace {

/// Sizes that everything at a point must have.
struct PointSizes {
  Eigen::Index parameters = 0, coordinates = 0, constraints = 0, freedoms = 0;
  int columns = 0;  ///< modes
};

/// At least one coefficient, each of that size.
template <class Coefficients>
bool all_are(const Coefficients& series, Eigen::Index rows, Eigen::Index columns) {
  for (const auto& coefficient : series) {
    if (coefficient.rows() != rows || coefficient.cols() != columns) return false;
  }
  return !series.empty();
}

bool fits(const std::vector<int>& modes, Eigen::Index size, int columns) {
  for (const int mode : modes) {
    if (mode < Track::guest || mode >= columns) return false;
  }
  return static_cast<Eigen::Index>(modes.size()) == size;
}

bool fits(const Track& track, const PointSizes& sizes) {
  const Eigen::Index k = track.pair.Lambda.rows();
  const Eigen::Index n = sizes.freedoms;
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

bool fits(const PathNode& node, const PointSizes& sizes) {
  const Eigen::Index n = sizes.coordinates;
  const auto series = [](const VectorSeries& columns, Eigen::Index rows) {
    return columns.rows() == rows && columns.cols() >= 1 && columns.cols() <= max_order + 1;
  };
  for (const Track& track : node.tracks) {
    if (!fits(track, sizes)) return false;
  }
  const Linearization& full = node.linearization;
  return series(node.path.parameters, sizes.parameters) && series(node.path.x, n) &&
         series(node.path.lambda, sizes.constraints) && all_are(full.M, n, n) && all_are(full.C, n, n) &&
         all_are(full.K, n, n) && all_are(full.A, sizes.constraints, n) &&
         all_are(node.basis.T, n, sizes.freedoms) && all_are(node.pencil.M, sizes.freedoms, sizes.freedoms) &&
         all_are(node.pencil.C, sizes.freedoms, sizes.freedoms) &&
         all_are(node.pencil.K, sizes.freedoms, sizes.freedoms);
}

/// The same up to rounding, whatever the scene reads them from.
bool same_matrices(const PathProblem& problem, const PathNode& node) {
  const Model& model = problem.model;
  const Path here{parameters_at(problem, node.p), node.path.x.col(0), node.path.lambda.col(0)};
  EvaluationCounts counts = model.new_counts();
  Linearization now;
  if (model.linearize(here, 0, now, counts)) return false;
  const auto same = [](const SystemMatrix& a, const SystemMatrix& b) {
    return (a.dense() - b.dense()).norm() <= 1e-9 * b.norm();
  };
  const Linearization& before = node.linearization;
  return same(now.M[0], before.M[0]) && same(now.C[0], before.C[0]) && same(now.K[0], before.K[0]) &&
         same(now.A[0], before.A[0]);
}

}  // namespace

std::string Tracer::misfit() const {
  const Model& model = problem_.model;
  const PointSizes sizes{static_cast<Eigen::Index>(model.description().parameters.size()),
                         model.n_coordinates(), model.n_constraints(), result_.n_independent,
                         result_.n_columns};
  const std::size_t effects = model.description().effects.size();
  const EvaluationCounts& counts = result_.counts.evaluations;
  if (counts.residual.size() != effects || counts.linearization.size() != effects) return "other effects";
  if (problem_.order < 1 || problem_.order >= max_order || result_.order != problem_.order)
    return "no order of a series";
  if (sizes.freedoms < 1 || sizes.freedoms > sizes.coordinates || sizes.columns < 1) return "other freedoms";
  if (!fits(node_, sizes)) return "another size of the last point";
  if (last_step_ != 0.0 && !fits(previous_, sizes)) return "another size of the point before it";
  if (tried_ && !fits(*tried_, sizes)) return "another size of a point that was tried";
  if (plane_ && plane_->x.size() != sizes.coordinates) return "another size of a plane";
  for (const auto& [key, watch] : watches_) {
    if (key.first < 0 || key.second >= criteria_.size()) return "other events";
  }
  for (const auto& list : {result_.events, no_veerings_}) {
    for (const Event& event : list) {
      if (event.kind < EventKind::flutter || event.kind > EventKind::extremum) return "no kind of an event";
      for (const int mode : event.modes) {
        if (mode < 0 || mode >= sizes.columns) return "an event of a mode that is not there";
      }
    }
  }
  if (!same_matrices(problem_, node_))
    return "other matrices at " + at_parameter(node_.p) + "; has a file of matrices changed since?";
  return "";
}

}  // namespace eigentrail
