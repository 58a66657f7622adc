#include "stability/line_scan.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "eigentrail/continuation/eigenvalue_error.hpp"
#include "eigentrail/continuation/recorded_path.hpp"
#include "eigentrail/core/series.hpp"

namespace eigentrail {
namespace {

/// Of the traces of lines.
constexpr double scan_tolerance = 1e-6;
constexpr int steps_per_line = 16;  ///< least number of steps of a trace
constexpr int samples_per_step = 16;
/// Largest instability, relative to max(|s|, reference), behind a walk that counts as a zero.
constexpr double largest_jump = 1e-3;
/// A divergence seed closer to a fold than this, in the scaled window, is the fold itself.
constexpr double beside_fold = 1e-4;
/// Newton's method for a coalescence begins at this distance from it, in the scaled window, where the shapes
/// of both modes differ. Farther ones may lie behind another meeting, nearer ones give a basis with fewer
/// digits.
constexpr double beside_coalescence = 0.01;
/// A trace is complete if it ends no farther from its end value than this multiple of the range.
constexpr double arrived = 1e-9;

/// The kind of a boundary on which a mode has the eigenvalue s.
BoundaryKind kind_of(const BoundaryOptions& options, Complex s) {
  if (options.damping_ratio) return BoundaryKind::damping_ratio;
  return s.imag() == 0.0 ? BoundaryKind::divergence : BoundaryKind::flutter;
}

/// Zero on the boundary, positive if the mode is unstable or less damped than asked.
double instability(const BoundaryOptions& options, Complex s) {
  return function_of(kind_of(options, s), options).instability(s);
}

/// Whether the instability of a mode that changes its sign here passes through zero. If not, it jumps: the
/// eigenvalue passes through infinity, or another mode has been taken for this one.
bool passes_zero(const BoundaryOptions& options, Complex s, double s_ref) {
  return std::abs(instability(options, s)) <= largest_jump * std::max(std::abs(s), s_ref);
}

struct Sample {
  Place place;
  EquilibriumGuess equilibrium;
  ComplexVector s;  ///< of all modes; NaN where a mode does not exist
};

class Scanner {
 public:
  Scanner(const Window& window, const BoundaryOptions& options, const ScanLine& line)
      : window_(window), options_(options), line_(line) {}

  LineScan run() {
    const TraceResult result = trace_line(0.0, 1.0);
    report(result);
    const double end = window_.declared(line_.at(1.0))[line_.along];
    const double range = std::abs(end - window_.declared(line_.at(0.0))[line_.along]);
    const bool complete =
        result.status == TraceStatus::completed && std::abs(result.reached - end) <= arrived * range;
    if (complete) return std::move(scan_);
    // The part of the line beyond the place where the trace ended may be reached from the other end.
    const TraceResult back = trace_line(1.0, 0.0);
    report(back);
    const std::string reason = result.message.empty() ? "the equilibrium turns back" : result.message;
    const int other = 1 - line_.along;
    scan_.findings.push_back(
        {scan_.started ? "lines not searched from end to end" : "lines that could not be begun",
         window_.name(other) + " = " + window_.value_text(other, line_.held) + ": " + reason});
    return std::move(scan_);
  }

 private:
  TraceResult trace_line(double from, double to) {
    const Place held = window_.declared(line_.at(0.5));
    const int other = 1 - line_.along;
    TraceOptions options = options_.trace;
    options.parameter = window_.name(line_.along);
    options.values[window_.name(other)] = held[other];
    options.from = window_.declared(line_.at(from))[line_.along];
    options.to = window_.declared(line_.at(to))[line_.along];
    options.tolerance = scan_tolerance;
    options.certify = false;
    options.events = {.veerings = false, .other_paths = false};  // and extrema are found by the scan itself
    if (options_.damping_ratio) options.events.wanted = {{EventKind::damping_ratio, *options_.damping_ratio}};
    options.first_step.reset();
    options.max_step = std::abs(options.to - options.from) / steps_per_line;
    nodes_.clear();
    PathRecorder recorder;
    TraceObserver observer;
    observer.started = [this](const TraceStart& start) {
      scan_.started = true;
      scan_.s_ref = start.s_ref;
    };
    observer.point = [&](const TracePoint& point) {
      recorder.append(point);
      nodes_.push_back(point.node.path);
      return true;
    };
    TraceResult result = trace(window_.model(), options, observer);
    scan_.counts.modes.factorizations += result.counts.modes.factorizations;
    scan_.counts.spectra += result.counts.spectra;
    path_ = recorder.path();
    before_.reset();
    last_.reset();
    for (std::size_t step = 0; step < path_.steps.size(); ++step) {
      for (int k = step == 0 ? 0 : 1; k <= samples_per_step; ++k)
        look_at({step, static_cast<double>(k) / samples_per_step});
    }
    return result;
  }

