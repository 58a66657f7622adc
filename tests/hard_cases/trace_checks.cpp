#include "hard_cases/trace_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <sstream>

#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/modes/matching.hpp"

namespace eigentrail::test {
namespace {

/// Veerings are events up to this share of the range.
constexpr double widest_veering = 0.01;

/// Close to a fold eigenvalues vary like the square root of the distance. Rounding of the scene's numbers and
/// of residuals moves the fold by this, relative to the range or the parameter. In double precision
/// eigenvalues at p cannot be distinguished from those at p +- this.
constexpr double fold_rounding = 16.0 * std::numeric_limits<double>::epsilon();
constexpr double beside_fold = 1e-5;  ///< of the range: where that matters at the tolerances tried

/// Roots of every block at a place, in the chart of the block.
std::vector<ComplexVector> roots_at(const PathStep& step, double t) {
  std::vector<ComplexVector> all;
  for (const DenseBlock& block : step.blocks) {
    all.push_back(block_roots(HermiteInterpolant(step.length, block.left, block.right)(t)));
  }
  return all;
}

/// Largest difference of the smooth functions of a block, tau and the power means of the distances from it,
/// each relative to the size of its eigenvalues.
double difference(const ComplexVector& found, const ComplexVector& exact, double reference) {
  const double scale = std::max(exact.cwiseAbs().maxCoeff(), reference);
  double worst = std::abs(found.mean() - exact.mean()) / scale;
  for (Eigen::Index j = 2; j <= found.size(); ++j) {
    const auto power_mean = [j](const ComplexVector& s) {
      Complex sum = 0.0;
      for (const Complex value : s) sum += std::pow((value - s.mean()), static_cast<double>(j));
      return sum / static_cast<double>(s.size());
    };
    worst = std::max(
        worst, std::abs(power_mean(found) - power_mean(exact)) / std::pow(scale, static_cast<double>(j)));
  }
  return worst;
}

/// The eigenvalues of a spectrum that belong to the blocks of a step at a place, each in the chart of its
/// block: a one-to-one assignment of all roots.
std::vector<ComplexVector> targets_at(const PathStep& step, const std::vector<ComplexVector>& blocks,
                                      const std::vector<Complex>& exact, double s_ref, double s_max) {
  std::vector<Complex> found;
  std::vector<Chart> charts;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    for (const Complex root : blocks[i]) {
      found.push_back(root);
      charts.push_back(step.blocks[i].chart);
    }
  }
  const auto n = static_cast<Eigen::Index>(std::max(found.size(), exact.size()));
  Matrix cost = Matrix::Zero(n, n);
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t j = 0; j < exact.size(); ++j) {
      const double reference = charts[i] == Chart::finite ? s_ref : 1.0 / s_max;
      const Complex target = chart_value(exact[j], charts[i]);
      cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          std::min(1e6, std::abs(found[i] - target) / std::max(std::abs(target), reference));
    }
    for (auto j = static_cast<Eigen::Index>(exact.size()); j < n; ++j) {
      // An eigenvalue that is infinite is not in the list.
      cost(static_cast<Eigen::Index>(i), j) =
          charts[i] == Chart::reciprocal ? std::abs(found[i]) * s_max : 1e6;
    }
  }
  const std::vector<int> assignment = optimal_assignment(cost);
  std::vector<ComplexVector> targets;
  std::size_t at = 0;
  for (const ComplexVector& block : blocks) {
    ComplexVector target(block.size());
    for (Eigen::Index k = 0; k < target.size(); ++k, ++at) {
      const auto j = static_cast<std::size_t>(assignment[at]);
      target[k] = j < exact.size() ? chart_value(exact[j], charts[at]) : Complex(0.0);
    }
    targets.push_back(std::move(target));
  }
  return targets;
}

/// Error at one place against one branch of a sample: the worst block, less what rounding of p explains.
double error_at(const PathStep& step, double t, const Sample& sample, std::size_t branch, double s_ref,
                double s_max) {
  const std::vector<ComplexVector> blocks = roots_at(step, t);
  const auto exact = targets_at(step, blocks, sample.spectra[branch], s_ref, s_max);
  double worst = 0.0;
  std::vector<double> explained(blocks.size(), 0.0);
  const auto reference = [&](std::size_t i) {
    return step.blocks[i].chart == Chart::finite ? s_ref : 1.0 / s_max;
  };
  for (const Spectra& nearby : sample.nearby) {
    if (nearby[branch].empty()) continue;
    const auto moved = targets_at(step, blocks, nearby[branch], s_ref, s_max);
    for (std::size_t i = 0; i < blocks.size(); ++i)
      explained[i] = std::max(explained[i], difference(moved[i], exact[i], reference(i)));
  }
  for (std::size_t i = 0; i < blocks.size(); ++i)
    worst = std::max(worst, difference(blocks[i], exact[i], reference(i)) - explained[i]);
  return worst;
}

