#include "hard_cases/run_case.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/core/text.hpp"
#include "hard_cases/reference_labels.hpp"

namespace eigentrail::test {
namespace {

/// The modes as families of one.
std::vector<LabelledMode> one_by_one(const std::vector<Complex>& s) {
  std::vector<LabelledMode> modes;
  for (std::size_t i = 0; i < s.size(); ++i) modes.push_back({s[i], static_cast<int>(i)});
  return modes;
}

std::vector<CaseReference::Labels> labels_of(const HardCase& hard_case) {
  const auto grid = [](double low, double high, int count, const auto& modes_at) {
    std::vector<LabelledPlace> places;
    for (int i = 0; i < count; ++i) {
      const double p = low + (high - low) * (i + 0.5) / count;
      places.push_back({p, one_by_one(modes_at(p))});
    }
    return places;
  };
  if (hard_case.has_branches) {
    const auto [low, high] = std::minmax(hard_case.from, hard_case.to);
    return {{0, grid(low, high, 199, [&](double p) {
               std::vector<Complex> s;
               for (const auto& branch : hard_case.branches) s.push_back(branch(p));
               return s;
             })}};
  }
  std::vector<CaseReference::Labels> labels;
  for (const LabelledStretch& stretch : reference_labels(hard_case)) {
    if (stretch.complete())
      labels.push_back({stretch.branch(), grid(stretch.low(), stretch.high(), 60, stretch)});
  }
  return labels;
}

/// A model with another starting guess: the equilibrium at the end of a trace, where the reverse trace
/// starts.
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

/// The trace from the other end, to which `there` leads: it gives the starting value of the equilibrium. If
/// the path returns to the parameter value at which it begins, its own end is the start.
RecordedTrace trace_back(const Setting& scene, const RecordedTrace& there) {
  Setting back = make_setting(scene.scene.text, {});
  back.options = scene.options;
  back.options.from = there.nodes.back().p;
  back.options.to = there.nodes.back().p == scene.options.from ? scene.options.to : scene.options.from;
  back.model = std::make_unique<StartingElsewhere>(*scene.model, there.nodes.back().path.x.col(0));
  return record_trace(back);
}

}  // namespace

CaseReference make_reference(const HardCase& hard_case, int random_samples) {
  CaseReference reference;
  reference.hard_case = &hard_case;
  for (const double p : sample_parameters(hard_case, random_samples))
    reference.samples.push_back(sample_at(hard_case, p));
  reference.labels = labels_of(hard_case);
  return reference;
}

RecordedTrace trace_case(const HardCase& hard_case, const RunSetting& setting, const RecordedTrace* there) {
  OptionTexts options{{"tolerance", exact_text(setting.tolerance)},
                      {"order", std::to_string(setting.order)},
                      {"max_nodes", "2000"}};
  if (setting.first_step > 0.0) {
    options.emplace_back("first_step",
                         exact_text(setting.first_step * std::abs(hard_case.to - hard_case.from)));
  }
  Setting scene = make_setting(hard_case.scene, options);
  scene.options.thresholds = setting.thresholds;
  if (!setting.reversed) return record_trace(scene);
  return trace_back(scene, there != nullptr ? *there : record_trace(scene));
}

std::string CaseReport::problems() const {
  std::string text;
  if (!completed) text += "ended early: " + message + "; ";
  if (worst_error > 4.0)
    text += "error " + std::to_string(worst_error) + " tolerances at " + std::to_string(worst_at) + "; ";
  if (most_retrackings > 4) text += std::to_string(most_retrackings) + " points for one event; ";
  if (wrong_labels > 0) text += std::to_string(wrong_labels) + " wrong labels; ";
  for (const std::string& event : missing) text += "missing " + event + "; ";
  for (const std::string& event : invented) text += "invented " + event + "; ";
  return text;
}

CaseReport check_case(const CaseReference& reference, const RecordedTrace& trace, double tolerance) {
  const HardCase& hard_case = *reference.hard_case;
  CaseReport report;
  report.completed = trace.result.status == TraceStatus::completed;
  report.message = trace.result.message;
  report.nodes = trace.result.nodes;
  if (trace.steps.empty()) return report;
  const Accuracy accuracy = measure_accuracy(reference.samples, trace, tolerance);
  report.worst_error = accuracy.worst_error;
  report.worst_at = accuracy.worst_at;
  const EventComparison events = compare_events(hard_case, trace, tolerance);
  report.missing = events.missing;
  report.invented = events.invented;
  for (const Event& event : trace.result.events) {
    if (event.kind != EventKind::veering)
      report.most_retrackings = std::max(report.most_retrackings, event.retrackings);
  }
  LabelCount labels;
  for (const auto& [branch, places] : reference.labels) count_labels(trace, places, branch, labels);
  report.wrong_labels = labels.wrong;
  return report;
}

}  // namespace eigentrail::test
