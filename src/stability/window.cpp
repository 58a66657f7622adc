#include "stability/window.hpp"

#include <stdexcept>

#include "core/texts.hpp"

namespace eigentrail {
namespace {

PathProblem problem_of(const Model& model, const BoundaryOptions& options) {
  const Parameters& parameters = model.description().parameters;
  for (const std::string& name : {options.trace.parameter, options.second}) {
    if (!parameters.index(name))
      throw std::invalid_argument("find_boundaries: the model has no parameter '" + name + "'");
  }
  return problem_along(model, options.trace.parameter);
}

/// Properties that hold while both parameters change, from those for each parameter alone.
Structure united(const Structure& a, const Structure& b) {
  Structure both = a;
  for (bool Structure::*holds :
       {&Structure::constant_mass, &Structure::constant_damping, &Structure::constant_stiffness,
        &Structure::constant_constraints, &Structure::fixed_equilibrium, &Structure::known_equilibrium})
    both.*holds = a.*holds && b.*holds;
  return both;
}

}  // namespace

Window::Window(const Model& model, const BoundaryOptions& options)
    : problem_(problem_of(model, options)),
      index_{problem_.traced, *model.description().parameters.index(options.second)},
      from_(options.trace.from, options.second_from),
      to_(options.trace.to, options.second_to),
      size_(to_ - from_) {
  problem_.order = options.trace.order.value_or(usual_order);
  problem_.structure = united(model.structure(index_[0]), model.structure(index_[1]));
}

Place Window::declared(const Place& place) const {
  Place result = from_ + size_.cwiseProduct(place);
  for (int i = 0; i < 2; ++i) {
    if (place[i] == 0.0) result[i] = from_[i];
    if (place[i] == 1.0) result[i] = to_[i];
  }
  return result;
}

VectorSeries Window::parameters(const Matrix& places) const {
  VectorSeries series = VectorSeries::Zero(problem_.parameters.size(), places.cols());
  series.col(0) = problem_.parameters;
  const Place first = declared(places.col(0));
  for (int i = 0; i < 2; ++i) {
    const int row = index_[static_cast<std::size_t>(i)];
    series.row(row) = size_[i] * places.row(i);
    series(row, 0) = first[i];
  }
  return series;
}

PathProblem Window::at(const Place& place) const {
  PathProblem problem = problem_;
  const Place values = declared(place);
  problem.parameters[index_[0]] = values[0];
  problem.parameters[index_[1]] = values[1];
  return problem;
}

const std::string& Window::name(int coordinate) const {
  const auto& names = problem_.model.description().parameters.names();
  return names[static_cast<std::size_t>(index_[static_cast<std::size_t>(coordinate)])];
}

std::string Window::value_text(int coordinate, double u) const {
  return short_text(declared(Place::Constant(u))[coordinate], 8);
}

std::string Window::text(const Place& place) const {
  return name(0) + " = " + value_text(0, place[0]) + ", " + name(1) + " = " + value_text(1, place[1]);
}

}  // namespace eigentrail
