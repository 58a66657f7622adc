#include "hard_cases/run_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <sstream>

#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/modes/matching.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {
namespace {

/// Veerings are events up to this share of the range.
constexpr double widest_veering = 0.01;

/// Beside a fold eigenvalues vary like the root of the distance. Numbers of the scene and residuals are
/// rounded, which moves the fold by this, in units of the range or the parameter; nothing in double precision
/// tells eigenvalues at p from those at p +- this.
constexpr double fold_rounding = 16.0 * std::numeric_limits<double>::epsilon();
constexpr double beside_fold = 1e-5;  ///< of the range: where that matters at the tolerances tried

/// Where a trace passes a parameter value.
struct Place {
  std::size_t step;
  double t;
};

std::vector<Place> places(const RecordedTrace& trace, double p) {
  std::vector<Place> found;
  for (std::size_t i = 0; i < trace.steps.size(); ++i) {
    for (const double t : step_positions(trace.steps[i], p)) {
      if (t == 0.0 && i > 0) continue;
      found.push_back({i, t});
    }
  }
  return found;
}

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
double error_at(const PathStep& step, double t, const CaseReference::Sample& sample, std::size_t branch,
                double s_ref, double s_max) {
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

void check_accuracy(const CaseReference& reference, const RecordedTrace& trace, double tolerance,
                    CaseReport& report) {
  double s_max = 0.0;
  for (const ModeState& state : trace.modes.front()) s_max = std::max(s_max, std::abs(state.s));
  s_max *= 1e4;
  for (const CaseReference::Sample& sample : reference.samples) {
    for (const Place& place : places(trace, sample.p)) {
      double best = INFINITY;
      for (std::size_t branch = 0; branch < sample.spectra.size(); ++branch) {
        if (sample.spectra[branch].empty()) continue;
        const PathStep& step = trace.steps[place.step];
        best = std::min(best, error_at(step, place.t, sample, branch, trace.result.s_ref, s_max));
      }
      // Behind a fold there is nothing to compare with.
      if (!std::isfinite(best) || best / tolerance <= report.worst_error) continue;
      report.worst_error = best / tolerance;
      report.worst_at = sample.p;
    }
  }
}

std::string describe(const std::string& kind, double p, Complex s, double half_width) {
  std::ostringstream text;
  text.precision(17);
  text << kind << " at " << p << " s " << s.real() << (s.imag() < 0 ? "-" : "+") << std::abs(s.imag()) << "j";
  if (half_width > 0.0) text << " half-width " << half_width;
  return text.str();
}

void check_events(const HardCase& hard_case, const RecordedTrace& trace, double tolerance,
                  CaseReport& report) {
  const double range = std::abs(hard_case.to - hard_case.from);
  const double allowed = tolerance <= 1e-8 ? 1e-9 : 1e-7;
  const auto near = [&](const SpecialPoint& special, const Event& event) {
    const double scale = std::max(1.0, std::abs(special.parameter));
    return event_name(event.kind) == special.kind &&
           std::abs(event.p - special.parameter) <= allowed * scale &&
           (special.kind != "veering" || std::abs(event.half_width - special.half_width) <= allowed * scale);
  };
  std::vector<bool> used(trace.result.events.size(), false);
  for (const SpecialPoint& special : hard_case.special) {
    if (special.kind == "infinite") continue;
    const bool optional = special.kind == "veering" &&
                          special.half_width > widest_veering * range * (1.0 - 1e-9) &&
                          !(special.half_width <= widest_veering * range * (1.0 + 1e-9));
    bool found = false;
    for (std::size_t i = 0; i < used.size() && !found; ++i) {
      if (used[i] || !near(special, trace.result.events[i])) continue;
      found = used[i] = true;
    }
    if (optional && !found) continue;
    ++report.expected_events;
    if (found) {
      ++report.found_events;
    } else {
      report.missing.push_back(describe(special.kind, special.parameter, special.s, special.half_width));
    }
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Event& event = trace.result.events[i];
    if (!used[i])
      report.invented.push_back(describe(event_name(event.kind), event.p, event.s, event.half_width));
  }
}

Complex upper(Complex s) {
  return s.imag() < 0.0 ? std::conj(s) : s;
}

/// The mode of `labelled` nearest to s, if it is clearly nearer than any other.
int clear_label(Complex s, const std::vector<Complex>& labelled) {
  int best = -1;
  double nearest = INFINITY;
  double second = INFINITY;
  for (std::size_t i = 0; i < labelled.size(); ++i) {
    const double distance = std::abs(upper(s) - upper(labelled[i]));
    if (distance < nearest) {
      second = nearest;
      nearest = distance;
      best = static_cast<int>(i);
    } else {
      second = std::min(second, distance);
    }
  }
  return nearest < 0.1 * second ? best : -1;
}

/// Whether the mode is certified on the step.
bool certified(const PathStep& step, int mode) {
  for (const DenseBlock& block : step.blocks) {
    if (std::find(block.modes.begin(), block.modes.end(), mode) != block.modes.end()) return block.certified;
  }
  return false;
}

/// Compares the labels on places of one stretch: a column keeps to one label as long as it is certified.
void check_stretch(const RecordedTrace& trace, const std::vector<double>& parameters, int branch,
                   const std::function<std::vector<Complex>(double)>& labelled, CaseReport& report) {
  std::map<int, int> label_of;  // of a column
  std::size_t last_step = 0;
  bool begun = false;
  for (const double p : parameters) {
    const auto found = places(trace, p);
    const auto index = static_cast<std::size_t>(std::min<int>(branch, static_cast<int>(found.size()) - 1));
    if (found.empty()) continue;
    const Place place = found[index];
    const PathStep& step = trace.steps[place.step];
    const ComplexVector s = step_eigenvalues(step, trace.eigenvalues_of_node(place.step),
                                             trace.eigenvalues_of_node(place.step + 1), place.t);
    const std::vector<Complex> reference = labelled(p);
    for (int mode = 0; mode < s.size(); ++mode) {
      if (!std::isfinite(s[mode].real())) continue;
      const std::size_t low = std::min(last_step, place.step);
      const std::size_t high = std::max(last_step, place.step);
      for (std::size_t i = begun ? low : place.step; i <= (begun ? high : place.step); ++i) {
        if (!certified(trace.steps[i], mode)) label_of.erase(mode);
      }
      const int label = clear_label(s[mode], reference);
      if (label < 0) continue;
      const auto known = label_of.find(mode);
      if (known != label_of.end()) {
        ++report.labels;
        if (known->second != label) ++report.wrong_labels;
      }
      label_of[mode] = label;
    }
    last_step = place.step;
    begun = true;
  }
}

void check_labels(const CaseReference& reference, const RecordedTrace& trace, CaseReport& report) {
  const HardCase& hard_case = *reference.hard_case;
  const auto grid = [](double low, double high, int count) {
    std::vector<double> p;
    for (int i = 0; i < count; ++i) p.push_back(low + (high - low) * (i + 0.5) / count);
    return p;
  };
  if (hard_case.has_branches) {
    const auto labelled = [&](double p) {
      std::vector<Complex> s;
      for (const auto& branch : hard_case.branches) s.push_back(branch(p));
      return s;
    };
    check_stretch(trace,
                  grid(std::min(hard_case.from, hard_case.to), std::max(hard_case.from, hard_case.to), 199),
                  0, labelled, report);
    return;
  }
  for (const LabelledStretch& stretch : reference.labels) {
    if (!stretch.complete()) continue;
    check_stretch(
        trace, grid(stretch.low(), stretch.high(), 60), stretch.branch(),
        [&](double p) { return stretch(p); }, report);
  }
}

}  // namespace

namespace {

CaseReference::Sample sample_at(const HardCase& hard_case, double p) {
  CaseReference::Sample sample{p, hard_case.spectrum(p), {}};
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

}  // namespace

CaseReference make_reference(const HardCase& hard_case, int random_samples) {
  CaseReference reference;
  reference.hard_case = &hard_case;
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
  for (const double p : parameters) reference.samples.push_back(sample_at(hard_case, p));
  if (!hard_case.has_branches) reference.labels = reference_labels(hard_case);
  return reference;
}

namespace {

/// A model with another starting guess: the equilibrium at the end of a trace, to begin the way back from.
class StartingElsewhere : public Model {
 public:
  StartingElsewhere(const Model& model, Vector guess)
      : Model(model.description()), model_(model), guess_(std::move(guess)) {}
  Vector initial_guess(const Vector&) const override { return guess_; }
  Structure structure(int traced) const override { return model_.structure(traced); }
  EvaluationFault residual(const Path& path, int order, SteadyResidual& result,
                           EvaluationCounts& counts) const override {
    return model_.residual(path, order, result, counts);
  }
  EvaluationFault linearize(const Path& path, int order, Linearization& result,
                            EvaluationCounts& counts) const override {
    return model_.linearize(path, order, result, counts);
  }

