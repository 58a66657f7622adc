#include "continuation/events/part_crossings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "continuation/events/event_record.hpp"
#include "continuation/events/nearby_mode.hpp"
#include "continuation/events/walk.hpp"
#include "continuation/tracks/eigenvalue_branches.hpp"
#include "continuation/tracks/members.hpp"
#include "eigentrail/core/chebyshev.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Degree of the polynomials that represent eigenvalues on a step. The dense output of a single mode has at
/// most this degree; eigenvalues of a block are smooth enough on a step that has been accepted.
constexpr int crossing_degree = 16;
using Samples = std::array<Complex, crossing_degree + 1>;

/// The Chebyshev points of [0, 1] at which a polynomial of that degree is sampled.
const std::array<double, crossing_degree + 1>& sample_points() {
  static const auto points = [] {
    std::array<double, crossing_degree + 1> all = {};
    std::size_t k = 0;
    chebyshev_coefficients([&](double t) { return all[k++] = t; }, crossing_degree);
    return all;
  }();
  return points;
}

std::size_t nearest_sample(double t) {
  const auto& points = sample_points();
  const auto closer = [t](double a, double b) { return std::abs(a - t) < std::abs(b - t); };
  return static_cast<std::size_t>(std::min_element(points.begin(), points.end(), closer) - points.begin());
}

/// As a share of the range: accuracy to which crossings are located.
constexpr double crossing_resolution = 1e-11;
/// In units of the resolution: moves up to this that no longer shrink are rounding.
constexpr double rounding_moves = 100.0;

/// One eigenvalue of a track at the samples, from the dense output.
struct SampledMode {
  std::size_t track = 0;
  int mode = -1;
  Samples s = {};
};

std::vector<SampledMode> sampled_modes(const Step& step) {
  std::vector<SampledMode> all;
  for (std::size_t i = 0; i < step.left->tracks.size(); ++i) {
    const Track& track = step.left->tracks[i];
    EigenvalueSampler sampler(*step.left, step.right, i, step.h);
    const std::size_t first = all.size();
    for (const int mode : track.modes) all.push_back({i, mode, {}});
    for (std::size_t k = 0; k < sample_points().size(); ++k) {
      const ComplexVector& roots = sampler(sample_points()[k]);
      for (Eigen::Index j = 0; j < roots.size(); ++j)
        all[first + static_cast<std::size_t>(j)].s[k] =
            upper_member(chart_value(roots[j], track.pair.chart), Chart::finite);
    }
  }
  std::erase_if(all, [](const SampledMode& mode) {
    return mode.mode < 0 || !std::all_of(mode.s.begin(), mode.s.end(), [](Complex s) {
             return std::isfinite(s.real()) && std::isfinite(s.imag());
           });
  });
  return all;
}

/// The part of a difference that has a sign: real parts of two real eigenvalues. A real and a complex
/// eigenvalue coincide only where the complex one turns real: imaginary parts. Of two complex ones, the parts
/// that differ more on the step: whirls that only circulatory forces tell apart have one frequency.
class SignedDifference {
 public:
  SignedDifference(const SampledMode& a, const SampledMode& b) {
    double real = 0.0, imaginary = 0.0;
    bool are_complex = true;
    for (std::size_t k = 0; k < a.s.size(); ++k) {
      real = std::max(real, std::abs(a.s[k].real() - b.s[k].real()));
      imaginary = std::max(imaginary, std::abs(a.s[k].imag() - b.s[k].imag()));
      are_complex = are_complex && a.s[k].imag() != 0.0 && b.s[k].imag() != 0.0;
    }
    by_real_parts_ = are_complex && real > imaginary;
  }

  double operator()(Complex a, Complex b) const { return part_of(a - b, a, b); }
  /// The same of a derivative of the difference of a and b.
  double part_of(Complex difference, Complex a, Complex b) const {
    const bool real = by_real_parts_ || (a.imag() == 0.0 && b.imag() == 0.0);
    return real ? difference.real() : difference.imag();
  }

 private:
  bool by_real_parts_ = false;
};

