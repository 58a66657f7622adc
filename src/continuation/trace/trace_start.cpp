#include "continuation/trace/trace_start.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "continuation/events/event_search.hpp"
#include "continuation/point/common_null_vector.hpp"
#include "continuation/tracks/starting_tracks.hpp"
#include "eigentrail/continuation/route_choice.hpp"
#include "eigentrail/continuation/scene_parts.hpp"
#include "eigentrail/model/sample_errors.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"

namespace eigentrail {
namespace {

/// s_ref / median |s| of the followed modes that oscillate at the start, if the options give no reference. A
/// larger value loosens the tolerance of slow modes, a smaller one may ask for more accuracy near zero than
/// rounding allows.
constexpr double reference_share = 1e-3;
/// s_ref is at most this share of the slowest oscillation, so that every oscillation has its relative
/// accuracy. A smaller value costs points where eigenvalues pass zero.
constexpr double share_of_slowest = 0.1;
/// Least |s| that counts, as a share of the scale of the pencil, and the median where none does: smaller ones
/// are rounding, those of rigid-body motions.
constexpr double rigid_share = 1e-6;
/// s_max / largest |s| at the start: magnitude from which an eigenvalue counts as infinite. A larger value
/// lets an eigenvalue be followed farther, a smaller one ends it where it may still be of interest.
constexpr double infinity_share = 1e4;
/// If the number of freedoms exceeds this many times the number of modes, only eigenvalues are computed, and
/// eigenvectors for the followed modes one by one: that costs less than all eigenvectors. Affects time only.
constexpr double few_share = 4.0;
/// Ratio of the largest entry of K or C to that of M (1/s^2, 1/s) up to which the forces on the freedoms are
/// rounding, and all eigenvalues zero. The trace then does not start.
constexpr double no_force = 1e-16;
/// Largest relative change of the mean of a group of eigenvalues by the corrector at the start. After a
/// larger one it has converged to other eigenvalues than those of the spectrum, and the trace does not start.
constexpr double largest_drift = 1e-2;
/// Largest first step as a share of the range. The error of the first step is estimated from one series only,
/// so it is shorter than the longest step; a longer one is more often rejected.
constexpr double longest_first = 0.05;
/// Least first step as a share of the range, against estimates that are far too small. A shorter one takes
/// more steps to grow to the usual length.
constexpr double shortest_first = 1e-6;
/// As a share of the range: where eigenvalues coincide at the first point, the modes are ordered by the
/// eigenvalues this far behind it. At a larger distance other changes are mixed in; at a smaller one the
/// eigenvalues differ too little.
constexpr double beside_start = 1e-6;

/// Whether a mode has a damping ratio below 0.7, or grows as slowly. Those of others say little about the
/// frequencies of a system: overdamped modes may be slower or faster by any factor.
bool oscillates(Complex s) {
  return std::abs(s.imag()) > std::abs(s.real());
}

double largest_entry(const Matrix& matrix) {
  return matrix.size() > 0 ? matrix.cwiseAbs().maxCoeff() : 0.0;
}

std::string text_of(const ComplexVector& roots) {
  std::ostringstream text;
  for (const Complex s : roots)
    text << ' ' << s.real() << (s.imag() < 0 ? " - " : " + ") << std::abs(s.imag()) << 'j';
  return text.str();
}

/// Computes the first point of a trace.
class Start {
 public:
  Start(const PointSolver& solver, const TraceOptions& options, PathProblem& problem, TraceState& state)
      : solver_(solver), options_(options), problem_(problem), state_(state), result_(state.result) {}

  std::optional<StartFailure> compute();

 private:
  using Failure = std::optional<StartFailure>;

  void find_parts();
  void settle_order();
  Failure find_modes();
  Failure check_spectrum(const Spectrum& spectrum) const;
  void list_permanent_zeros(const Spectrum& spectrum);
  void note_unknown_errors();
  int structural_infinities() const;
  void settle_magnitudes(const Spectrum& spectrum);
  void lower_reference();
  Failure correct_groups(const std::vector<StartingGroup>& groups);
  Failure make_node(const std::vector<StartingGroup>& groups);
  std::optional<Spectrum> spectrum_beside_branch_point() const;
  std::string where() const { return " at " + place_text(options_, options_.from); }

