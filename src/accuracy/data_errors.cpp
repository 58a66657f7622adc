#include "eigentrail/accuracy/data_errors.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "continuation/events/criterion.hpp"
#include "core/bisection.hpp"
#include "core/gaps.hpp"
#include "core/lapack.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/model/sample_errors.hpp"

namespace eigentrail {
namespace {

/// |beta| below this share of |alpha|: the eigenvalue is infinite.
constexpr double infinite = 1e-13;
/// Eigenvalues closer than this share of their magnitude are equal.
constexpr double equal = 1e-7;

/// Complex vectors from LAPACK's storage, where the real and the imaginary parts of a conjugate pair, that
/// with a positive imaginary part of its eigenvalue first, are neighbours.
ComplexMatrix complex_vectors(const Matrix& parts, const Vector& imaginary) {
  ComplexMatrix vectors = parts.cast<Complex>();
  for (Eigen::Index j = 0; j < parts.cols(); ++j) {
    if (!(imaginary[j] > 0.0)) continue;
    vectors.col(j).imag() = parts.col(j + 1);
    vectors.col(j + 1) = vectors.col(j).conjugate();
  }
  return vectors;
}

/// Replaces entries by zero that are below rounding of others of their row and of their column: noise of the
/// computation that the matrix comes from. Balancing would take it for the size of its row or column.
void drop_noise(Matrix& a) {
  const Vector rows = a.cwiseAbs().rowwise().maxCoeff();
  const Vector columns = a.cwiseAbs().colwise().maxCoeff().transpose();
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      if (std::abs(a(i, j)) <= std::numeric_limits<double>::epsilon() * std::min(rows[i], columns[j]))
        a(i, j) = 0.0;
    }
  }
}

/// a x = lambda b x, with vectors u^H a = lambda u^H b.
std::vector<EigenTriple> generalized(Matrix a, Matrix b) {
  drop_noise(a);
  drop_noise(b);
  const Eigen::Index n = a.rows();
  const auto size = static_cast<lapack_int>(n);
  Vector real(n), imaginary(n), beta(n), left_scale(n), right_scale(n), rcond_values(n), rcond_vectors(n);
  Matrix left(n, n), right(n, n);
  lapack_int low = 0, high = 0;
  double norm_a = 0.0, norm_b = 0.0;
  const lapack_int info = LAPACKE_dggevx(
      LAPACK_COL_MAJOR, 'B', 'V', 'V', 'N', size, a.data(), size, b.data(), size, real.data(),
      imaginary.data(), beta.data(), left.data(), size, right.data(), size, &low, &high, left_scale.data(),
      right_scale.data(), &norm_a, &norm_b, rcond_values.data(), rcond_vectors.data());
  std::vector<EigenTriple> all;
  if (info != 0) return all;
  const ComplexMatrix x = complex_vectors(right, imaginary), u = complex_vectors(left, imaginary);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Complex alpha(real[j], imaginary[j]);
    if (std::abs(beta[j]) > infinite * std::abs(alpha)) all.push_back({alpha / beta[j], x.col(j), u.col(j)});
  }
  return all;
}

/// Replaces the left vectors of equal eigenvalues by combinations with Y^H P'(s) Z diagonal.
void make_biorthogonal(std::vector<EigenTriple>& all, const Matrix& M, const Matrix& C) {
  std::ranges::sort(all, {}, [](const EigenTriple& one) { return std::pair(one.s.imag(), one.s.real()); });
  for (std::size_t begin = 0; begin < all.size();) {
    std::size_t end = begin + 1;
    while (end < all.size() && std::abs(all[end].s - all[begin].s) <= equal * std::abs(all[begin].s)) ++end;
    const auto count = static_cast<Eigen::Index>(end - begin);
    if (count > 1) {
      ComplexMatrix Y(M.rows(), count), slopes(M.rows(), count);
      for (Eigen::Index i = 0; i < count; ++i) {
        const EigenTriple& one = all[begin + static_cast<std::size_t>(i)];
        Y.col(i) = one.left.normalized();
        slopes.col(i) = 2.0 * one.s * (M * one.right) + C * one.right;
      }
      Eigen::FullPivLU<ComplexMatrix> gram(Y.adjoint() * slopes);
      gram.setThreshold(1e-6);  // defective: the vectors stay as they are
      if (gram.isInvertible()) {
        const ComplexMatrix combined = Y * gram.inverse().adjoint();
        for (Eigen::Index i = 0; i < count; ++i)
          all[begin + static_cast<std::size_t>(i)].left = combined.col(i);
      }
    }
    begin = end;
  }
}

