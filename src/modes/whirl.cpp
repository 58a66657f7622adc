#include "eigentrail/modes/whirl.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "eigentrail/model/projection.hpp"

namespace eigentrail {
namespace {

/// Areas of ellipses by sense, and of the circles about them, over pi.
struct OrbitAreas {
  double forward = 0.0, backward = 0.0, circles = 0.0;

  /// `sense`: sign of the spin.
  void add(Complex x, Complex y, double sense) {
    const Complex i(0.0, 1.0);
    const double F = std::abs(x + i * y) / 2.0, B = std::abs(x - i * y) / 2.0;
    // Re(X e^(iwt)) + i Re(Y e^(iwt)) = F' e^(iwt) + B' e^(-iwt), F' = (X + iY)/2, |B'| = |X - iY|/2.
    const double area = sense * (F * F - B * B);
    (area > 0.0 ? forward : backward) += std::abs(area);
    circles += (F + B) * (F + B);
  }
  Whirl whirl() const {
    if (!(circles > 0.0)) return {};
    return {(forward - backward) / circles, std::min(forward, backward) / circles};
  }
};

/// The orbits of all nodes, in the sense of the first shaft that spins.
void add_shafts(const Model& model, const std::vector<double>& si, const ComplexVector& shape,
                OrbitAreas& areas) {
  const std::vector<SpinningShaft>& shafts = model.description().shafts;
  double sense = 0.0;
  for (const SpinningShaft& shaft : shafts) {
    const double speed = shaft.speed.evaluate(std::span<const double>(si));
    if (sense == 0.0 && speed != 0.0) sense = std::copysign(1.0, speed);
  }
  if (sense == 0.0) return;
  for (const SpinningShaft& shaft : shafts) {
    for (const std::array<Complex, 2>& at : displacements(model, shaft, shape))
      areas.add(at[0], at[1], sense);
  }
}

/// The components of a vector across an axis.
void add_across(const ComplexVector& shape, Eigen::Index first, const Eigen::Vector3d& axis,
                OrbitAreas& areas) {
  const Eigen::Vector3d one = axis.unitOrthogonal(), other = axis.cross(one);
  const Eigen::Vector3cd at = shape.segment<3>(first);
  areas.add(one.cast<Complex>().dot(at), other.cast<Complex>().dot(at), 1.0);
}

Whirl whirl_of_bodies(const Model& model, const Vector& parameters, const std::vector<double>& si,
                      const ComplexVector& shape) {
  const Vector guess = model.initial_guess(parameters);
  OrbitAreas centres, tips;
  for (const SpinningAxis& spin : model.description().spins) {
    const double speed = spin.speed.evaluate(std::span<const double>(si));
    if (speed == 0.0) continue;
    const Eigen::Vector3d axis = std::copysign(1.0, speed) * guess.segment<3>(spin.director).normalized();
    add_across(shape, spin.origin, axis, centres);
    add_across(shape, spin.director, axis, tips);
  }
  const Whirl a = centres.whirl(), b = tips.whirl();
  if (std::isnan(a.measure) || std::isnan(b.measure)) return std::isnan(a.measure) ? b : a;
  Whirl larger = std::abs(a.measure) >= std::abs(b.measure) ? a : b;
  if (a.measure * b.measure < 0.0)
    larger.reverse = std::max(larger.reverse, std::min(std::abs(a.measure), std::abs(b.measure)) / 2.0);
  return larger;
}

}  // namespace

std::vector<std::array<Complex, 2>> displacements(const Model& model, const SpinningShaft& shaft,
                                                  const ComplexVector& shape) {
  const Projection* projection = model.projection();
  const auto component = [&](Eigen::Index coordinate) -> Complex {
    if (coordinate < 0) return 0.0;
    if (projection == nullptr || projection->basis.size() == 0) return shape[coordinate];
    return (projection->basis.row(coordinate).cast<Complex>() * shape)(0);
  };
  std::vector<std::array<Complex, 2>> result;
  for (const auto& [x, y] : shaft.nodes) result.push_back({component(x), component(y)});
  return result;
}

bool has_whirl(const ModelDescription& description) {
  return !description.shafts.empty() || !description.spins.empty();
}

Whirl whirl_of(const Model& model, const Vector& parameters, const ComplexVector& shape) {
  const ModelDescription& description = model.description();
  if (!has_whirl(description) || shape.size() != model.n_coordinates() || !shape.allFinite()) return {};
  std::vector<double> si(parameters.begin(), parameters.end());
  description.parameters.to_si(std::span<double>(si));
  if (description.shafts.empty()) return whirl_of_bodies(model, parameters, si, shape);
  OrbitAreas areas;
  add_shafts(model, si, shape, areas);
  return areas.whirl();
}

std::string whirl_in_words(const Whirl& whirl) {
  // Ellipses with a short axis below a twentieth of the long one count as lines.
  constexpr double clear = 0.05;
  // Nodes at which a mode goes round the other way count if their orbits have this share of all.
  constexpr double notable = 0.05;
  if (whirl.reverse > notable) return "mixed";
  return whirl.measure > clear ? "forward" : whirl.measure < -clear ? "backward" : "";
}

}  // namespace eigentrail
