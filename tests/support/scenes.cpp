#include "support/scenes.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail::test {

PathProblem Setting::problem() const {
  PathProblem problem = problem_along(*model, options.parameter);
  problem.order = options.order;
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

PathPoint point_from_guess(const PathProblem& problem, double p, RunCounts& counts) {
  const Vector guess = problem.model.initial_guess(parameters_at(problem, p));
  PathPoint point = reduce_at(problem, p, {guess, Vector()}, Matrix(), counts);
  if (point.status != PointStatus::computed) throw std::runtime_error(point.message);
  const Spectrum spectrum = compute_spectrum(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
  const PencilAtPoint pencil(point.pencil);
  for (const StartingMode& mode : spectrum.modes) {
    point.modes.push_back(
        correct_mode(pencil, mode.s, mode.z, 1e-6 * spectrum.scale, problem.corrector, counts.modes));
    if (point.modes.back().status != ModeStatus::converged)
      throw std::runtime_error("a mode did not converge");
  }
  return point;
}

ComplexVector RecordedTrace::eigenvalues_at(double p) const {
  const bool ascending = nodes.back().p > nodes.front().p;
  const auto before = [&](const PathNode& node, double value) {
    return ascending ? node.p < value : node.p > value;
  };
  auto right = std::lower_bound(nodes.begin(), nodes.end(), p, before);
  if (right == nodes.begin()) ++right;
  const auto left = right - 1;
  return HermiteInterpolant(left->p, left->s, right->p, right->s)(p);
}

RecordedTrace record_trace(const Setting& setting, BasisChoice basis) {
  RecordedTrace recorded;
  TraceObserver observer;
  observer.node = [&](const PathNode& node) {
    recorded.nodes.push_back(node);
    return true;
  };
  recorded.result = trace(*setting.model, setting.options, observer, basis);
  return recorded;
}

}  // namespace eigentrail::test