/// The finite eigenvalues of s^2 M + s C + K, both members of complex pairs, by LAPACK's QZ algorithm on the
/// companion form, or on s C + K if M is zero. Eigenvectors of equal eigenvalues are made biorthogonal, and
/// all are scaled to y^H P'(s) z = 1. Empty if the algorithm does not converge. Cost: about 100 m^3, m = 2n
/// or n.
std::vector<EigenTriple> eigen_triples(const Matrix& M, const Matrix& C, const Matrix& K) {
  const Eigen::Index n = M.rows();
  std::vector<EigenTriple> all;
  if (M.isZero(0.0)) {
    all = generalized(-K, C);
  } else {
    Matrix a = Matrix::Zero(2 * n, 2 * n), b = Matrix::Identity(2 * n, 2 * n);
    a.topRightCorner(n, n).setIdentity();
    a.bottomLeftCorner(n, n) = -K;
    a.bottomRightCorner(n, n) = -C;
    b.bottomRightCorner(n, n) = M;
    const std::vector<EigenTriple> doubled = generalized(std::move(a), std::move(b));
    for (const EigenTriple& one : doubled) {
      const ComplexVector upper = one.right.head(n), lower = one.right.tail(n);
      all.push_back({one.s, upper.norm() >= lower.norm() ? upper : lower, one.left.tail(n)});
    }
  }
  make_biorthogonal(all, M, C);
  for (EigenTriple& one : all) one.right /= one.left.dot(2.0 * one.s * (M * one.right) + C * one.right);
  return all;
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// Places of a gap between samples at which eigenvectors are computed; only the middle where there are more
/// than `most_places` in all.
constexpr std::array<double, 3> places_of_gap{0.1, 0.5, 0.9};
constexpr std::size_t most_places = 300;
/// Places of a step at which distances of eigenvalues are looked at.
constexpr int places_of_step = 8;

/// Distance of s[i] from the nearest other eigenvalue, its own conjugate included if it is complex.
double distance_to_others(const ComplexVector& s, Eigen::Index i) {
  double least = s[i].imag() != 0.0 ? 2.0 * std::abs(s[i].imag()) : INFINITY;
  for (Eigen::Index k = 0; k < s.size(); ++k) {
    if (k == i || !std::isfinite(s[k].real())) continue;
    least = std::min({least, std::abs(s[k] - s[i]), std::abs(std::conj(s[k]) - s[i])});
  }
  return least;
}

/// The errors of the model's data; null if they belong to another parameter than the traced one.
const SampleErrors* errors_along(const Model& model, const TraceOptions& options) {
  const SampleErrors* errors = model.sample_errors();
  const auto traced = model.description().parameters.index(options.parameter);
  return errors != nullptr && traced && errors->parameter() == *traced ? errors : nullptr;
}

/// The errors of all modes at one place.
struct ErrorsAt {
  Vector interpolation, rough, digits;
  Vector growth, rough_growth;  ///< interpolation and rough of Re s
  Vector distance;              ///< of each eigenvalue from the next one
};

class ErrorSampler {
 public:
  ErrorSampler(const Model& model, const TraceOptions& options)
      : model_(model),
        errors_(*model.sample_errors()),
        problem_(problem_along(model, options.parameter)),
        factor_(model.description().parameters.at(options.parameter).factor) {}

  /// Values of the samples in the unit of the parameter.
  std::vector<double> values() const {
    std::vector<double> result = errors_.values();
    for (double& value : result) value /= factor_;
    return result;
  }

  /// The gap between samples that holds p.
  std::size_t gap_of(double p) const {
    const std::vector<double>& all = errors_.values();
    return all.size() < 2 ? 0 : eigentrail::gap_of(all, p * factor_);
  }

  /// Share of the largest smooth error between two samples that is there at p.
  double shape(double p) const { return errors_.shape(p * factor_); }

  /// Bounds for the eigenvalues nearest to those of `s` that are finite; NaN for the others. They hold
  /// wherever the smooth error between the two samples has this share of its largest value.
  ErrorsAt at(double p, const ComplexVector& s, double shape = 1.0) const {
    const Vector none = Vector::Constant(s.size(), nan);
    ErrorsAt result{none, none, none, none, none, none};
    const std::vector<EigenTriple> all = triples_at(p);
    if (all.empty()) return result;
    std::vector<EigenTriple> chosen;
    std::vector<Eigen::Index> modes;
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      if (!std::isfinite(s[i].real()) || !std::isfinite(s[i].imag())) continue;
      const auto distance = [&](const EigenTriple& one) { return std::abs(one.s - s[i]); };
      chosen.push_back(*std::ranges::min_element(all, {}, distance));
      modes.push_back(i);
    }
    const SampleBounds bounds = errors_.between(gap_of(p), chosen);
    result.interpolation(modes) = bounds.interpolation(shape);
    result.rough(modes) = bounds.rough;
    result.digits(modes) = bounds.digits;
    result.growth(modes) = bounds.growth(shape);
    result.rough_growth(modes) = bounds.rough_growth;
    for (const Eigen::Index mode : modes) result.distance[mode] = distance_to_others(s, mode);
    return result;
  }

 private:
  std::vector<EigenTriple> triples_at(double p) const {
    Path path;
    path.parameters = parameters_at(problem_, p);
    path.x = Vector::Zero(model_.n_coordinates());
    path.lambda = Vector::Zero(0);
    Linearization linearization;
    EvaluationCounts counts = model_.new_counts();
    if (model_.linearize(path, 0, linearization, counts)) return {};
    return eigen_triples(linearization.M[0].dense(), linearization.C[0].dense(), linearization.K[0].dense());
  }

  const Model& model_;
  const SampleErrors& errors_;
  PathProblem problem_;
  double factor_;
};