  Sample sample(const PathPosition& at) const {
    const Path& left = nodes_[at.step];
    const double h = at.t * path_.steps[at.step].length;
    return {line_.at(window_.scaled(line_.along, path_.parameter_at(at))),
            {evaluate_series(left.x, h), evaluate_series(left.lambda, h), true},
            path_.shown_at(at)};
  }

  void look_at(const PathPosition& at) {
    Sample here = sample(at);
    for (Eigen::Index mode = 0; mode < here.s.size(); ++mode) {
      if (last_ && passes_infinity(at.step, mode, last_->s[mode], here.s[mode]))
        scan_.findings.push_back(
            {"growth that begins or ends at infinity, where a mass or damping vanishes: "
             "no curve is followed there",
             window_.text(here.place)});
      if (!before_) continue;
      add_extremum(mode, instability(options_, before_->s[mode]), instability(options_, last_->s[mode]),
                   instability(options_, here.s[mode]));
    }
    before_ = std::move(last_);
    last_ = std::move(here);
  }

  /// Whether Re s changes its sign between two samples while 1/s is what is followed.
  bool passes_infinity(std::size_t step, Eigen::Index mode, Complex before, Complex here) const {
    const DenseBlock* block = path_.block_of(step, static_cast<int>(mode));
    return block != nullptr && block->chart == Chart::reciprocal && before.real() * here.real() < 0.0;
  }

  void add_extremum(Eigen::Index mode, double before, double here, double behind) {
    const double sign = here < 0.0 ? 1.0 : -1.0;
    if (!(sign * (here - before) > 0.0 && sign * (here - behind) > 0.0)) return;
    const Complex s = last_->s[mode];
    if (options_.damping_ratio && s.imag() == 0.0) return;
    const double least = scan_tolerance * std::max(std::abs(s), scan_.s_ref);
    if (sign * (here - before) < least && sign * (here - behind) < least) return;
    scan_.extrema.push_back({last_->place, s, last_->equilibrium, sign});
  }

  /// Whether the instability of a mode changes its sign at an event.
  bool is_change(const Event& event) const {
    if (event.direction == 0) return false;
    if (options_.damping_ratio) return event.kind == EventKind::damping_ratio;
    return event.kind == EventKind::flutter || event.kind == EventKind::divergence;
  }

  /// The equilibrium at an event, by the series of the point before it.
  EquilibriumGuess equilibrium_at(const Event& event) const {
    for (const PathPosition& at : path_.positions(event.p)) {
      if (static_cast<int>(at.step) + 1 >= event.node) return sample(at).equilibrium;
    }
    const Path& node = nodes_[std::min(static_cast<std::size_t>(event.node), nodes_.size() - 1)];
    return {node.x.col(0), node.lambda.col(0), true};
  }

  /// Seeds where modes pass the axis, where modes without damping coalesce, or a stiffness is lost. Notes
  /// folds of the equilibrium, whose curves are not followed; divergence seeds at a fold are removed.
  void report(const TraceResult& result) {
    for (const Event& event : result.events) {
      const Place place = line_.at(window_.scaled(line_.along, event.p));
      if (event.kind == EventKind::fold) {
        scan_.findings.push_back({"folds of the equilibrium, which are not followed", window_.text(place)});
        std::erase_if(scan_.seeds, [&place](const BoundarySeed& seed) {
          return seed.kind == BoundaryKind::divergence && (seed.place - place).norm() < beside_fold;
        });
      }
      const Place along = Place::Unit(line_.along);
      const auto add = [&](const Place& from, BoundaryKind kind) {
        scan_.seeds.push_back({from, along, kind, event.s, equilibrium_at(event)});
      };
      if (is_change(event)) add(place, kind_of(options_, event.s));
      // Where nothing is damped, modes oscillate on one side of these: no growth changes its sign.
      const bool may_be = event.kind == EventKind::collision || event.kind == EventKind::branch_point;
      if (options_.damping_ratio || event.direction == 0 || !may_be) continue;
      if (event.s == 0.0)
        add(place, BoundaryKind::divergence);
      else
        add(place + (place[line_.along] < 0.5 ? beside_coalescence : -beside_coalescence) * along,
            BoundaryKind::coalescence);
    }
  }

