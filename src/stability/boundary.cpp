#include "eigentrail/stability/boundary.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <mutex>
#include <utility>

#include "continuation/archived_parts.hpp"
#include "stability/corners.hpp"

namespace eigentrail {
namespace {

/// Progress reported after the scan of the lines, and after the walks.
constexpr double scanned = 0.4;
constexpr double walked = 0.5;
/// What a piece of work on an extremum results in.
using Walk = std::pair<std::optional<BoundarySeed>, RunCounts>;

}  // namespace

// How the pieces of a search are written to an archive and read from it (core/archive.hpp).

Members<6> archived(const BoundarySeed*);
Members<4> archived(const LineExtremum*);
Members<2> archived(const Finding*);
Members<6> archived(const LineScan*);
Members<13> archived(const CurvePoint*);
Members<4> archived(const ChordStep*);
Members<2> archived(const BoundaryFunction*);
Members<2> archived(const ArmEnd*);
Members<7> archived(const FollowedCurve*);
Members<4> archived(const CurveStart*);

namespace {

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

/// One note per finding, with the number of its places and the first of them.
std::vector<std::string> told(const std::map<std::string, std::vector<std::string>>& findings) {
  std::vector<std::string> notes;
  for (const auto& [what, places] : findings) {
    const std::string count = places.size() == 1 ? "" : std::to_string(places.size()) + ", first ";
    notes.push_back(what + ": " + count + places.front());
  }
  return notes;
}

/// The search, in rounds of pieces that are independent of each other: lines, extrema, starts of curves,
/// curves. Every process that takes part goes through all rounds and finds the same.
class BoundarySearch {
 public:
  BoundarySearch(const Model& model, const BoundaryOptions& options, Workers& workers,
                 const BoundaryProgress& progress)
      : options_(options), progress_(progress), workers_(workers), window_(model, options) {}

  std::vector<std::string> scan(const std::vector<std::size_t>& numbers) {
    const std::vector<ScanLine> lines = scan_lines(options_.lines);
    return workers_.compute(
        {"line", numbers,
         [&](std::size_t line) { return packed(scan_line(window_, options_, lines[line])); }},
        [&](std::size_t done, std::size_t, const std::string&) {
          report(scanned * static_cast<double>(done) / static_cast<double>(numbers.size()));
        });
  }

  BoundaryResult follow(const std::vector<std::string>& scans) {
    if (take(scans)) {
      walk();
      start();
      follow_curves();
      finish();
    }
    return std::move(result_);
  }

 private:
  /// Takes over what the scans of all lines have found; false if no line could be begun.
  bool take(const std::vector<std::string>& scans) {
    result_.lines = static_cast<int>(scans.size());
    std::vector<double> references;
    std::string first_reason;
    for (const std::string& bytes : scans) {
      LineScan scan;
      unpack(bytes, scan);
      if (scan.started) references.push_back(scan.s_ref);
      if (&bytes == &scans.front() && !scan.findings.empty()) first_reason = scan.findings.front().where;
      for (const Finding& finding : scan.findings) note(finding);
      result_.counts += scan.counts;
      std::move(scan.seeds.begin(), scan.seeds.end(), std::back_inserter(seeds_));
      std::move(scan.extrema.begin(), scan.extrema.end(), std::back_inserter(extrema_));
    }
    result_.seeds = static_cast<int>(seeds_.size());
    if (references.empty()) {
      result_.status = BoundaryStatus::no_equilibrium;
      result_.message = first_reason;
      return false;
    }
    std::nth_element(references.begin(),
                     references.begin() + static_cast<std::ptrdiff_t>(references.size() / 2),
                     references.end());
    result_.s_ref = options_.trace.reference.value_or(references[references.size() / 2]);
    window_.set_reference(result_.s_ref);
    return true;
  }