  const PointSolver& solver_;
  const TraceOptions& options_;
  PathProblem& problem_;
  TraceState& state_;
  TraceResult& result_;
  PathPoint point_;
  std::vector<StartingMode> modes_;  ///< the whole spectrum, by ascending |s|
};

std::optional<StartFailure> Start::compute() {
  const Vector guess = problem_.model.initial_guess(parameters_at(problem_, options_.from));
  point_ = reduce_at(problem_, options_.from, {guess, Vector()}, Matrix(), solver_.counts());
  if (point_.status != PointStatus::computed)
    return StartFailure{TraceStatus::no_equilibrium, point_.message};
  result_.n_independent = point_.pencil.size();
  find_parts();
  if (problem_.parts) result_.n_independent = problem_.parts->freedoms();
  settle_order();
  if (auto on_branch_point = bridge_start(solver_, state_.frame, point_))
    point_ = std::move(*on_branch_point);
  if (auto failure = find_modes()) return failure;
  const bool bridged = state_.frame.bridge.has_value();
  const double least_scale = bridged ? problem_.s_ref / reference_share : 0.0;
  const auto groups = starting_groups(point_.pencil, modes_, result_.n_modes, problem_.s_ref, least_scale);
  if (auto failure = correct_groups(groups)) return failure;
  // On a branch point the modes are not typical; the reference is that of a place beside it.
  if (!options_.reference && !bridged) lower_reference();
  return make_node(groups);
}

/// A scene at rest may fall apart. Its equilibrium has to be known for that.
void Start::find_parts() {
  if (problem_.parts) return;
  const Equilibrium& equilibrium = point_.equilibrium;
  const SceneOnRange scene = scene_on_range(problem_, options_, equilibrium.x, equilibrium.lambda);
  problem_.rests = scene.rests;
  // Parts of a scene that moves were looked for on one path, and another may begin here.
  if (!scene.parts || (!scene.rests && is_on_branch_point(problem_, point_))) return;
  auto here = turned(scene.parts, equilibrium.kkt.constraints());
  if (!here) return;
  problem_.parts = scene.parts;
  point_.basis = basis_of(std::move(here));
  point_.pencil = reduce(equilibrium.linearization, point_.basis, 0);
}

void Start::settle_order() {
  const int cheapest = cheapest_order({result_.n_independent, options_.certify}, options_.tolerance);
  result_.order = problem_.order = options_.order.value_or(cheapest);
}

/// The reason why the spectrum at the start cannot be followed, if there is one.
std::optional<StartFailure> Start::check_spectrum(const Spectrum& spectrum) const {
  const ReducedPencil& pencil = point_.pencil;
  const std::string null_coordinate = null_vector_coordinate(problem_.model, point_);
  if (spectrum.status == SpectrumStatus::singular_pencil || !null_coordinate.empty()) {
    const std::string advice =
        null_coordinate.empty()
            ? "A freedom without mass, damping and stiffness causes this; remove or constrain it"
            : "A freedom that moves '" + null_coordinate +
                  "' has no mass or inertia, no damping and no stiffness; give it inertia, or "
                  "constrain it";
    return StartFailure{TraceStatus::singular_pencil,
                        "the pencil is singular" + where() + ": every number is an eigenvalue. " + advice};
  }
  // On a branch point the stiffness of a single freedom vanishes without the system being free of forces.
  const double mass = largest_entry(pencil.M[0]);
  const double force = std::max(largest_entry(pencil.K[0]), largest_entry(pencil.C[0]));
  if (!state_.frame.bridge && mass > 0.0 && force <= no_force * mass) {
    return StartFailure{TraceStatus::no_modes,
                        "no force acts on the freedoms" + where() +
                            ": all eigenvalues are zero, and there is nothing to follow"};
  }
  if (spectrum.status != SpectrumStatus::complete)
    return StartFailure{TraceStatus::no_modes, "LAPACK's QZ did not converge" + where()};
  if (!spectrum.modes.empty()) return std::nullopt;
  return StartFailure{TraceStatus::no_modes,
                      "there are no modes to follow" + where() +
                          (result_.n_independent == 0 ? ": the constraints leave no freedom" : "")};
}

/// Computes the spectrum, and decides how many modes are followed and by which route.
std::optional<StartFailure> Start::find_modes() {
  const ReducedPencil& pencil = point_.pencil;
  const StageTimer timer(result_.counts.modes_seconds);
  const bool few =
      options_.modes.count && few_share * *options_.modes.count < static_cast<double>(pencil.size());
  Spectrum spectrum = few ? compute_eigenvalues(pencil) : compute_spectrum(pencil);
  ++result_.counts.spectra;
  result_.n_infinite = std::max(0, spectrum.n_infinite - structural_infinities());
  result_.n_available = static_cast<int>(spectrum.modes.size());
  if (auto failure = check_spectrum(spectrum)) return failure;
  if (problem_.parts && !pencil.parts.empty() && options_.constant_modes == "list")
    mark_permanent_zeros(*problem_.parts, spectrum.modes);
  result_.n_modes = choose_modes(options_.modes, spectrum.modes);
  if (result_.n_modes == 1 && !options_.modes.wants(spectrum.modes.front().s))
    result_.notes.push_back("none of " + in_words(options_.modes) + where() +
                            "; the mode that misses this least is followed");
  result_.n_columns = state_.numbers.count = result_.n_modes;
  state_.copies = starting_copies(spectrum.modes, result_.n_modes);
  list_permanent_zeros(spectrum);
  note_unknown_errors();
  TraceSettings& settings = state_.settings;
  settings.follows_all = result_.n_modes == result_.n_available;
  settings.leaves_out = std::any_of(spectrum.modes.begin() + result_.n_modes, spectrum.modes.end(),
                                    [](const StartingMode& mode) { return !mode.is_permanent_zero; });
  // Infinite eigenvalues are not followed, except those that coordinates of first order have in the form with
  // velocities. Independent parts are followed each by itself.
  const bool none_infinite = spectrum.n_infinite == 2 * pencil.size() - state_size(pencil.M[0]);
  const bool falls_apart = problem_.parts && problem_.parts->falls_apart();
  const bool at_once = settings.follows_all && none_infinite && !falls_apart;
  problem_.route =
      cheapest_route(problem_.structure, {pencil.size(), result_.n_modes, at_once, problem_.order});
  settle_magnitudes(spectrum);
  modes_ = std::move(spectrum.modes);
  return std::nullopt;
}

/// What moves in a rigid-body motion, by the coordinate that moves most: a shaft as a whole, or the
/// coordinate.
std::string rigid_motion(const ModelDescription& description, Eigen::Index most) {
  const std::string& name = description.coordinate_names[static_cast<std::size_t>(most)];
  if (description.shafts.empty()) return name;
  if (name.ends_with(": z")) return "the shaft moves along its axis";
  if (name.ends_with(": rz")) return "the shaft turns about its axis";
  return name;
}

/// A note on the permanent zeros among the modes that are not followed, with what moves in them.
void Start::list_permanent_zeros(const Spectrum& spectrum) {
  int count = 0;
  std::string motions;
  int last_part = -1;
  for (auto mode = spectrum.modes.begin() + result_.n_modes; mode != spectrum.modes.end(); ++mode) {
    if (!mode->is_permanent_zero) continue;
    ++count;
    if (mode->part == last_part) continue;
    last_part = mode->part;
    Eigen::Index most = 0;
    problem_.parts->columns(static_cast<std::size_t>(mode->part)).col(0).cwiseAbs().maxCoeff(&most);
    motions += (motions.empty() ? "" : ", ") + rigid_motion(problem_.model.description(), most);
  }
  if (count == 0) return;
  result_.notes.push_back(std::to_string(count) + (count == 1 ? " eigenvalue is" : " eigenvalues are") +
                          " zero for every " + options_.parameter + " (rigid-body motions, integrators: " +
                          motions + ") and not among the modes chosen");
}

/// A note where the data of the model are interpolated, with an error that is not known along the path.
void Start::note_unknown_errors() {
  const SampleErrors* errors = problem_.model.sample_errors();
  if (errors == nullptr || errors->parameter() == problem_.traced) return;
  const bool none = errors->parameter() == SampleErrors::no_parameter;
  result_.notes.push_back(
      "tables or samples are interpolated, and the error of that is not known: it is stated where " +
      (none ? std::string("what all of them are over is a linear function of the traced parameter")
            : "'" +
                  problem_.model.description()
                      .parameters.names()[static_cast<std::size_t>(errors->parameter())] +
                  "' is traced"));
}

/// Number of infinite eigenvalues that the form with velocities has for every value of the parameter:
/// coordinates without mass have one, those without mass and damping two. The states of elements have no
/// mass.
int Start::structural_infinities() const {
  const CoefficientMatrices all = problem_.model.coefficient_matrices(problem_.parameters, problem_.traced);
  const auto is_zero = [](const std::vector<Matrix>& matrices, Eigen::Index column) {
    return std::all_of(matrices.begin(), matrices.end(), [&](const Matrix& matrix) {
      return matrix.size() == 0 || matrix.col(column).isZero(0.0);
    });
  };
  int count = 0;
  if (all.K.empty()) {  // the matrices are not known
    for (const Effect& effect : problem_.model.description().effects) count += effect.states;
    return count;
  }
  for (Eigen::Index j = 0; j < all.K[0].cols(); ++j) {
    if (is_zero(all.M, j)) count += is_zero(all.C, j) ? 2 : 1;
  }
  return count;
}

/// Magnitudes above `zero`, ascending, of those of the first `n` modes that oscillate; of all of them if none
/// does. Below it is what rounding makes of rigid-body motions.
std::vector<double> typical_sizes(const std::vector<StartingMode>& modes, std::size_t n, double zero) {
  std::vector<double> all, oscillating;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(std::abs(modes[i].s) > zero)) continue;
    all.push_back(std::abs(modes[i].s));
    if (oscillates(modes[i].s)) oscillating.push_back(all.back());
  }
  return oscillating.empty() ? all : oscillating;
}