/// The errors at places between each two samples within the range of the path.
std::vector<std::vector<ErrorsAt>> errors_between(const ErrorSampler& sampler, const RecordedPath& path) {
  const std::vector<double> values = sampler.values();
  const double low = path.lowest(), high = path.highest();
  std::vector<std::vector<ErrorsAt>> result(values.size() - 1);
  const bool few = result.size() * places_of_gap.size() <= most_places;
  for (std::size_t gap = 0; gap < result.size(); ++gap) {
    const double from = std::max(values[gap], low);
    const double to = std::min(values[gap + 1], high);
    if (!(to > from)) continue;
    for (std::size_t i = few ? 0 : 1; i < (few ? places_of_gap.size() : 2); ++i) {
      const double p = from + places_of_gap[i] * (to - from);
      const auto positions = path.positions(p);
      if (positions.empty()) continue;
      result[gap].push_back(sampler.at(p, path.eigenvalues_at(positions.front())));
    }
  }
  return result;
}

/// Whether eigenvalues of a mode meet others in a gap, so that the error grows there.
bool meets(const std::vector<Event>& events, int mode, double from, double to) {
  return std::any_of(events.begin(), events.end(), [&](const Event& event) {
    const bool kind = event.kind == EventKind::collision || event.kind == EventKind::veering;
    return kind && event.p >= from && event.p <= to &&
           std::find(event.modes.begin(), event.modes.end(), mode) != event.modes.end();
  });
}

/// The largest error of a mode on a step, from the errors at places of the gap. Near an exceptional point the
/// discriminant D = (distance / 2)^2 has an error that does not vary much, error times distance; the error of
/// the eigenvalue is that over the distance, and the root of it where the distance is less.
double error_on_step(const RecordedPath& path, std::size_t step, Eigen::Index mode, double error,
                     double distance) {
  const double product = error * distance;
  double largest = error;
  for (int k = 0; k <= places_of_step; ++k) {
    const ComplexVector s = path.eigenvalues_at({step, static_cast<double>(k) / places_of_step});
    if (!std::isfinite(s[mode].real())) continue;
    const double here = distance_to_others(s, mode);
    largest =
        std::max(largest, here > 0.0 ? std::min(product / here, std::sqrt(product)) : std::sqrt(product));
  }
  return largest;
}

/// Walks from an event along the path as long as the criterion may vanish.
class IntervalWalk {
 public:
  IntervalWalk(const Model& model, const TraceOptions& options, const RecordedPath& path,
               const DataErrors& errors)
      : options_(options), path_(path), errors_(errors), problem_(problem_along(model, options.parameter)) {}

  EventInterval around(const Event& event) const {
    if (event.modes.empty() || !criterion_of(event)) return {};
    const auto positions = path_.positions(event.p);
    if (positions.empty()) return {};
    const double place = positions.front().in_steps();
    double low = end_of(event, place, -1.0), high = end_of(event, place, 1.0);
    if (low > high) std::swap(low, high);
    return {std::min(low, event.p), std::max(high, event.p)};
  }

 private:
  // Places are counted in steps from the first point.