/// Zeros of the signed difference of two modes on a step, as t. They are those of its polynomial, as far as
/// they are real up to the accuracy of the dense output; the walk decides.
std::vector<double> zeros(const SampledMode& a, const SampledMode& b) {
  constexpr double beside_axis = 1e-2;  // imaginary part of t: double zeros split
  // By the error of the dense output, one at the end of the step may lie behind it: whirl of a shaft at rest.
  constexpr double past_the_ends = 1e-3;
  const SignedDifference signed_difference(a, b);
  const auto difference = [&](double t) {
    const std::size_t k = nearest_sample(t);
    return Complex(signed_difference(a.s[k], b.s[k]));
  };
  const ComplexVector coefficients = chebyshev_coefficients(difference, crossing_degree);
  // The constant term is larger than all others together: no zero, and none closely behind the ends.
  const double others = coefficients.tail(crossing_degree).cwiseAbs().sum();
  if (std::abs(coefficients[0]) > (1.0 + 2.0 * past_the_ends) * others) return {};
  std::vector<double> found;
  for (const Complex t : chebyshev_roots(coefficients)) {
    const bool is_near =
        std::abs(t.imag()) <= beside_axis && t.real() >= -past_the_ends && t.real() <= 1.0 + past_the_ends;
    if (is_near) found.push_back(std::clamp(t.real(), 0.0, 1.0));
  }
  return found;
}

/// Locates one crossing by Newton's method on the difference of both eigenvalues.
class CrossingWalk {
 public:
  CrossingWalk(const EventSearch& search, const Step& step, const SampledMode& a, const SampledMode& b)
      : search_(search), step_(step), modes_{&a, &b}, signed_difference_(a, b) {}

  std::optional<Event> from(double t);

 private:
  Sight look(double h);
  Event event_here() const;

  const EventSearch& search_;
  const Step& step_;
  std::array<const SampledMode*, 2> modes_;
  SignedDifference signed_difference_;
  std::array<std::optional<NearbyMode>, 2> seen_;
  std::array<Complex, 2> s_;  ///< the eigenvalues at the last look
  double expected_ = 0.0;     ///< t from which the eigenvalues are expected
  int looks_ = 0;
};

Sight CrossingWalk::look(double h) {
  const std::size_t at = nearest_sample(expected_);
  std::array<Complex, 2> slopes;
  for (std::size_t i = 0; i < 2; ++i) {
    const Chart chart = step_.left->tracks[modes_[i]->track].pair.chart;
    const Complex expected = seen_[i] ? seen_[i]->root : chart_value(modes_[i]->s[at], chart);
    seen_[i] =
        look_at_mode(search_.solver, *step_.left, modes_[i]->track, expected, h, ModeFunction::eigenvalue);
    if (!seen_[i] || seen_[i]->series.size() < 2 || seen_[i]->series[0] == 0.0) return {};
    ComplexVector series = chart == Chart::finite ? seen_[i]->series : reciprocal_series(seen_[i]->series);
    if (series[0].imag() < 0.0) series = series.conjugate().eval();
    s_[i] = series[0];
    slopes[i] = series[1];
  }
  ++looks_;
  const double distance = signed_difference_(s_[0], s_[1]);
  const double rate = signed_difference_.part_of(slopes[0] - slopes[1], s_[0], s_[1]);
  if (!(std::abs(rate) > 0.0)) return {};
  return {Sight::Kind::seen, -distance / rate};
}

Event CrossingWalk::event_here() const {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto stays = [nan](const Track&, const PathNode&, const Track&) { return nan; };
  std::array<Event, 2> own;
  for (std::size_t i = 0; i < 2; ++i) {
    const PathNode& node = seen_[i]->solved.node;
    const Track& track = node.tracks.front();
    Eigen::Index root = 0;
    (track.roots.array() - seen_[i]->root).abs().minCoeff(&root);
    keep_shape(node, track, {static_cast<int>(root)}, 0.0, own[i]);
    keep_sensitivities(search_.problem(), solved_point(search_.problem(), node, search_.solver.counts()),
                       node, track, {static_cast<int>(root)}, stays, own[i], search_.solver.counts());
  }
  Event event = own[0];
  event.copies.clear();  // equal modes of copies are modes of the same crossing
  event.kind = EventKind::crossing;
  event.p = seen_[0]->solved.node.p;
  event.s = 0.5 * (s_[0] + s_[1]);
  event.modes = {std::min(modes_[0]->mode, modes_[1]->mode), std::max(modes_[0]->mode, modes_[1]->mode)};
  event.node = search_.node;
  event.retrackings = looks_;
  event.sensitivity = 0.5 * (own[0].sensitivity + own[1].sensitivity);
  const ComplexVector apart = own[0].sensitivity - own[1].sensitivity;
  const Eigen::Index traced = search_.problem().traced;
  for (Eigen::Index q = 0; q < apart.size(); ++q) {
    const double shift = -(apart[q] / apart[traced]).real();
    if (q != traced && std::isfinite(shift)) event.shift[q] = shift;
  }
  return event;
}

