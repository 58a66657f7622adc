#include "continuation/trace/stop_remarks.hpp"

#include <cmath>
#include <sstream>

#include "continuation/events/event_search.hpp"
#include "continuation/step/step_error.hpp"
#include "core/texts.hpp"
#include "eigentrail/core/constraint_factorization.hpp"

namespace eigentrail {
namespace {

/// Smallest angle between constraints, in rad, up to which the message names nearly dependent constraints as
/// the reason why the steps became too small. It affects only the message.
constexpr double singular_angle = 1e-3;
/// An eigenvalue is close to zero if it is below this many references. There rounding, which does not become
/// smaller with the eigenvalue, may exceed tolerance * reference. It affects only the message.
constexpr double beside_zero = 100.0;

/// The remark that constraints become dependent, as where links of a mechanism come to lie in one line. The
/// number of freedoms changes there, and the path cannot be followed further. Empty if they do not.
std::string remark_on_constraints(const PathNode& node) {
  const double angle = ConstraintFactorization(node.linearization.A[0]).independence();
  if (angle > singular_angle) return {};
  return "; the constraints come to depend on each other (least angle " + short_text(angle, 2) +
         " rad), as where links of a mechanism lie in one line";
}

/// The remark that the reference is too small for an eigenvalue close to zero: tolerance * reference is then
/// below the rounding of the eigenvalue. The reference is small if all modes are slow at the start. Empty if
/// no eigenvalue of the track is close to zero.
std::string remark_on_zero(const Track& track, double reference) {
  const bool is_beside = track.roots.cwiseAbs().minCoeff() < beside_zero * reference;
  if (track.pair.chart != Chart::finite || !is_beside) return {};
  return "; beside zero rounding exceeds tolerance * reference: give a larger `reference`, now " +
         short_text(reference, 3) + " 1/s";
}

/// The modes of a track as "mode 3, 4: ", counted from 1; empty if it has none.
std::string names_of(const Track& track) {
  std::string who;
  for (const int mode : track.modes) {
    if (mode >= 0) who += (who.empty() ? "mode " : ", ") + std::to_string(mode + 1);
  }
  return who.empty() ? who : who + ": ";
}

}  // namespace

std::string too_small_message(const PathProblem& problem, const TraceOptions& options, const PathNode& node,
                              const Verdict& verdict) {
  std::string who;
  std::string remarks = remark_on_constraints(node);
  if (verdict.track >= 0) {
    const Track& track = node.tracks[static_cast<std::size_t>(verdict.track)];
    who = names_of(track);
    if (verdict.kind == Verdict::Kind::inaccurate) remarks += remark_on_zero(track, problem.s_ref);
  }
  return "the step became too small after " + place_text(options, node.p) + ": " + who + verdict.reason +
         remarks;
}

void take_least_known(const PathProblem& problem, const PathFrame& frame, const PathNode& node, double along,
                      LeastKnown& least) {
  for (const Track& track : node.tracks) {
    if (track.size() > 1 || track.departure || track.modes[0] < 0) continue;
    const double rounding = known_rounding(frame, track) * sensitivity_to_rounding(track) +
                            along * std::abs(track.functions(0, 1));
    const double error = rounding / std::max(std::abs(track.roots[0]), problem.reference(track.pair.chart));
    if (error > least.error) least = {error, track.modes[0], node.p};
  }
}

std::string rounding_note(const TraceOptions& options, const LeastKnown& least) {
  std::ostringstream text;
  text.precision(1);
  text << "mode " << least.mode + 1 << ": rounding leaves the eigenvalue known to " << std::scientific
       << least.error << " of its magnitude at " << place_text(options, least.p);
  return text.str();
}

}  // namespace eigentrail
