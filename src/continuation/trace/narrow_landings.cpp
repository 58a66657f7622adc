#include "continuation/trace/narrow_landings.hpp"

#include <algorithm>
#include <cmath>

#include "scene/narrow_places.hpp"

namespace eigentrail {
namespace {

/// Share of the range by which a trace stays away from a kink; the step across it is twice as long.
constexpr double beside_kink = 1e-11;

}  // namespace

std::vector<double> narrow_landings(const PathProblem& problem, const TraceOptions& options) {
  const Model& model = problem.model;
  std::vector<double> places = narrow_places(model.description().parameters, problem.parameters,
                                             problem.traced, options.from, options.to, model.expressions());
  const double beside = beside_kink * std::abs(options.to - options.from);
  for (const double kink : model.kinks(problem.traced)) {
    places.push_back(kink - beside);
    places.push_back(kink + beside);
  }
  for (const double place : model.landings(problem.traced)) places.push_back(place);
  std::sort(places.begin(), places.end());
  return places;
}

}  // namespace eigentrail