std::optional<Event> CrossingWalk::from(double t) {
  expected_ = t;
  const double speed = std::max(std::abs(search_.frame().speed(*step_.left)), 1e-300);
  WalkRules rules;
  rules.resolution = crossing_resolution * search_.frame().range.length() / speed;
  rules.rounding = rounding_moves * rules.resolution;
  const auto found = walk(t * step_.h, rules, [this](double h) { return look(h); });
  if (found.end != WalkEnd::settled) return std::nullopt;
  const double scale = std::max(std::abs(s_[0]), search_.problem().s_ref);
  const double same = search_.thresholds().identity.merged_distance;
  if (std::abs(s_[0] - s_[1]) > same * scale) return std::nullopt;  // they pass beside each other
  return event_here();
}

/// Crossings of two modes on the step.
void add_crossings(const EventSearch& search, const Step& step, const SampledMode& a, const SampledMode& b,
                   FoundEvents& found) {
  const double same = search.thresholds().identity.merged_distance;
  double scale = search.problem().s_ref;
  for (const Complex s : a.s) scale = std::max(scale, std::abs(s));
  const SignedDifference signed_difference(a, b);
  for (const double t : zeros(a, b)) {
    const std::size_t nearest = nearest_sample(t);
    const std::size_t next = nearest == 0 ? 1 : nearest - 1;
    // Far apart in the other component they do not coincide near here.
    constexpr double nearby = 10.0;
    const double across = std::abs(signed_difference(a.s[nearest], b.s[nearest])) +
                          std::abs(signed_difference(a.s[next], b.s[next]));
    if (std::abs(a.s[nearest] - b.s[nearest]) > nearby * across + same * scale) continue;
    if (auto event = CrossingWalk(search, step, a, b).from(t)) found.events.push_back(std::move(*event));
  }
}

/// Unites crossings at one place: where more than two modes coincide, every two of them do.
void unite(const EventSearch& search, std::vector<Event>& events) {
  const double place = search.thresholds().event.same_place * search.frame().range.length();
  for (std::size_t i = 0; i < events.size(); ++i) {
    for (std::size_t j = i + 1; j < events.size();) {
      const double scale = std::max(std::abs(events[i].s), search.problem().s_ref);
      const bool is_one =
          std::abs(events[i].p - events[j].p) <= place &&
          std::abs(events[i].s - events[j].s) <= search.thresholds().identity.merged_distance * scale;
      if (!is_one) {
        ++j;
        continue;
      }
      events[i].modes = sorted_modes(united(events[i].modes, events[j].modes));
      events.erase(events.begin() + static_cast<std::ptrdiff_t>(j));
    }
  }
}

}  // namespace

FoundEvents find_part_crossings(const EventSearch& search, const Step& step) {
  FoundEvents found;
  if (step.left->pencil.parts.size() < 2) return found;
  const auto& ranges = search.problem().parts->ranges;
  const auto kind_of = [&](const SampledMode& mode) {
    return ranges[static_cast<std::size_t>(step.left->tracks[mode.track].pair.part)].like;
  };
  const std::vector<SampledMode> modes = sampled_modes(step);
  for (std::size_t i = 0; i < modes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      // Modes of equal parts coincide throughout, or where those of one part meet.
      if (kind_of(modes[i]) != kind_of(modes[j])) add_crossings(search, step, modes[j], modes[i], found);
    }
  }
  unite(search, found.events);
  return found;
}

}  // namespace eigentrail
