#include "support/scenes.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail::test {

PathProblem Setting::problem() const {
  PathProblem problem = problem_along(*model, options.parameter);
  problem.order = options.order.value_or(usual_order);
  return problem;
}

int Setting::parameter(const std::string& name) const {
  return scene.parameters.index(name).value();
}

Setting make_setting(const std::string& text, const OptionTexts& overrides) {
  return {prepare_trace(parse_scene(text, "test.toml"), overrides)};
}

Setting scene_setting(const std::string& name, const OptionTexts& overrides,
                      const std::vector<std::pair<std::string, std::string>>& replacements) {
  std::ifstream file(std::string(EIGENTRAIL_DATA_DIR) + "/scenes/" + name + ".toml");
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (text.empty()) throw std::invalid_argument("no scene " + name);
  for (const auto& [what, with] : replacements) {
    const std::size_t at = text.find(what);
    if (at == std::string::npos) throw std::invalid_argument("scene " + name + " does not contain " + what);
    text.replace(at, what.size(), with);
  }
  return make_setting(text, overrides);
}

Setting pushed_pendulum(const PushedPendulum& pendulum, const OptionTexts& overrides) {
  std::ostringstream text;
  text.precision(17);
  text << "[parameters]\np = " << pendulum.from << "\nunit = " << pendulum.unit
       << "\nmass = " << pendulum.mass << "\nlength = " << pendulum.length
       << "\n[trace]\nparameter = \"p\"\nfrom = " << pendulum.from << "\nto = " << pendulum.to
       << "\n[[point]]\nname = \"bob\"\nmass = \"mass\"\nposition = [" << pendulum.guess << R"(, 0, "-length"]
[gravity]
acceleration = [0, 0, -9.81]
[[rod]]
from = [0, 0, 0]
to = "bob"
length = "length"
[[fixed]]
point = "bob"
coordinate = "y"
[[follower_force]]
point = "bob"
from = [0, 0, 0]
to = "bob"
magnitude = "p / unit * mass * 9.81"
axis = [0, -1, 0]
angle = "pi / 2"
)";
  return make_setting(text.str(), overrides);
}

Equilibrium at_rest(const Setting& setting, const std::vector<std::pair<std::string, double>>& values) {
  EvaluationCounts counts = setting.model->new_counts();
  Vector parameters = setting.scene.parameters.declared_values();
  for (const auto& [name, value] : values) parameters[setting.parameter(name)] = value;
  return solve_equilibrium(*setting.model, parameters, setting.model->initial_guess(parameters), Vector(), {},
                           counts);
}

PathPoint point_from_guess(const PathProblem& problem, double p, RunCounts& counts) {
  const Vector guess = problem.model.initial_guess(parameters_at(problem, p));
  PathPoint point = reduce_at(problem, p, {guess, Vector()}, Matrix(), counts);
  if (point.status != PointStatus::computed) throw std::runtime_error(point.message);
  const Spectrum spectrum = compute_spectrum(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
  const PencilAtPoint pencil(point.pencil);
  for (const StartingMode& mode : spectrum.modes) {
    InvariantPair start;
    start.is_real = mode.s.imag() == 0.0;
    start.Z = mode.z;
    start.Lambda = ComplexMatrix::Constant(1, 1, mode.s);
    if (start.is_real) start.Z.imag().setZero();
    point.pairs.push_back(
        correct_pair(pencil, start, 1e-6 * spectrum.scale, problem.corrector, counts.modes));
    if (point.pairs.back().status != PairStatus::converged)
      throw std::runtime_error("a mode did not converge");
  }
  return point;
}

ComplexVector RecordedTrace::eigenvalues_of_node(std::size_t node) const {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  ComplexVector s = ComplexVector::Constant(result.n_columns, Complex(nan, nan));
  for (const ModeState& state : modes[node]) s[state.mode] = state.s;
  return s;
}

std::vector<ComplexVector> RecordedTrace::all_eigenvalues_at(double p) const {
  std::vector<ComplexVector> found;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (const double t : step_positions(steps[i], p)) {
      if (t == 0.0 && i > 0) continue;  // the end of the step before
      found.push_back(step_eigenvalues(steps[i], eigenvalues_of_node(i), eigenvalues_of_node(i + 1), t));
    }
  }
  return found;
}

ComplexVector RecordedTrace::eigenvalues_at(double p) const {
  const auto all = all_eigenvalues_at(p);
  if (all.empty()) throw std::out_of_range("the trace does not pass " + std::to_string(p));
  return all.front();
}

RecordedTrace record_trace(const Setting& setting, BasisChoice basis) {
  RecordedTrace recorded;
  TraceObserver observer;
  observer.point = [&](const TracePoint& point) {
    recorded.nodes.push_back(point.node);
    recorded.modes.push_back(point.modes);
    if (point.step != nullptr) recorded.steps.push_back(*point.step);
    return true;
  };
  recorded.result = trace(*setting.model, setting.options, observer, basis);
  return recorded;
}

RecordedTrace completed_trace(const Setting& setting) {
  RecordedTrace recorded = record_trace(setting);
  if (recorded.result.status != TraceStatus::completed) throw std::runtime_error(recorded.result.message);
  return recorded;
}

std::vector<Event> events_of(const TraceResult& result, EventKind kind) {
  std::vector<Event> found;
  std::copy_if(result.events.begin(), result.events.end(), std::back_inserter(found),
               [kind](const Event& event) { return event.kind == kind; });
  std::sort(found.begin(), found.end(), [](const Event& a, const Event& b) { return a.p < b.p; });
  return found;
}

std::vector<double> places_of(const TraceResult& result, EventKind kind) {
  std::vector<double> places;
  for (const Event& event : events_of(result, kind)) places.push_back(event.p);
  return places;
}

Event only_event(const TraceResult& result, EventKind kind) {
  const std::vector<Event> found = events_of(result, kind);
  if (found.size() == 1) return found.front();
  throw std::runtime_error(std::to_string(found.size()) + " events of the kind " + event_name(kind));
}

}  // namespace eigentrail::test
