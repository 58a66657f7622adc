#include "eigentrail/projection/large_spectrum.hpp"

#include <algorithm>
#include <cmath>

#include "projection/large_model.hpp"

namespace eigentrail {
namespace {

/// Modes beyond the wanted ones that are looked for, so that the nearest ones are surely there.
constexpr int spare = 3;
/// Accuracy of the eigenvalues as a share of the tolerance that they check.
constexpr double share_of_tolerance = 0.01;

/// Does not own the model.
std::shared_ptr<const Model> shared(const Model& model) {
  return {std::shared_ptr<const Model>(), &model};
}

}  // namespace

struct LargeSpectrum::Implementation {
  const Model& model;
  const TraceOptions& trace;
  std::unique_ptr<LargeModel> large;
  ModeFinder finder;

  Vector parameters_at(double p) const {
    const Parameters& all = model.description().parameters;
    Vector values = all.declared_values();
    for (const auto& [name, value] : trace.values) values[all.index(name).value()] = value;
    values[all.index(trace.parameter).value()] = p;
    return values;
  }

  /// Adds the modes nearest to the shift, and those within `cover` of it, to `found`; returns the radius
  /// within which all are known, 0 if there is no answer.
  double add(const SparsePencil& pencil, const Shift& shift, int count, double cover,
             std::vector<Complex>& found) {
    const int most = static_cast<int>(pencil.freedoms()) - 2;
    const auto modes =
        finder.find(pencil, {shift, std::min(count, most), cover, std::min(3 * count, most), std::nullopt});
    if (!modes) return 0.0;
    found.insert(found.end(), modes->s.begin(), modes->s.end());
    return modes->radius;
  }
};

LargeSpectrum::LargeSpectrum(const Model& model, const TraceOptions& trace, const SparseSolverMaker& solver)
    : implementation_(std::make_unique<Implementation>(Implementation{
          model, trace, large_model_of(shared(model), trace),
          ModeFinder(std::clamp(share_of_tolerance * trace.tolerance, 1e-13, 1e-9), solver)})) {}

LargeSpectrum::~LargeSpectrum() = default;

std::vector<Complex> LargeSpectrum::beside(const ComplexVector& wanted, double p, const Vector& x,
                                           const Vector& lambda) {
  Implementation& it = *implementation_;
  const auto place = it.large->place_near({p, it.parameters_at(p), x, lambda});
  if (!place) return {};
  const SparsePencil pencil = it.large->pencil(*place);
  const Shift usual = usual_shift(it.trace.modes);
  double farthest = 0.0;
  int count = spare;
  for (const Complex s : wanted) {
    if (!std::isfinite(std::abs(s))) continue;
    farthest = std::max(farthest, std::abs(s - usual.value()));
    ++count;
  }
  std::vector<Complex> found;
  const double radius = it.add(pencil, usual, count, 1.01 * farthest, found);
  for (const Complex s : wanted) {
    if (!std::isfinite(std::abs(s)) || std::abs(s - usual.value()) <= radius) continue;
    it.add(pencil, {0.0, std::max(s.imag(), 1e-3 * std::abs(s))}, spare, std::abs(s.real()), found);
  }
  return found;
}

}  // namespace eigentrail
