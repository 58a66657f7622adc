#include "eigentrail/stability/boundary.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <utility>

#include "core/parallel.hpp"
#include "stability/corners.hpp"
#include "stability/extremum_walk.hpp"

namespace eigentrail {
namespace {

/// Progress reported after the scan of the lines, and after the walks.
constexpr double scanned = 0.4;
constexpr double walked = 0.5;
/// A seed is accurate to the trace's tolerance. One that Newton's method moves farther than this, in the
/// scaled window, is rejected: Newton found another boundary.
constexpr double longest_correction = 0.03;
/// If |grad g| over the scaled window is less than this multiple of |s| (divergence: of the norm of K), g
/// counts as constant: its zero set is no curve.
constexpr double flat = 1e-8;

class BoundarySearch {
 public:
  BoundarySearch(const Model& model, const BoundaryOptions& options, const BoundaryProgress& progress)
      : options_(options), progress_(progress), window_(model, options) {}

  BoundaryResult run();

 private:
  bool scan();
  void walk();
  void follow(const std::vector<BoundarySeed>& seeds);
  void follow(const BoundarySeed& seed);
  std::optional<CurvePoint> start_on(const BoundarySeed& seed, const BoundaryFunction& function);
  Situation correct_seed(const BoundarySeed& seed, const BoundaryFunction& function);
  void finish();
  void note(const Finding& finding) {
    std::vector<std::string>& places = findings_[finding.what];
    if (std::find(places.begin(), places.end(), finding.where) == places.end())
      places.push_back(finding.where);
  }
  void fail(const std::string& message) {
    result_.status = BoundaryStatus::incomplete;
    if (result_.message.empty()) result_.message = message;
  }
  void report(double share) const {
    if (progress_) progress_(share, points_);
  }
  double spacing() const { return 1.0 / (options_.lines + 1); }