  void walk() {
    const auto walk_from = [this](std::size_t extremum) {
      Walk walk;
      walk.first = walk_to_boundary(window_, options_, extrema_[extremum], 0.5 * spacing(), walk.second);
      return packed(walk);
    };
    const std::vector<std::string> found =
        workers_.compute({"extremum", numbers_to(extrema_.size()), walk_from});
    result_.walks = static_cast<int>(extrema_.size());
    for (const std::string& bytes : found) {
      Walk walk;
      unpack(bytes, walk);
      result_.counts += walk.second;
      if (walk.first) seeds_.push_back(std::move(*walk.first));
    }
    report(walked);
  }

  /// The first point of a curve from each seed. Notes the seeds from which Newton's method fails.
  void start() {
    const auto start_from = [this](std::size_t seed) {
      return packed(start_curve(window_, options_, seeds_[seed]));
    };
    const std::vector<std::string> found = workers_.compute({"start", numbers_to(seeds_.size()), start_from});
    for (const std::string& bytes : found) {
      CurveStart start;
      unpack(bytes, start);
      result_.counts += start.counts;
      for (const Finding& finding : start.findings) note(finding);
      if (start.failed) fail("a change of stability could not be followed");
      starts_.push_back(std::move(start.point));
    }
  }

  /// Follows the curve of each seed, in order, that lies on no curve found before. Which curves are found
  /// does not depend on those that other workers have followed in the meantime.
  void follow_curves() {
    std::map<std::size_t, FollowedCurve> ready;
    for (std::size_t seed = 0; seed < seeds_.size(); ++seed) {
      if (!starts_[seed] || is_known(seed)) continue;
      if (!ready.contains(seed)) follow_at_once(next_seeds(seed, ready), ready);
      accept(seed, std::move(ready.at(seed)));
      ready.erase(seed);
    }
  }

  bool is_known(std::size_t seed, const FollowedCurve& curve) const {
    return curve.function.kind == seeds_[seed].kind &&
           curve.passes(starts_[seed]->place(), starts_[seed]->s, options_.trace.tolerance,
                        window_.reference());
  }

  bool is_known(std::size_t seed) const {
    return std::any_of(curves_.begin(), curves_.end(),
                       [&](const FollowedCurve& curve) { return is_known(seed, curve); });
  }

  /// Seeds to follow at the same time: the first one, and others that are likely to lie on other curves, one
  /// of each mode.
  std::vector<std::size_t> next_seeds(std::size_t first,
                                      const std::map<std::size_t, FollowedCurve>& ready) const {
    std::vector<std::size_t> chosen;
    for (std::size_t i = first; i < seeds_.size() && chosen.size() < workers_.size(); ++i) {
      if (!starts_[i] || ready.contains(i)) continue;
      const bool same_mode = std::any_of(chosen.begin(), chosen.end(), [&](std::size_t other) {
        return seeds_[other].kind == seeds_[i].kind && starts_[other]->number == starts_[i]->number;
      });
      const bool likely_known =
          std::any_of(ready.begin(), ready.end(), [&](const auto& one) { return is_known(i, one.second); });
      if (i == first || (!same_mode && !likely_known && !is_known(i))) chosen.push_back(i);
    }
    return chosen;
  }

  void follow_at_once(const std::vector<std::size_t>& seeds, std::map<std::size_t, FollowedCurve>& ready) {
    std::mutex mutex;
    const double share =
        walked + (1.0 - walked) * static_cast<double>(seeds.front()) / static_cast<double>(seeds_.size());
    const OnPoint on_point = [&] {
      const std::scoped_lock lock(mutex);
      ++points_;
      report(share);
    };
    const auto follow_from = [&](std::size_t seed) {
      return packed(follow_curve(window_, function_of(seeds_[seed].kind, options_), options_.trace,
                                 *starts_[seed], on_point));
    };
    const std::vector<std::string> followed = workers_.compute({"curve", seeds, follow_from});
    for (std::size_t i = 0; i < seeds.size(); ++i) unpack(followed[i], ready[seeds[i]]);
  }