std::string describe(const std::string& kind, double p, Complex s, double half_width) {
  std::ostringstream text;
  text.precision(17);
  text << kind << " at " << p << " s " << s.real() << (s.imag() < 0 ? "-" : "+") << std::abs(s.imag()) << "j";
  if (half_width > 0.0) text << " half-width " << half_width;
  return text.str();
}

Complex upper(Complex s) {
  return s.imag() < 0.0 ? std::conj(s) : s;
}

/// The mode of `labelled` nearest to s, if it is clearly nearer than any other. Modes that coincide within
/// rounding cannot be distinguished.
int clear_label(Complex s, const std::vector<LabelledMode>& labelled) {
  int best = -1;
  double nearest = INFINITY;
  double second = INFINITY;
  for (std::size_t i = 0; i < labelled.size(); ++i) {
    const double distance = std::abs(upper(s) - upper(labelled[i].s));
    if (distance < nearest) {
      second = nearest;
      nearest = distance;
      best = static_cast<int>(i);
    } else {
      second = std::min(second, distance);
    }
  }
  constexpr double rounding = 1e-12;
  return nearest < 0.1 * second && second > rounding * std::abs(s) ? best : -1;
}

/// Whether the mode is certified on the step.
bool certified(const PathStep& step, int mode) {
  for (const DenseBlock& block : step.blocks) {
    if (std::find(block.modes.begin(), block.modes.end(), mode) != block.modes.end()) return block.certified;
  }
  return false;
}

/// Whether the mode is certified on all steps from one to another.
bool certified_between(const RecordedTrace& trace, std::size_t a, std::size_t b, int mode) {
  for (std::size_t i = std::min(a, b); i <= std::max(a, b); ++i) {
    if (!certified(trace.steps[i], mode)) return false;
  }
  return true;
}

std::string describe(int mode, double p, Complex s, const LabelledMode& known, const LabelledMode& now) {
  std::ostringstream text;
  text.precision(10);
  text << "mode " << mode + 1 << " at " << p << " s " << s << " is on " << now.family << "." << now.label
       << ", was on " << known.family << "." << known.label;
  return text.str();
}

struct Place {
  std::size_t step;
  double t;
};

/// Where a trace passes each place of a reference.
template <class Reference>
std::vector<std::vector<Place>> places(const RecordedTrace& trace, const std::vector<Reference>& reference) {
  std::vector<std::vector<Place>> found(reference.size());
  for (std::size_t i = 0; i < trace.steps.size(); ++i) {
    const PathStep& step = trace.steps[i];
    const HermiteInterpolant p(step.length, step.parameter.row(0).cast<Complex>(),
                               step.parameter.row(1).cast<Complex>());
    // A bound, and its rounding, of how far p moves from the left end. To look for positions takes long.
    const double moves = 1.001 * p.series(0.0, p.degree()).rightCols(p.degree()).cwiseAbs().sum();
    for (std::size_t k = 0; k < reference.size(); ++k) {
      if (std::abs(reference[k].p - step.parameter(0, 0)) > moves) continue;
      for (const double t : step_positions(step, reference[k].p)) {
        if (t > 0.0 || i == 0) found[k].push_back({i, t});
      }
    }
  }
  return found;
}

}  // namespace

std::vector<double> sample_parameters(const HardCase& hard_case, int random_samples) {
  const double low = std::min(hard_case.from, hard_case.to);
  const double range = std::abs(hard_case.to - hard_case.from);
  std::vector<double> parameters;
  std::mt19937_64 engine(20260101);
  std::uniform_real_distribution<double> uniform(low, low + range);
  for (int i = 0; i < random_samples; ++i) parameters.push_back(uniform(engine));
  for (const SpecialPoint& special : hard_case.special) {
    for (int power = 3; power <= 10; ++power) {
      for (const double side : {-1.0, 1.0}) {
        const double p = special.parameter + side * std::pow(10.0, -power) * range;
        if (p > low && p < low + range) parameters.push_back(p);
      }
    }
  }
  return parameters;
}

Sample sample_at(const HardCase& hard_case, double p) {
  Sample sample{p, hard_case.spectrum(p), {}};
  const double range = std::abs(hard_case.to - hard_case.from);
  const bool matters =
      std::any_of(hard_case.special.begin(), hard_case.special.end(), [&](const SpecialPoint& special) {
        return special.kind == "fold" && std::abs(p - special.parameter) <= beside_fold * range;
      });
  if (!matters) return sample;
  const double rounding = fold_rounding * std::max(range, std::abs(p));
  for (const double moved : {p - rounding, p + rounding}) sample.nearby.push_back(hard_case.spectrum(moved));
  return sample;
}