 private:
  const Model& model_;
  Vector guess_;
};

/// The trace from the other end. Where the path has an equilibrium to be found, that of the end is taken from
/// a trace there; a path that ran back to where it began is travelled again from its own end.
RecordedTrace trace_back(const Setting& scene) {
  const RecordedTrace there = record_trace(scene);
  Setting back = make_setting(scene.scene.text, {});
  back.options = scene.options;
  back.options.from = there.nodes.back().p;
  back.options.to = there.nodes.back().p == scene.options.from ? scene.options.to : scene.options.from;
  back.model = std::make_unique<StartingElsewhere>(*scene.model, there.nodes.back().path.x.col(0));
  return record_trace(back);
}

}  // namespace

CaseReport run_case(const CaseReference& reference, const RunSetting& setting) {
  const HardCase& hard_case = *reference.hard_case;
  OptionTexts options{{"tolerance", exact_text(setting.tolerance)},
                      {"order", std::to_string(setting.order)},
                      {"max_nodes", "2000"}};
  if (setting.first_step > 0.0) {
    options.emplace_back("first_step",
                         exact_text(setting.first_step * std::abs(hard_case.to - hard_case.from)));
  }
  const Setting scene = make_setting(hard_case.scene, options);
  const RecordedTrace trace = setting.reversed ? trace_back(scene) : record_trace(scene);
  CaseReport report;
  report.completed = trace.result.status == TraceStatus::completed;
  report.message = trace.result.message;
  report.nodes = trace.result.nodes;
  const auto steps = static_cast<double>(std::max(1L, trace.result.mode_steps));
  report.lu_per_mode_step = static_cast<double>(trace.result.counts.modes.factorizations) / steps;
  report.uncertified_share = 1.0 - static_cast<double>(trace.result.certified_steps) / steps;
  if (trace.steps.empty()) return report;
  check_accuracy(reference, trace, setting.tolerance, report);
  check_events(hard_case, trace, setting.tolerance, report);
  check_labels(reference, trace, report);
  return report;
}

}  // namespace eigentrail::test
