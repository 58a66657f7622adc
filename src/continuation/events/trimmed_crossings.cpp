#include "continuation/events/trimmed_crossings.hpp"

#include <cmath>

#include "continuation/events/event_record.hpp"
#include "eigentrail/steady/kkt_factorization.hpp"

namespace eigentrail {
namespace {

/// In steps: distance from an end of the step that is a fold, where the sign is taken instead.
constexpr double beside_fold = 1e-3;
/// Reciprocal condition up to which rounding decides the sign, as where nothing holds a freedom. It also is
/// the accuracy of the place.
constexpr double rounding_decides = 1e-12;
/// As many as a double has bits: rounding ends the search before.
constexpr int most_halvings = 53;

/// The path on a step, from 0 at its left end to 1.
class TrimmedStep {
 public:
  TrimmedStep(const EventSearch& search, const Step& step)
      : problem_(search.problem()),
        counts_(search.solver.counts().evaluations),
        path_(0.0, step.h, step.left->path, step.right.path, problem_.traced, true),
        length_(step.h) {}

  /// Sign of the determinant over that of dp/dsigma; 0 where rounding decides it.
  int sign(double t) const {
    const Path path = path_.path(t * length_, 1);
    const Path at{path.parameters.col(0), path.x.col(0), path.lambda.col(0)};
    Linearization linearization;
    TrimDerivatives trim;
    if (problem_.model.linearize(at, 0, linearization, counts_) ||
        problem_.model.trim_derivatives(at, trim, counts_))
      return 0;
    const KktFactorization kkt(linearization.K[0], linearization.A[0], trim);
    if (!(kkt.reciprocal_condition() > rounding_decides)) return 0;
    return path.parameters(problem_.traced, 1) > 0.0 ? kkt.orientation() : -kkt.orientation();
  }

  double p(double t) const { return path_.path(t * length_, 0).parameters(problem_.traced, 0); }

 private:
  const PathProblem& problem_;
  EvaluationCounts& counts_;
  Bridge path_;
  double length_;
};

/// Where the sign changes between a and b, by bisection.
double place_of_change(const TrimmedStep& path, double a, double b, int sign_at_a) {
  for (int i = 0; i < most_halvings; ++i) {
    const double middle = 0.5 * (a + b);
    const int sign = path.sign(middle);
    if (sign == 0) return middle;
    (sign == sign_at_a ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

}  // namespace

FoundEvents find_trimmed_crossing(const EventSearch& search, const Step& step) {
  const PathFrame& frame = search.frame();
  if (search.problem().model.n_trims() == 0) return {};
  const auto is_fold = [&](const PathNode& node) {
    return frame.plane && std::abs(fold_distance(frame, node)) <= on_fold;
  };
  const TrimmedStep path(search, step);
  const double begin = is_fold(*step.left) ? beside_fold : 0.0;
  const double end = is_fold(step.right) ? 1.0 - beside_fold : 1.0;
  const int before = path.sign(begin), behind = path.sign(end);
  if (before * behind >= 0) return {};
  Event event;
  event.kind = EventKind::branch_point;
  event.p = path.p(place_of_change(path, begin, end, before));
  event.node = search.node;
  leave_unknown(search.problem(), event);
  FoundEvents found;
  found.notes.push_back("another trimmed path crosses at " + place_text(search.options, event.p) +
                        "; the trace stays on its own, and branches there cannot be chosen");
  found.events.push_back(std::move(event));
  return found;
}

}  // namespace eigentrail