/// Sets s_ref and s_max, the magnitudes that count as zero and as infinite.
void Start::settle_magnitudes(const Spectrum& spectrum) {
  // On a branch point eigenvalues vanish. Their size beside it is the scale.
  const auto beside = state_.frame.bridge ? spectrum_beside_branch_point() : std::nullopt;
  const std::vector<StartingMode>& typical = beside ? beside->modes : spectrum.modes;
  const double zero = rigid_share * spectrum.scale;
  const std::vector<double> sizes =
      typical_sizes(typical, std::min(static_cast<std::size_t>(result_.n_modes), typical.size()), zero);
  const double median = sizes.empty() ? zero : sizes[sizes.size() / 2];
  problem_.s_ref = result_.s_ref = options_.reference.value_or(reference_share * median);
  const double largest =
      std::abs(std::max_element(typical.begin(), typical.end(), [](const auto& a, const auto& b) {
                 return std::abs(a.s) < std::abs(b.s);
               })->s);
  problem_.s_max = infinity_share * std::max(largest, problem_.s_ref);
}

/// The spectrum at the end of the bridge over the branch point; empty if it has no modes.
std::optional<Spectrum> Start::spectrum_beside_branch_point() const {
  const Bridge& bridge = *state_.frame.bridge;
  const PathPoint point =
      reduce_on(problem_, bridge.path(bridge.end(), 1), point_.basis.T[0], solver_.counts());
  if (point.status != PointStatus::computed) return std::nullopt;
  ++result_.counts.spectra;
  Spectrum spectrum = compute_spectrum(point.pencil);
  if (spectrum.status != SpectrumStatus::complete || spectrum.modes.empty()) return std::nullopt;
  return spectrum;
}

