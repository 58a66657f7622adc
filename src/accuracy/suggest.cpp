#include "eigentrail/accuracy/suggest.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "eigentrail/accuracy/data_errors.hpp"
#include "eigentrail/continuation/operating_point.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/model/sample_errors.hpp"

namespace eigentrail {
namespace {

/// Eigenvalues below this share of the median |s| count as zero, as in a trace.
constexpr double share_of_median = 1e-3;

double reference_of(const TraceOptions& options, const std::vector<OperatingMode>& modes) {
  if (options.reference) return *options.reference;
  std::vector<double> sizes;
  for (const OperatingMode& mode : modes) sizes.push_back(std::abs(mode.s));
  if (sizes.empty()) return 0.0;
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2), sizes.end());
  return share_of_median * sizes[sizes.size() / 2];
}

/// The largest error of the chosen modes at p.
Suggestion suggestion_at(const TraceSetup& setup, double p) {
  const OperatingPoint point = operating_points(setup, {p}).front();
  if (point.none_in_band) return {p, 0.0, {}, {}};
  if (!point.fault.empty()) throw InputError(setup.scene.path + ": " + point.fault);
  const Matrix errors = *data_errors_at(*setup.model, setup.options, point);
  const double reference = reference_of(setup.options, point.modes);
  Suggestion result{p, 0.0, {}, point.note};
  for (std::size_t i = 0; i < point.modes.size(); ++i) {
    const Complex s = point.modes[i].s;
    const double relative = errors(static_cast<Eigen::Index>(i), 0) / std::max(std::abs(s), reference);
    if (!(relative > result.error)) continue;
    result.error = relative;
    result.s = s;
  }
  return result;
}

/// A number near x with few decimals: nobody wants to run a program at 0.38214285. `length` of the gap.
double short_number(double x, double length) {
  constexpr double share = 0.02;
  const double decimals = -std::floor(std::log10(share * length));
  const double factor = std::pow(10.0, std::abs(decimals));
  return decimals > 0.0 ? std::round(x * factor) / factor : std::round(x / factor) * factor;
}

}  // namespace

std::vector<Suggestion> suggest_samples(const TraceSetup& setup) {
  const SampleErrors* errors = setup.model->sample_errors();
  if (errors == nullptr || errors->parameter() != setup.traced())
    throw InputError(setup.scene.path + ": suggestions are made for samples; expected a [sampled_family]");
  if (errors->values().size() < 2)
    throw InputError(setup.scene.path +
                     ": has one sample; at least two are needed, at the ends of the range");
  const double factor = setup.model->description().parameters.at(setup.options.parameter).factor;
  const auto [low, high] = std::minmax(setup.options.from, setup.options.to);
  std::vector<Suggestion> all;
  for (std::size_t i = 0; i + 1 < errors->values().size(); ++i) {
    const double from = std::max(errors->values()[i] / factor, low);
    const double to = std::min(errors->values()[i + 1] / factor, high);
    if (!(to > from)) continue;
    const double place = errors->place_of_largest_error(i, from * factor, to * factor) / factor;
    all.push_back(suggestion_at(setup, short_number(place, to - from)));
  }
  std::ranges::stable_sort(all, std::greater(), &Suggestion::error);
  return all;
}

}  // namespace eigentrail
