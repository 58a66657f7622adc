#include "continuation/step/least_magnitude.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Intervals between the first samples. The functions are polynomials of degree 11 at most and usually much
/// smoother. More samples find narrower minima and cost time at every step.
constexpr std::size_t intervals = 8;
/// Accuracy of the place, as a share of the step. Beside a simple zero an eigenvalue is then at most 1e-5 of
/// its change over the step, small enough to show a large relative error.
constexpr double accuracy = 1e-5;

/// Magnitude of the product of the eigenvalues of a block at t: it vanishes where one of them does.
class Magnitude {
 public:
  explicit Magnitude(const ComplexMatrix& functions) : functions_(functions), value_(functions.rows()) {}

  double operator()(double t) {
    value_ = functions_.col(functions_.cols() - 1);
    for (Eigen::Index k = functions_.cols() - 2; k >= 0; --k) value_ = value_ * t + functions_.col(k);
    const Eigen::Index k = block_size(value_.size());
    if (k == 1) return std::abs(value_[0]);
    if (k == 2) return std::abs(value_[0] * value_[0] - value_[1]);
    return std::abs(value_.reshaped(k, k).determinant());
  }

 private:
  const ComplexMatrix& functions_;
  ComplexVector value_;
};

struct Place {
  double t = 0.0, magnitude = std::numeric_limits<double>::infinity();
};

/// Local search for a minimum from a place: tries both sides, and halves the distance.
Place refine(Magnitude& magnitude, Place best) {
  for (double reach = 0.5 / intervals; reach > accuracy; reach *= 0.5) {
    for (const double t : {std::max(best.t - reach, 0.0), std::min(best.t + reach, 1.0)}) {
      if (const double there = magnitude(t); there < best.magnitude) best = {t, there};
    }
  }
  return best;
}

}  // namespace

double place_of_least_magnitude(const ComplexMatrix& functions) {
  Magnitude magnitude(functions);
  std::array<Place, intervals + 1> samples;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t = static_cast<double>(i) / intervals;
    samples[i] = {t, magnitude(t)};
  }
  Place least;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool falls_to_left = i > 0 && samples[i - 1].magnitude < samples[i].magnitude;
    const bool falls_to_right = i + 1 < samples.size() && samples[i + 1].magnitude < samples[i].magnitude;
    if (falls_to_left || falls_to_right) continue;
    const Place place = refine(magnitude, samples[i]);
    if (place.magnitude < least.magnitude) least = place;
  }
  return least.t;
}

}  // namespace eigentrail