std::optional<StartFailure> Start::correct_groups(const std::vector<StartingGroup>& groups) {
  const StageTimer timer(result_.counts.modes_seconds);
  for (const StartingGroup& group : groups) {
    point_.pairs.push_back(correct_pair(PencilAtPoint(point_.pencil.of(group.pair.part)), group.pair,
                                        problem_.s_ref, problem_.corrector, result_.counts.modes));
    const InvariantPair& pair = point_.pairs.back();
    const double moved = std::abs(pair.Lambda.trace() - group.roots.sum()) / static_cast<double>(pair.size());
    const double scale = std::max(group.roots.cwiseAbs().maxCoeff(), problem_.s_ref);
    if (pair.status == PairStatus::converged && moved < largest_drift * scale) continue;
    return StartFailure{TraceStatus::multiple_mode, "the corrector did not converge to the mode" +
                                                        std::string(group.roots.size() > 1 ? "s" : "") +
                                                        " at s =" + text_of(group.roots) + where() +
                                                        "; begin the trace elsewhere, or follow fewer modes"};
  }
  return std::nullopt;
}

/// Lowers s_ref where an oscillation is slow.
void Start::lower_reference() {
  double slowest = INFINITY;
  for (const InvariantPair& pair : point_.pairs) {
    if (pair.chart != Chart::finite) continue;
    const ComplexVector s = pair_eigenvalues(pair);
    const Vector errors = eigenvalue_rounding(pair, s, problem_.thresholds.rounding.entries);
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      if (oscillates(s[i]) && std::abs(s[i]) > errors[i]) slowest = std::min(slowest, std::abs(s[i]));
    }
  }
  problem_.s_ref = result_.s_ref = std::min(result_.s_ref, share_of_slowest * slowest);
}

std::optional<StartFailure> Start::make_node(const std::vector<StartingGroup>& groups) {
  std::optional<PathNode> node = differentiate_point(problem_, point_, result_.counts);
  if (!node) return StartFailure{TraceStatus::multiple_mode, "a series at the start is not finite"};
  for (std::size_t i = 0; i < groups.size(); ++i) {
    Track& track = node->tracks[i];
    track.modes = groups[i].modes;
    track.roots = in_order_of(groups[i].roots, track.roots);
    if (track.pair.is_real && track.size() > 1) settle_real_block(track, {}, state_.numbers);
    track.arriving = track.modes;
  }
  state_.origin.node = std::move(*node);
  return std::nullopt;
}

}  // namespace