  const Window& window_;
  const BoundaryOptions& options_;
  const ScanLine& line_;
  LineScan scan_;
  RecordedPath path_;
  std::vector<Path> nodes_;  ///< series of the equilibrium at the points of the trace
  std::optional<Sample> before_, last_;
};

// Lengths are in the scaled window.
constexpr int most_steps = 40;
constexpr double smallest_radius = 1e-7;
constexpr int most_sections = 12;
constexpr double close_enough = 1e-6;  ///< close enough to the boundary for Newton's method

/// The Taylor polynomial of degree two of a function about a place.
template <class Value>
struct Quadratic {
  Value value;
  Eigen::Matrix<Value, 2, 1> gradient;
  Eigen::Matrix<Value, 2, 2> hessian;

  Value at(const Place& move) const {
    return value + gradient.cwiseProduct(move).sum() + 0.5 * (hessian * move).cwiseProduct(move).sum();
  }
};

/// One mode at a place with its first and second derivatives.
struct Probe {
  Place place;
  EquilibriumGuess equilibrium;
  Matrix basis;
  Quadratic<Complex> s;
  Quadratic<double> w;  ///< its instability
};

/// The polynomial from series of second order along the directions (1, 0), (0, 1) and (1, 1).
template <class Value>
Quadratic<Value> quadratic(const std::array<Series<Value, 2>, 3>& along) {
  const Value mixed = along[2][2] - along[0][2] - along[1][2];
  return {along[0][0], Eigen::Matrix<Value, 2, 1>{{along[0][1], along[1][1]}},
          Eigen::Matrix<Value, 2, 2>{{2.0 * along[0][2], mixed}, {mixed, 2.0 * along[1][2]}}};
}

Series<double, 2> instability_series(const BoundaryOptions& options, const Series<Complex, 2>& s) {
  Series<double, 2> real, imaginary;
  for (int k = 0; k <= 2; ++k) {
    real[k] = s[k].real();
    imaginary[k] = s[k].imag();
  }
  if (!options.damping_ratio) return real;
  return real + *options.damping_ratio * sqrt(real * real + imaginary * imaginary);
}

/// Computes the mode whose eigenvalue is nearest to `expected`, with its derivatives; empty if that fails.
std::optional<Probe> probe(const Window& window, const BoundaryOptions& options, const Place& place,
                           Complex expected, const EquilibriumGuess& equilibrium, const Matrix& basis,
                           RunCounts& counts) {
  const PathProblem problem = window.at(place);
  Situation situation;
  situation.place = place;
  situation.point = reduce_at(problem, problem.parameters[problem.traced], equilibrium, basis, counts);
  if (situation.point.status != PointStatus::computed) return std::nullopt;
  situation.pencil = situation.point.pencil;
  const Spectrum spectrum =
      compute_spectrum(situation.pencil.M[0], situation.pencil.C[0], situation.pencil.K[0]);
  ++counts.spectra;
  if (spectrum.modes.empty()) return std::nullopt;
  const auto nearest = std::min_element(
      spectrum.modes.begin(), spectrum.modes.end(),
      [&](const auto& a, const auto& b) { return std::abs(a.s - expected) < std::abs(b.s - expected); });
  InvariantPair start;
  start.Z = nearest->z;
  start.Lambda = ComplexMatrix::Constant(1, 1, nearest->s);
  start.is_real = nearest->s.imag() == 0.0;
  if (start.is_real) start.Z.imag().setZero();
  situation.pair = correct_pair(PencilAtPoint(situation.pencil), start, window.reference(), problem.corrector,
                                counts.modes);
  if (situation.pair.status != PairStatus::converged) return std::nullopt;
  // The real part of a mode on the axis is rounding, and has no sign.
  const ComplexVector own = pair_eigenvalues(situation.pair);
  const double rounding = eigenvalue_rounding(situation.pair, own, RoundingThresholds().entries)[0];
  std::array<Series<Complex, 2>, 3> s;
  std::array<Series<double, 2>, 3> w;
  const std::array<Place, 3> directions{Place::Unit(0), Place::Unit(1), Place::Ones()};
  for (std::size_t i = 0; i < 3; ++i) {
    Matrix places(2, 2);
    places << place, directions[i];
    const auto series = differentiate_situation(window, situation, BoundaryFunction(), places, 2, counts);
    if (!series) return std::nullopt;
    s[i][0] = shown(own[0], rounding);
    for (int k = 1; k <= 2; ++k) s[i][k] = series->functions(0, k);
    w[i] = instability_series(options, s[i]);
  }
  return Probe{place, as_guess(situation, place).equilibrium, situation.point.basis.T[0], quadratic(s),
               quadratic(w)};
}

std::optional<Probe> probe_from(const Window& window, const BoundaryOptions& options, const Probe& base,
                                const Place& place, RunCounts& counts) {
  return probe(window, options, place, base.s.at(place - base.place), base.equilibrium, base.basis, counts);
}

/// Step of at most `radius` that increases sign * w: the Newton step with each eigenvalue of the Hessian
/// replaced by its magnitude, but at least |slope| / radius.
Place uphill(const Quadratic<double>& w, double sign, double radius) {
  const Place slope = sign * w.gradient;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(w.hessian)};
  const Place components = solver.eigenvectors().transpose() * slope;
  const Place curvatures = solver.eigenvalues().cwiseAbs().cwiseMax(slope.norm() / radius);
  const Place step = solver.eigenvectors() * components.cwiseQuotient(curvatures.cwiseMax(1e-300));
  const double length = step.norm();
  return length > radius ? Place(radius / length * step) : step;
}

/// The seed at a probe; `beside`: the eigenvalue on the other side of the boundary. Without damping a real
/// one becomes a pair on the imaginary axis there.
std::optional<BoundarySeed> seed_at(const Window& window, const BoundaryOptions& options, const Probe& there,
                                    Complex beside) {
  const Complex s = there.s.value;
  if (!passes_zero(options, s, window.reference())) return std::nullopt;
  const BoundaryKind kind = kind_of(options, s.imag() == 0.0 ? s : beside);
  return BoundarySeed{there.place, Place::Zero(), kind, s, there.equilibrium, true};
}

/// A seed between two probes with instabilities of opposite sign. The interval is divided by the secant or in
/// halves until it is short enough for Newton's method.
std::optional<BoundarySeed> seed_between(const Window& window, const BoundaryOptions& options, Probe a,
                                         Probe b, RunCounts& counts) {
  for (int i = 0; i < most_sections && (b.place - a.place).norm() > close_enough; ++i) {
    // Every third division is a halving: the secant alone may move one end only and converge slowly.
    const double share = i % 3 == 2 ? 0.5 : std::clamp(a.w.value / (a.w.value - b.w.value), 0.02, 0.98);
    const auto middle = probe_from(window, options, a, a.place + share * (b.place - a.place), counts);
    if (!middle) break;
    (middle->w.value * a.w.value > 0.0 ? a : b) = *middle;
  }
  if (std::abs(a.w.value) < std::abs(b.w.value)) std::swap(a, b);
  return seed_at(window, options, b, a.s.value);
}

}  // namespace