Accuracy measure_accuracy(const std::vector<Sample>& samples, const RecordedTrace& trace, double tolerance) {
  double s_max = 0.0;
  for (const ModeState& state : trace.modes.front()) s_max = std::max(s_max, std::abs(state.s));
  s_max *= 1e4;
  Accuracy accuracy;
  const auto passages = places(trace, samples);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Sample& sample = samples[k];
    for (const Place& place : passages[k]) {
      double best = INFINITY;
      for (std::size_t branch = 0; branch < sample.spectra.size(); ++branch) {
        if (sample.spectra[branch].empty()) continue;
        const PathStep& step = trace.steps[place.step];
        best = std::min(best, error_at(step, place.t, sample, branch, trace.result.s_ref, s_max));
      }
      // Beyond a fold there is no reference to compare with.
      if (!std::isfinite(best) || best / tolerance <= accuracy.worst_error) continue;
      accuracy = {best / tolerance, sample.p};
    }
  }
  return accuracy;
}

EventComparison compare_events(const HardCase& hard_case, const RecordedTrace& trace, double tolerance) {
  const double located = tolerance <= 1e-8 ? 1e-9 : 1e-7;
  const double widest = widest_veering * std::abs(hard_case.to - hard_case.from) * (1.0 + 1e-9);
  const auto near = [&](const SpecialPoint& special, const Event& event) {
    const double allowed = std::max(located * std::max(1.0, std::abs(special.parameter)), special.rounding);
    return event_name(event.kind) == special.kind && std::abs(event.p - special.parameter) <= allowed &&
           (special.kind != "veering" || std::abs(event.half_width - special.half_width) <= allowed);
  };
  EventComparison result;
  std::vector<bool> used(trace.result.events.size(), false);
  // The references list no extrema of damping: these have tests of their own.
  for (std::size_t i = 0; i < used.size(); ++i) used[i] = trace.result.events[i].kind == EventKind::extremum;
  for (const SpecialPoint& special : hard_case.special) {
    int& event_of = result.event_of.emplace_back(-1);
    if (special.kind == "infinite") continue;
    for (std::size_t i = 0; i < used.size() && event_of < 0; ++i) {
      if (used[i] || !near(special, trace.result.events[i])) continue;
      used[i] = true;
      event_of = static_cast<int>(i);
    }
    const bool is_wide = special.kind == "veering" && special.half_width > widest;
    if (event_of < 0 && !is_wide)
      result.missing.push_back(describe(special.kind, special.parameter, special.s, special.half_width));
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Event& event = trace.result.events[i];
    if (!used[i])
      result.invented.push_back(describe(event_name(event.kind), event.p, event.s, event.half_width));
  }
  return result;
}

void count_labels(const RecordedTrace& trace, const std::vector<LabelledPlace>& reference, int branch,
                  LabelCount& count) {
  constexpr std::size_t most_described = 3;
  std::map<int, LabelledMode> label_of;  // of a column
  std::optional<std::size_t> last_step;
  const auto passages = places(trace, reference);
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const auto& [p, known_modes] = reference[k];
    const std::vector<Place>& found = passages[k];
    if (found.empty()) continue;
    const auto index = static_cast<std::size_t>(std::min<int>(branch, static_cast<int>(found.size()) - 1));
    const Place place = found[index];
    const PathStep& step = trace.steps[place.step];
    const ComplexVector s = step_eigenvalues(step, trace.eigenvalues_of_node(place.step),
                                             trace.eigenvalues_of_node(place.step + 1), place.t);
    for (int mode = 0; mode < s.size(); ++mode) {
      if (!std::isfinite(s[mode].real())) continue;
      if (!certified_between(trace, last_step.value_or(place.step), place.step, mode)) label_of.erase(mode);
      const int nearest = clear_label(s[mode], known_modes);
      if (nearest < 0) continue;
      const LabelledMode& now = known_modes[static_cast<std::size_t>(nearest)];
      const auto known = label_of.find(mode);
      if (known != label_of.end()) {
        ++count.labels;
        const bool kept = known->second.family == now.family &&
                          (known->second.version != now.version || known->second.label == now.label);
        if (!kept) {
          ++count.wrong;
          if (count.wrong_places.size() < most_described)
            count.wrong_places.push_back(describe(mode, p, s[mode], known->second, now));
        }
      }
      label_of[mode] = now;
    }
    last_step = place.step;
  }
}

}  // namespace eigentrail::test