std::optional<StartFailure> compute_start(const PointSolver& solver, const TraceOptions& options,
                                          PathProblem& problem, TraceState& state) {
  return Start(solver, options, problem, state).compute();
}

double first_step(const PathNode& node, const PathProblem& problem, const TraceOptions& options) {
  const double range = std::abs(options.to - options.from);
  if (options.first_step) return *options.first_step;
  const int q = problem.order;
  double step = longest_first * range;
  for (const Track& track : node.tracks) {
    // Chosen so that the series term |c_q| h^q is below 4^(q+1) times the tolerance: the error of the
    // interpolant has the factor |t (t - 1)|^(q+1) <= 4^-(q+1).
    const double allowed = options.tolerance * std::pow(4.0, q + 1) *
                           std::max(std::abs(track.functions(0, 0)), problem.reference(track.pair.chart));
    const double last = std::abs(track.functions(0, q));
    if (last > 0.0) step = std::min(step, std::pow(allowed / last, 1.0 / q));
  }
  return std::max(step, shortest_first * range);
}

namespace {

/// Relative distance up to which eigenvalues coincide at the first point.
constexpr double coincide = 1e-6;

/// Eigenvalues that coincide at the first point get their numbers by ascending magnitude behind it. Without
/// this, rounding would decide which is the first.
void number_by_magnitude(Track& track) {
  ComplexVector& behind = track.departure->roots;
  for (std::size_t a = 0; a < track.met.size(); ++a) {
    for (std::size_t b = a + 1; b < track.met.size(); ++b) {
      const int i = track.met[a], j = track.met[b];
      const bool together = std::abs(track.roots[i] - track.roots[j]) <= coincide * std::abs(track.roots[i]);
      const bool first = track.modes[static_cast<std::size_t>(i)] < track.modes[static_cast<std::size_t>(j)];
      if (together && (std::abs(behind[i]) < std::abs(behind[j])) != first) std::swap(behind[i], behind[j]);
    }
  }
}

/// Whether two tracks of one mode belong to the halves of a conjugate pair of parts and coincide.
bool are_coinciding_conjugates(const PathNode& node, const Track& a, const Track& b) {
  const auto complex_sign = [&](const Track& track) { return node.pencil.of(track.pair.part).complex_sign; };
  const bool are_conjugates = complex_sign(a) > 0 && complex_sign(b) < 0 && b.pair.part == a.pair.part + 1;
  return are_conjugates && a.size() == 1 && b.size() == 1 && a.pair.chart == b.pair.chart &&
         std::abs(a.roots[0] - b.roots[0]) <= coincide * std::abs(a.roots[0]);
}

/// The same for both halves of a conjugate pair of parts: forward and backward whirl of a shaft at rest.
void number_conjugates_by_magnitude(double distance, PathNode& node) {
  const auto behind = [&](const Track& track) {
    return std::abs(block_roots(evaluate_series(track.functions, distance))[0]);
  };
  for (Track& a : node.tracks) {
    for (Track& b : node.tracks) {
      if (!are_coinciding_conjugates(node, a, b)) continue;
      if ((behind(a) < behind(b)) == (a.modes[0] < b.modes[0])) continue;
      std::swap(a.modes, b.modes);
      a.arriving = a.modes;
      b.arriving = b.modes;
    }
  }
}

}  // namespace

std::vector<Birth> order_first_departure(const std::vector<bool>& meets, const PathFrame& frame,
                                         PathNode& node, ModeNumbers& numbers) {
  const double distance = frame.direction * beside_start * frame.range.length();
  std::vector<Birth> births;
  number_conjugates_by_magnitude(distance, node);
  for (std::size_t i = 0; i < node.tracks.size(); ++i) {
    Track& track = node.tracks[i];
    if (!meets[i]) continue;
    const double beside = std::copysign(std::max(std::abs(distance), track.hidden_within), distance);
    track.departure = Track::Departure{beside, block_roots(evaluate_series(track.functions, beside))};
    if (track.pair.is_real) {
      const std::vector<Birth> born = settle_real_block(track, modes_of(node.tracks), numbers);
      births.insert(births.end(), born.begin(), born.end());
    } else {
      number_by_magnitude(track);
    }
    track.arriving = track.modes;
  }
  return births;
}

}  // namespace eigentrail