LineScan scan_line(const Window& window, const BoundaryOptions& options, const ScanLine& line) {
  return Scanner(window, options, line).run();
}

std::optional<BoundarySeed> walk_to_boundary(const Window& window, const BoundaryOptions& options,
                                             const LineExtremum& start, double radius, RunCounts& counts) {
  std::optional<Probe> here =
      probe(window, options, start.place, start.s, start.equilibrium, Matrix(), counts);
  if (here && here->w.value * start.sign >= 0.0) return seed_at(window, options, *here, here->s.value);
  const double longest = radius;
  for (int i = 0; here && i < most_steps && radius > smallest_radius; ++i) {
    const Place move = uphill(here->w, start.sign, radius);
    const Place target = (here->place + move).cwiseMax(0.0).cwiseMin(1.0);
    if (!((target - here->place).norm() > smallest_radius)) break;
    const auto there = probe_from(window, options, *here, target, counts);
    if (there && there->w.value * start.sign >= 0.0)
      return seed_between(window, options, *here, *there, counts);
    if (there && start.sign * (there->w.value - here->w.value) > 0.0) {
      here = there;
      radius = std::min(2.0 * radius, longest);
    } else {
      radius = 0.25 * std::min(radius, (target - here->place).norm());
    }
  }
  return std::nullopt;
}

}  // namespace eigentrail
