#include <algorithm>
#include <cmath>
#include <sstream>

#include "continuation/idle_freedom.hpp"
#include "continuation/regrouping.hpp"
#include "continuation/starting_tracks.hpp"
#include "continuation/tracer.hpp"
#include "eigentrail/continuation/order_choice.hpp"
#include "eigentrail/continuation/route_choice.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

constexpr double reference_share = 1e-3;  ///< s_ref / median |s| at the start
constexpr double few_share = 4.0;         ///< freedoms per mode above which modes are few
constexpr double no_force = 1e-16;        ///< 1/s^2: stiffness per mass that is rounding
constexpr double infinity_share = 1e4;    ///< s_max / largest |s| at the start
/// A start that moves by more than this, relatively, was no eigenvalue of its own.
constexpr double largest_drift = 1e-2;

}  // namespace

bool Tracer::start() {
  RunCounts& counts = result_.counts;
  const Vector guess = problem_.model.initial_guess(parameters_at(problem_, options_.from));
  PathPoint point = reduce_at(problem_, options_.from, {guess, Vector()}, Matrix(), counts);
  if (point.status != PointStatus::computed) return stop(TraceStatus::no_equilibrium, point.message);
  result_.n_independent = point.pencil.size();
  const int cheapest = cheapest_order({result_.n_independent, options_.certify}, options_.tolerance);
  use_order(options_.order.value_or(cheapest));
  bridge_start(point);
  const auto modes = starting_modes(point);
  if (!modes) return false;
  std::optional<PathNode> node;
  if (!start_tracks(point, *modes, node)) return false;
  observer_.started({problem_.s_ref, result_.n_available, result_.n_modes, result_.order});
  node_ = std::move(*node);
  record_branch_point(node_);
  record_meetings_at_start();
  if (!emit(node_, nullptr)) return false;
  if (!on_branch_point(options_.from)) return true;
  const int choice = choice_at(branch_points_++);
  return choice == 1 || leave_path(choice);
}

void Tracer::use_order(int order) {
  result_.order = problem_.order = order;
  // The interpolant of order q converges like (h / 2d)^(2q+2) for a meeting at distance d: nearer ones limit
  // the step.
  part_reach_ = 0.7 * std::pow(options_.tolerance, -1.0 / (2.0 * order + 2.0));
}

