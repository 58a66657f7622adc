#include "model/sampled_family.hpp"

#include <algorithm>
#include <cmath>

#include "core/transposition.hpp"
#include "eigentrail/core/text.hpp"
#include "model/affine_factor.hpp"
#include "model/series_sum.hpp"

namespace eigentrail {
namespace {

std::vector<Matrix> same_as_one(std::vector<Matrix> list) {
  const bool constant =
      std::all_of(list.begin(), list.end(), [&list](const Matrix& one) { return one == list.front(); });
  if (constant) list.resize(1);
  return list;
}

/// Half a unit in the last of `digits` digits. Zeros and ones are exact: they stand for entries that are so
/// by definition, such as those of x' = v.
double half_unit(double entry, int digits) {
  const double magnitude = std::abs(entry);
  if (magnitude == 0.0 || magnitude == 1.0) return 0.0;
  return 0.5 * std::pow(10.0, std::floor(std::log10(magnitude)) - digits + 1);
}

PencilSamples pencil_samples(int power, const std::vector<Matrix>& list, const SampledData& data) {
  PencilSamples result{power, same_as_one(list)};
  if (!data.digits || list.empty()) return result;
  const int digits = *data.digits;
  for (const Matrix& sample : result.samples)
    result.entry_errors.push_back(sample.unaryExpr([digits](double x) { return half_unit(x, digits); }));
  return result;
}

/// The coefficients of s^2 M + s C + K. E of E x' = A x is C, and -A is K.
std::array<PencilSamples, 3> all_samples(const SampledData& data) {
  const Eigen::Index n = data.size();
  const auto or_zero = [&](int power, const std::vector<Matrix>& list) {
    return list.empty() ? PencilSamples{power, {Matrix::Zero(n, n)}} : pencil_samples(power, list, data);
  };
  if (!data.first_order()) return {or_zero(2, data.M), or_zero(1, data.C), or_zero(0, data.K)};
  PencilSamples stiffness = pencil_samples(0, data.A, data);
  for (Matrix& sample : stiffness.samples) sample = -sample;
  if (!data.A_error.empty()) stiffness.entry_errors = data.A_error;
  return {PencilSamples{2, {Matrix::Zero(n, n)}},
          data.E.empty() ? PencilSamples{1, {Matrix::Identity(n, n)}} : pencil_samples(1, data.E, data),
          std::move(stiffness)};
}

bool all_zero(const PencilSamples& list) {
  return std::all_of(list.samples.begin(), list.samples.end(),
                     [](const Matrix& one) { return one.isZero(0.0); });
}

ModelDescription with_effects(ModelDescription description, const SampledData& data,
                              const std::array<PencilSamples, 3>& samples) {
  const auto count = [](const PencilSamples& one) {
    return all_zero(one) ? 0 : static_cast<int>(one.samples.size());
  };
  const auto& [M, C, K] = samples;
  const bool states = data.first_order();
  description.effects = {
      {"M", "samples of the mass matrix", count(M), {.inertia = true}},
      {states ? "E" : "C",
       states ? "samples of the matrix of the derivatives" : "samples of the damping and gyroscopic matrix",
       count(C), damping_parts(C.samples)},
      {states ? "A" : "K", states ? "samples of the state matrix" : "samples of the stiffness matrix",
       count(K), stiffness_parts(K.samples)}};
  return description;
}

}  // namespace

SampledFamily::SampledFamily(ModelDescription description, int variable, const SampledData& data,
                             std::vector<SamplePiece> pieces)
    : SampledFamily(std::move(description), variable, data, std::move(pieces), all_samples(data)) {}

SampledFamily::SampledFamily(ModelDescription description, int variable, const SampledData& data,
                             std::vector<SamplePiece> pieces, std::array<PencilSamples, 3> samples)
    : MatrixModel(with_effects(std::move(description), data, samples)),
      variable_(variable),
      values_(data.values),
      pieces_(std::move(pieces)),
      samples_(std::move(samples)),
      errors_(variable, values_, samples_, pieces_) {}

Structure SampledFamily::structure(int traced_parameter) const {
  const bool moves = description().parameters.depends_on(variable_, traced_parameter);
  const auto& [M, C, K] = samples_;
  Structure result = structure_of_effects();
  result.symmetric_mass = all_equal_transposes(M.samples, 1.0);
  result.constant_mass = !moves || M.is_constant();
  result.constant_damping = !moves || C.is_constant();
  result.constant_stiffness = !moves || K.is_constant();
  return result;
}

CoefficientMatrices SampledFamily::coefficient_matrices(const Vector&, int) const {
  return {samples_[0].samples, samples_[1].samples, samples_[2].samples};
}

std::vector<double> SampledFamily::kinks(int traced_parameter) const {
  std::vector<double> places;
  if (traced_parameter != variable_) return places;
  const double factor = description().parameters[static_cast<std::size_t>(variable_)].factor;
  for (std::size_t i = 1; i < pieces_.size(); ++i)
    places.push_back(pieces_[i].interpolant.nodes().front() / factor);
  return places;
}

template <class Real, int Q>
EvaluationFault SampledFamily::evaluate_all(const BasicPath<Real>& path, int order,
                                            BasicLinearization<Real>& result,
                                            EvaluationCounts& counts) const {
  using Scalar = Series<Real, Q>;
  const std::vector<Scalar> si = si_series<Real, Q>(description().parameters, path);
  const Scalar& x = si[static_cast<std::size_t>(variable_)];
  const double at = leading_value(x);
  const double slack = same_value * std::max(std::abs(values_.front()), std::abs(values_.back()));
  if (!(at >= values_.front() - slack && at <= values_.back() + slack))
    return {"an interpolant of samples from " + exact_text(values_.front()) + " to " +
            exact_text(values_.back()) + " at " + exact_text(at)};
  const SamplePiece& piece = piece_at(pieces_, at);
  const std::vector<Scalar> basis = piece.interpolant.basis(x);
  std::size_t effect = 0;
  const auto evaluate_one = [&](const PencilSamples& samples) {
    if (description().effects[effect].count > 0) ++counts.linearization[effect];
    ++effect;
    DenseSum<Real, Q> sum(n_coordinates(), n_coordinates(), order);
    if (samples.is_constant()) {
      sum.add(Scalar(1.0), samples.samples[0]);
    } else {
      for (std::size_t j = 0; j < basis.size(); ++j) sum.add(basis[j], samples.at(piece.first + j));
    }
    return sum.take();
  };
  result.M = evaluate_one(samples_[0]);
  result.C = evaluate_one(samples_[1]);
  result.K = evaluate_one(samples_[2]);
  result.A = {typename BasicSystemMatrix<Real>::Dense(0, n_coordinates())};
  return {};
}

EvaluationFault SampledFamily::linearize(const Path& path, int order, Linearization& result,
                                         EvaluationCounts& counts) const {
  return evaluate_all<double, max_order>(path, order, result, counts);
}

EvaluationFault SampledFamily::extended_linearization(const BasicPath<Extended>& path,
                                                      BasicLinearization<Extended>& result) const {
  EvaluationCounts counts = new_counts();
  return evaluate_all<Extended, 0>(path, 0, result, counts);
}

}  // namespace eigentrail
