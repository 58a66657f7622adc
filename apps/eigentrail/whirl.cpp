#include "whirl.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace eigentrail::app {
namespace {

/// Sum of ellipses: their signed areas, and the areas of circles of the same size.
struct Orbits {
  double area = 0.0, size = 0.0;

  void add(const Eigen::Vector3cd& a, const Eigen::Vector3d& axis) {
    const Eigen::Vector3cd across = a - axis * axis.cast<Complex>().dot(a);
    area -= 2.0 * across.real().cross(across.imag()).dot(axis);
    size += across.squaredNorm();
  }
  /// 1: circles in the sense of the axis, -1: against it; 0 where nothing moves.
  double sense() const { return size > 0.0 ? area / size : 0.0; }
};

/// A disc: index of the first coordinate of its body's origin and of its axis, and the speed.
struct Disc {
  Eigen::Index origin = 0, axis = 0;
  double speed = 0.0;
};

std::optional<Eigen::Index> coordinate(const TraceSetup& setup, const std::string& name) {
  const auto& names = setup.model->description().coordinate_names;
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::nullopt : std::optional<Eigen::Index>(found - names.begin());
}

/// The disc of a table; empty if its axis is not one of a body.
std::optional<Disc> read_disc(const TraceSetup& setup, const Table& table, const Vector& si) {
  std::set<int> used;
  TableReader reader(setup.scene, table, "[[spinning_disc]]", used);
  const Value* axis = table.find("axis");
  const auto* text = axis == nullptr ? nullptr : std::get_if<std::string>(&axis->data);
  const std::size_t point = text == nullptr ? std::string::npos : text->rfind('.');
  if (point == std::string::npos) return std::nullopt;
  const std::string body = text->substr(0, point);
  const auto origin = coordinate(setup, body + ".x");
  const auto director = coordinate(setup, *text + "_axis.x");
  if (!origin || !director) return std::nullopt;
  const Expression speed = reader.expression("speed");
  return Disc{*origin, *director,
              speed.evaluate(std::span<const double>(si.data(), static_cast<std::size_t>(si.size())))};
}

}  // namespace

std::string whirl_direction(const TraceSetup& setup, const Event& event) {
  const std::vector<const Table*> discs = tables(setup.scene, "spinning_disc");
  if (discs.empty() || event.shape.size() != setup.model->n_coordinates()) return "";
  Vector values = setup.scene.parameters.declared_values();
  values[setup.traced()] = event.p;
  const Vector guess = setup.model->initial_guess(values);
  Vector si = values;
  setup.scene.parameters.to_si(std::span<double>(si.data(), setup.scene.parameters.size()));
  Orbits centres, axes;
  for (const Table* table : discs) {
    const auto disc = read_disc(setup, *table, si);
    if (!disc || disc->speed == 0.0) continue;
    const Eigen::Vector3d axis = std::copysign(1.0, disc->speed) * guess.segment<3>(disc->axis).normalized();
    centres.add(event.shape.segment<3>(disc->origin), axis);
    axes.add(event.shape.segment<3>(disc->axis), axis);
  }
  // An ellipse with a short axis below a twentieth of the long one counts as a line.
  constexpr double round = 0.1;
  const double most = std::max(centres.sense(), axes.sense());
  const double least = std::min(centres.sense(), axes.sense());
  if (most > round && least < -round) return "mixed";
  return most > round ? "forward" : least < -round ? "backward" : "";
}

}  // namespace eigentrail::app