  void accept(std::size_t seed, FollowedCurve curve) {
    result_.islands += seeds_[seed].walked ? 1 : 0;
    result_.rejected_steps += curve.rejected_steps;
    result_.counts += curve.counts;
    // Without a step it touches the window in a single point.
    if (!curve.steps.empty()) curves_.push_back(std::move(curve));
  }

  void finish() {
    FoundCorners found = find_corners(window_, curves_, options_.trace.tolerance, result_.counts);
    result_.corners = std::move(found.corners);
    for (const Finding& finding : found.findings) note(finding);
    result_.notes = told(findings_);
    for (const FollowedCurve& followed : curves_) {
      BoundaryCurve curve;
      curve.kind = followed.function.kind;
      for (const CurvePoint& point : followed.points) {
        if ((point.flags & seed_flag) != 0) curve.mode = "mode " + std::to_string(point.number);
        curve.points.push_back({window_.declared(point.place()), window_.declared_direction(point.tangent()),
                                point.s, point.others, point.shape, point.path.x.col(0), point.flags});
      }
      for (const ChordStep& step : followed.steps) curve.steps.push_back(stored_step(window_, step));
      std::tie(curve.begin, curve.begin_reason) = std::tie(followed.begin.how, followed.begin.reason);
      std::tie(curve.end, curve.end_reason) = std::tie(followed.end.how, followed.end.reason);
      for (const ArmEnd& end : {followed.begin, followed.end}) {
        if (end.how == CurveEnd::lost) fail("a curve was lost: " + end.reason);
      }
      result_.curves.push_back(std::move(curve));
    }
  }

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
  Workers& workers_;
  Window window_;
  BoundaryResult result_;
  std::vector<BoundarySeed> seeds_;
  std::vector<LineExtremum> extrema_;
  std::vector<std::optional<CurvePoint>> starts_;  ///< of the seeds
  std::vector<FollowedCurve> curves_;
  std::map<std::string, std::vector<std::string>> findings_;  ///< per finding: the places where it holds
  int points_ = 0;
};

}  // namespace

std::size_t boundary_lines(const BoundaryOptions& options) {
  return scan_lines(options.lines).size();
}

std::vector<std::string> scan_boundaries(const Model& model, const BoundaryOptions& options,
                                         const std::vector<std::size_t>& lines, Workers& workers,
                                         const BoundaryProgress& progress) {
  return BoundarySearch(model, options, workers, progress).scan(lines);
}

BoundaryResult follow_boundaries(const Model& model, const BoundaryOptions& options,
                                 const std::vector<std::string>& scans, Workers& workers,
                                 const BoundaryProgress& progress) try {
  const auto begin = std::chrono::steady_clock::now();
  BoundaryResult result = BoundarySearch(model, options, workers, progress).follow(scans);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
} catch (const ArchiveError& error) {
  throw InputError(std::string("a line of the search is damaged: ") + error.what());
}

BoundaryResult find_boundaries(const Model& model, const BoundaryOptions& options,
                               const BoundaryProgress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  Threads threads(0);
  const std::vector<std::size_t> lines = numbers_to(boundary_lines(options));
  const std::vector<std::string> scans = scan_boundaries(model, options, lines, threads, progress);
  BoundaryResult result = follow_boundaries(model, options, scans, threads, progress);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

std::string boundary_name(BoundaryKind kind) {
  return std::array{"flutter", "divergence", "damping_ratio", "flutter"}.at(static_cast<std::size_t>(kind));
}

std::string curve_end_name(CurveEnd end) {
  return std::array{"edge", "closed", "takens_bogdanov", "equilibrium_ends", "exceptional_point", "lost"}.at(
      static_cast<std::size_t>(end));
}

std::string corner_name(CornerKind kind) {
  return kind == CornerKind::intersection ? "intersection" : "takens_bogdanov";
}

}  // namespace eigentrail
