#include "projection/large_spectrum.hpp"

#include <algorithm>
#include <cmath>

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

LargeSpectrum::LargeSpectrum(const Model& model, const TraceOptions& trace)
    : trace_(trace),
      large_(large_model_of(shared(model), trace)),
      finder_(std::clamp(share_of_tolerance * trace.tolerance, 1e-13, 1e-9)) {}

double LargeSpectrum::add(const SparsePencil& pencil, const Shift& shift, int count, double cover,
                          std::vector<Complex>& found) {
  const int most = static_cast<int>(pencil.freedoms()) - 2;
  const auto modes =
      finder_.find(pencil, {shift, std::min(count, most), cover, std::min(3 * count, most), std::nullopt});
  if (!modes) return 0.0;
  found.insert(found.end(), modes->s.begin(), modes->s.end());
  return modes->radius;
}

std::vector<Complex> LargeSpectrum::beside(const ComplexVector& wanted, double p, const Vector& x,
                                           const Vector& lambda) {
  const auto place =
      large_->place_near({p, parameters_at(large_->model(), trace_, trace_.values, p), x, lambda});
  if (!place) return {};
  const SparsePencil pencil = large_->pencil(*place);
  const Shift usual = usual_shift(trace_.modes);
  double farthest = 0.0;
  int count = spare;
  for (const Complex s : wanted) {
    if (!std::isfinite(std::abs(s))) continue;
    farthest = std::max(farthest, std::abs(s - usual.value()));
    ++count;
  }
  std::vector<Complex> found;
  const double radius = add(pencil, usual, count, 1.01 * farthest, found);
  for (const Complex s : wanted) {
    if (!std::isfinite(std::abs(s)) || std::abs(s - usual.value()) <= radius) continue;
    add(pencil, {0.0, std::max(s.imag(), 1e-3 * std::abs(s))}, spare, std::abs(s.real()), found);
  }
  return found;
}

}  // namespace eigentrail