  const BoundaryOptions& options_;
  const BoundaryProgress& progress_;
  Window window_;
  BoundaryResult result_;
  std::vector<BoundarySeed> seeds_;
  std::vector<LineExtremum> extrema_;
  std::vector<FollowedCurve> curves_;
  std::map<std::string, std::vector<std::string>> findings_;  ///< per finding: the places where it holds
  int points_ = 0;
  double share_ = 0.0;  ///< share of the work that is done, 0 to 1
};

/// The four edges of the window first, then the inner lines.
std::vector<ScanLine> scan_lines(int inner) {
  std::vector<ScanLine> lines;
  for (const int along : {0, 1}) {
    for (const double held : {0.0, 1.0}) lines.push_back({along, held});
  }
  for (const int along : {0, 1}) {
    for (int i = 1; i <= inner; ++i) lines.push_back({along, static_cast<double>(i) / (inner + 1)});
  }
  return lines;
}

bool BoundarySearch::scan() {
  const std::vector<ScanLine> lines = scan_lines(options_.lines);
  std::vector<LineScan> scans(lines.size());
  std::mutex mutex;
  std::size_t done = 0;
  in_parallel(lines.size(), 0, [&](std::size_t i) {
    scans[i] = scan_line(window_, options_, lines[i]);
    const std::lock_guard lock(mutex);
    report(scanned * static_cast<double>(++done) / static_cast<double>(lines.size()));
  });
  result_.lines = static_cast<int>(lines.size());
  std::vector<double> references;
  for (LineScan& scan : scans) {
    if (scan.started) references.push_back(scan.s_ref);
    for (const Finding& finding : scan.findings) note(finding);
    result_.counts += scan.counts;
    std::move(scan.seeds.begin(), scan.seeds.end(), std::back_inserter(seeds_));
    std::move(scan.extrema.begin(), scan.extrema.end(), std::back_inserter(extrema_));
  }
  result_.seeds = static_cast<int>(seeds_.size());
  if (references.empty()) {
    result_.status = BoundaryStatus::no_equilibrium;
    result_.message = scans.front().findings.front().where;
    return false;
  }
  std::nth_element(references.begin(),
                   references.begin() + static_cast<std::ptrdiff_t>(references.size() / 2), references.end());
  result_.s_ref = options_.trace.reference.value_or(references[references.size() / 2]);
  window_.set_reference(result_.s_ref);
  return true;
}

void BoundarySearch::walk() {
  std::vector<std::optional<BoundarySeed>> found(extrema_.size());
  std::vector<RunCounts> counts(extrema_.size());
  in_parallel(extrema_.size(), 0, [&](std::size_t i) {
    found[i] = walk_to_boundary(window_, options_, extrema_[i], 0.5 * spacing(), counts[i]);
  });
  result_.walks = static_cast<int>(extrema_.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    result_.counts += counts[i];
    if (found[i]) seeds_.push_back(*found[i]);
  }
  report(walked);
}

/// The point of the boundary near a seed, by Newton's method. The first attempt moves along the line on which
/// the seed was found, so a seed on an edge stays there. Further attempts move along grad g, P and Q.
Situation BoundarySearch::correct_seed(const BoundarySeed& seed, const BoundaryFunction& function) {
  const PathProblem problem = window_.at(seed.place);
  const PathPoint point =
      reduce_at(problem, problem.parameters[problem.traced], seed.equilibrium, Matrix(), result_.counts);
  Situation failed;
  failed.status = point.status;
  failed.message = point.message;
  if (point.status != PointStatus::computed) return failed;
  const Spectrum spectrum = compute_spectrum(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
  ++result_.counts.spectra;
  failed.status = PointStatus::mode_lost;
  if (spectrum.modes.empty()) return failed;
  const auto nearest = std::min_element(
      spectrum.modes.begin(), spectrum.modes.end(),
      [&](const auto& a, const auto& b) { return std::abs(a.s - seed.s) < std::abs(b.s - seed.s); });
  if (seed.kind != BoundaryKind::divergence && nearest->s.imag() == 0.0) return failed;
  PlaceGuess guess;
  guess.place = seed.place;
  guess.equilibrium = {point.equilibrium.x, point.equilibrium.lambda, true};
  guess.block = starting_block(seed.kind, point, *nearest);
  guess.basis = point.basis.T[0];
  const Place gradient_itself = Place::Zero();  // correct_along takes zero as the direction of grad g
  for (const Place& direction :
       {seed.direction, gradient_itself, Place(Place::UnitX()), Place(Place::UnitY())}) {
    const Situation there = correct_along(window_, function, guess, direction, result_.counts);
    const bool near = there.status == PointStatus::computed && Window::contains(there.place) &&
                      (there.place - seed.place).norm() < longest_correction;
    if (near) return there;
    failed.message = there.status == PointStatus::computed
                         ? "Newton's method left for " + window_.text(there.place)
                         : there.message;
  }
  return failed;
}

/// The first point of a curve from a seed; empty if there is none. Notes the seed if Newton's method fails.
std::optional<CurvePoint> BoundarySearch::start_on(const BoundarySeed& seed,
                                                   const BoundaryFunction& function) {
  const Situation there = correct_seed(seed, function);
  if (there.status != PointStatus::computed) {
    note({"changes of stability that could not be followed",
          boundary_name(seed.kind) + " near " + window_.text(seed.place) + ": " + there.message});
    fail("a change of stability could not be followed");
    return std::nullopt;
  }
  const double tau = there.functions(0, 0).real();
  const double delta = there.functions.rows() > 1 ? there.functions(1, 0).real() : 0.0;
  // tau = 0 with two real eigenvalues of opposite sign (flutter), or tau of the wrong sign (damping ratio).
  if (function.passed_end(tau, delta)) return std::nullopt;
  const auto gradients = function_gradients(window_, there, result_.counts);
  const double size = seed.kind == BoundaryKind::divergence
                          ? there.pencil.K[0].norm()
                          : std::max(there.pair.Lambda.norm(), window_.reference());
  if (!gradients || !(gradients->row(0).norm() > flat * size)) return std::nullopt;
  return expand_curve(window_, function, there, Place::Zero(), result_.counts);
}

void BoundarySearch::follow(const BoundarySeed& seed) {
  const double tolerance = options_.trace.tolerance;
  const BoundaryFunction function{seed.kind, options_.damping_ratio.value_or(0.0)};
  const std::optional<CurvePoint> start = start_on(seed, function);
  if (!start) return;
  const bool known = std::any_of(curves_.begin(), curves_.end(), [&](const FollowedCurve& curve) {
    return curve.function.kind == seed.kind &&
           curve.passes(start->place, start->s, tolerance, window_.reference());
  });
  if (known) return;
  result_.islands += seed.walked ? 1 : 0;
  ++points_;
  const OnPoint on_point = [this] {
    ++points_;
    report(share_);
  };
  curves_.push_back(follow_curve(window_, function, {tolerance, options_.trace.max_nodes}, *start, on_point,
                                 result_.rejected_steps, result_.counts));
  if (curves_.back().steps.empty()) curves_.pop_back();  // it touches the window in a single point
}

/// One note per finding, with the number of its places and the first of them.
std::vector<std::string> told(const std::map<std::string, std::vector<std::string>>& findings) {
  std::vector<std::string> notes;
  for (const auto& [what, places] : findings) {
    const std::string count = places.size() == 1 ? "" : std::to_string(places.size()) + ", first ";
    notes.push_back(what + ": " + count + places.front());
  }
  return notes;
}

void BoundarySearch::finish() {
  FoundCorners found = find_corners(window_, curves_, options_.trace.tolerance, result_.counts);
  result_.corners = std::move(found.corners);
  for (const Place& place : found.apart)
    note({"intersections of curves that belong to different equilibria, which are no corners",
          window_.text(place)});
  result_.notes = told(findings_);
  for (const FollowedCurve& followed : curves_) {
    BoundaryCurve curve;
    curve.kind = followed.function.kind;
    for (const CurvePoint& point : followed.points) {
      if ((point.flags & seed_flag) != 0) curve.mode = "mode " + std::to_string(point.number);
      curve.points.push_back({window_.declared(point.place), window_.declared_direction(point.tangent),
                              point.s, point.others, point.shape, point.path.x.col(0), point.flags});
    }
    for (const ChordStep& step : followed.steps) curve.steps.push_back(stored_step(window_, step));
    curve.begin = followed.begin;
    curve.end = followed.end;
    curve.begin_reason = followed.begin_reason;
    curve.end_reason = followed.end_reason;
    if (curve.begin == CurveEnd::lost) fail("a curve was lost: " + curve.begin_reason);
    if (curve.end == CurveEnd::lost) fail("a curve was lost: " + curve.end_reason);
    result_.curves.push_back(std::move(curve));
  }
}

BoundaryResult BoundarySearch::run() {
  const auto begin = std::chrono::steady_clock::now();
  if (scan()) {
    walk();
    for (std::size_t i = 0; i < seeds_.size(); ++i) {
      share_ = walked + (1.0 - walked) * static_cast<double>(i) / static_cast<double>(seeds_.size());
      follow(seeds_[i]);
    }
    finish();
  }
  result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return std::move(result_);
}

}  // namespace

BoundaryResult find_boundaries(const Model& model, const BoundaryOptions& options,
                               const BoundaryProgress& progress) {
  return BoundarySearch(model, options, progress).run();
}

std::string boundary_name(BoundaryKind kind) {
  switch (kind) {
    case BoundaryKind::flutter:
      return "flutter";
    case BoundaryKind::divergence:
      return "divergence";
    default:
      return "damping_ratio";
  }
}

std::string curve_end_name(CurveEnd end) {
  switch (end) {
    case CurveEnd::edge:
      return "edge";
    case CurveEnd::closed:
      return "closed";
    case CurveEnd::takens_bogdanov:
      return "takens_bogdanov";
    case CurveEnd::equilibrium_ends:
      return "equilibrium_ends";
    case CurveEnd::exceptional_point:
      return "exceptional_point";
    default:
      return "lost";
  }
}

std::string corner_name(CornerKind kind) {
  return kind == CornerKind::intersection ? "intersection" : "takens_bogdanov";
}

}  // namespace eigentrail