  bool may_vanish(const Event& event, double place) const {
    const PathPosition at = path_.position_at(place);
    const Eigen::Index mode = event.modes.front();
    const Complex s = path_.eigenvalues_at(at)[mode];
    if (!std::isfinite(s.real())) return false;
    const double p = path_.parameter_at(at);
    const bool of_growth = event.kind == EventKind::flutter || event.kind == EventKind::divergence;
    const double error = of_growth ? errors_.growth_at(at.step, mode, p) : errors_.at(at.step, mode, p);
    // Near its zero no criterion changes by more than s does.
    return std::abs(criterion_value(*criterion_of(event), s, options_.events,
                                    problem_.model.description().parameters, parameters_at(problem_, p))) <=
           error;
  }

  double end_of(const Event& event, double place, double direction) const {
    const auto last = static_cast<double>(path_.steps.size());
    double inside = place, outside = place;
    do {
      inside = outside;
      outside = std::clamp(inside + direction / places_of_step, 0.0, last);
    } while (outside != inside && may_vanish(event, outside));
    constexpr int halvings = 40;
    const Bisected end =
        bisected(inside, outside, halvings, [&](double middle) { return may_vanish(event, middle); });
    return path_.parameter_at(path_.position_at(end.first_without));
  }

  const TraceOptions& options_;
  const RecordedPath& path_;
  const DataErrors& errors_;
  PathProblem problem_;
};

}  // namespace

std::optional<DataErrors> data_errors(const Model& model, const TraceOptions& options,
                                      const RecordedPath& path, const std::vector<Event>& events) {
  const SampleErrors* of_model = errors_along(model, options);
  if (of_model == nullptr || of_model->values().size() < 2 || path.steps.empty()) return std::nullopt;
  const ErrorSampler sampler(model, options);
  const std::vector<double> values = sampler.values();
  const auto samples = errors_between(sampler, path);
  const auto n_steps = static_cast<Eigen::Index>(path.steps.size());
  const Eigen::Index n_modes = path.eigenvalues.cols();
  const Matrix unknown = Matrix::Constant(n_steps, n_modes, nan);
  DataErrors errors{
      unknown, unknown, {}, unknown, unknown, unknown, [sampler](double p) { return sampler.shape(p); }};
  for (Eigen::Index step = 0; step < n_steps; ++step) {
    const auto at = static_cast<std::size_t>(step);
    const auto [low, high] = std::minmax(path.p[at], path.p[at + 1]);
    const std::size_t first = sampler.gap_of(low), last = sampler.gap_of(high);
    const ComplexVector middle = path.eigenvalues_at({at, 0.5});
    for (Eigen::Index mode = 0; mode < n_modes; ++mode) {
      if (!std::isfinite(middle[mode].real())) continue;
      for (std::size_t gap = first; gap <= last; ++gap) {
        if (gap > first && values[gap] >= high) break;
        const bool grows = meets(events, static_cast<int>(mode), values[gap], values[gap + 1]);
        for (const ErrorsAt& place : samples[gap]) {
          const auto raise = [&](double& entry, double error) {
            if (!std::isfinite(error)) return;
            const double here = grows ? error_on_step(path, at, mode, error, place.distance[mode]) : error;
            entry = std::isnan(entry) ? here : std::max(entry, here);
          };
          raise(errors.interpolation(step, mode), place.interpolation[mode]);
          raise(errors.rough(step, mode), place.rough[mode]);
          raise(errors.digits(step, mode), place.digits[mode]);
          // Beside an exceptional point an error of Im s is one of Re s.
          raise(errors.growth(step, mode), (grows ? place.interpolation : place.growth)[mode]);
          raise(errors.rough_growth(step, mode), (grows ? place.rough : place.rough_growth)[mode]);
        }
      }
    }
  }
  const IntervalWalk walk(model, options, path, errors);
  for (const Event& event : events) errors.intervals.push_back(walk.around(event));
  return errors;
}

std::optional<Matrix> data_errors_at(const Model& model, const TraceOptions& options, double p,
                                     const ComplexVector& s) {
  if (errors_along(model, options) == nullptr) return std::nullopt;
  const ErrorSampler sampler(model, options);
  const ErrorsAt errors = sampler.at(p, s, sampler.shape(p));
  Matrix result(s.size(), 2);
  result << errors.interpolation, errors.digits;
  return result;
}

std::optional<Matrix> data_errors_at(const Model& model, const TraceOptions& options,
                                     const OperatingPoint& point) {
  ComplexVector s(static_cast<Eigen::Index>(point.modes.size()));
  for (Eigen::Index i = 0; i < s.size(); ++i) s[i] = point.modes[static_cast<std::size_t>(i)].s;
  return data_errors_at(model, options, point.p, s);
}

}  // namespace eigentrail