/// All modes by ascending |s|, how many of them are followed, and the magnitudes that count as zero and
/// infinite.
std::optional<std::vector<StartingMode>> Tracer::starting_modes(const PathPoint& point) {
  const ReducedPencil& pencil = point.pencil;
  const StageTimer timer(result_.counts.modes_seconds);
  // Vectors of a few modes are cheaper one by one.
  const bool few = options_.modes && few_share * *options_.modes < static_cast<double>(pencil.size());
  Spectrum spectrum = few ? compute_eigenvalues(pencil.M[0], pencil.C[0], pencil.K[0])
                          : compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]);
  ++result_.counts.spectra;
  result_.n_infinite = spectrum.n_infinite;
  result_.n_available = static_cast<int>(spectrum.modes.size());
  const std::string where = " at " + at_parameter(options_.from);
  const std::string idle = idle_coordinate(problem_.model, point);
  if (spectrum.status == SpectrumStatus::singular_pencil || !idle.empty()) {
    stop(TraceStatus::singular_pencil,
         "the pencil is singular" + where + ": every number is an eigenvalue. " +
             (idle.empty()
                  ? "A freedom without mass, damping and stiffness causes this; remove or constrain it"
                  : "A freedom that moves '" + idle +
                        "' has no mass or inertia, no damping and no stiffness; give it inertia, or "
                        "constrain it"));
    return std::nullopt;
  }
  const auto largest = [](const Matrix& matrix) {
    return matrix.size() > 0 ? matrix.cwiseAbs().maxCoeff() : 0.0;
  };
  const double mass = largest(pencil.M[0]);
  // On a branch point the stiffness of a single freedom vanishes, and there alone.
  if (!bridge_ && mass > 0.0 && std::max(largest(pencil.K[0]), largest(pencil.C[0])) <= no_force * mass) {
    stop(TraceStatus::no_modes, "no force acts on the freedoms" + where +
                                    ": all eigenvalues are zero, and there is nothing to follow");
    return std::nullopt;
  }
  if (spectrum.status != SpectrumStatus::complete) {
    stop(TraceStatus::no_modes, "LAPACK's QZ did not converge" + where);
    return std::nullopt;
  }
  auto& modes = spectrum.modes;
  if (modes.empty()) {
    stop(TraceStatus::no_modes, "there are no modes to follow" + where +
                                    (result_.n_independent == 0 ? ": the constraints leave no freedom" : ""));
    return std::nullopt;
  }
  result_.n_modes = std::min(options_.modes.value_or(result_.n_available), result_.n_available);
  result_.n_columns = result_.n_modes;
  // Infinite eigenvalues are not followed: the checksum would miss them.
  follows_all_ = result_.n_modes == result_.n_available && spectrum.n_infinite == 0;
  problem_.route =
      cheapest_route(problem_.structure, {pencil.size(), result_.n_modes, follows_all_, problem_.order});
  // On a branch point eigenvalues vanish; how large they are beside it tells what is small.
  const auto beside = bridge_ ? spectrum_beside_branch_point() : std::nullopt;
  const auto& typical = beside ? beside->modes : modes;
  const auto middle = std::min(static_cast<std::size_t>(result_.n_modes) / 2, typical.size() - 1);
  const double median = std::abs(typical[middle].s);
  // A median of rounding (rigid-body modes) measures nothing; the pencil's own scale does.
  problem_.s_ref = options_.reference.value_or(reference_share * std::max(median, 1e-6 * spectrum.scale));
  problem_.s_max = infinity_share * std::max(std::abs(typical.back().s), problem_.s_ref);
  result_.s_ref = problem_.s_ref;
  return std::make_optional(std::move(modes));
}

bool Tracer::start_tracks(PathPoint& point, const std::vector<StartingMode>& modes,
                          std::optional<PathNode>& node) {
  const double least_scale = bridge_ ? problem_.s_ref / reference_share : 0.0;
  const auto groups = starting_groups(point.pencil, modes, result_.n_modes, problem_.s_ref, least_scale);
  for (const StartingGroup& group : groups) {
    const StageTimer timer(result_.counts.modes_seconds);
    point.pairs.push_back(correct_pair(PencilAtPoint(point.pencil), group.pair, problem_.s_ref,
                                       problem_.corrector, result_.counts.modes));
    const InvariantPair& pair = point.pairs.back();
    const double moved = std::abs(pair.Lambda.trace() - group.roots.sum()) / static_cast<double>(pair.size());
    const double scale = std::max(group.roots.cwiseAbs().maxCoeff(), problem_.s_ref);
    if (pair.status == PairStatus::converged && moved < largest_drift * scale) continue;
    std::ostringstream message;
    message << "the corrector did not converge to the mode" << (group.roots.size() > 1 ? "s" : "")
            << " at s =";
    for (const Complex s : group.roots)
      message << ' ' << s.real() << (s.imag() < 0 ? " - " : " + ") << std::abs(s.imag()) << 'j';
    message << " at " << at_parameter(options_.from) << "; begin the trace elsewhere, or follow fewer modes";
    return stop(TraceStatus::multiple_mode, message.str());
  }
  node = differentiate_point(problem_, point, result_.counts);
  if (!node) return stop(TraceStatus::multiple_mode, "a series at the start is not finite");
  for (std::size_t i = 0; i < groups.size(); ++i) {
    Track& track = node->tracks[i];
    track.modes = groups[i].modes;
    track.roots = in_order_of(groups[i].roots, track.roots);
    if (track.pair.is_real && track.size() > 1) settle_real_block(track);
    track.arriving = track.modes;
  }
  return true;
}

}  // namespace eigentrail
