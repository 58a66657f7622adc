// Linearizations of many elements of one structure: from their record, and by nested power series, one call
// of the force for each element and direction.
#include "bench/benchmarks.hpp"
#include "bench/text.hpp"
#include "bench/timing.hpp"
#include "support/sample_element.hpp"

namespace eigentrail {

/// f'
class Derivative final : public SmoothFunction {
 public:
  explicit Derivative(const SmoothFunction& f) : f_(f) {}
  void taylor(double x, std::span<double> coefficients) const override { differentiate(x, coefficients); }
  void taylor(const Extended& x, std::span<Extended> coefficients) const override {
    differentiate(x, coefficients);
  }

 private:
  template <class Real>
  void differentiate(const Real& x, std::span<Real> coefficients) const {
    std::vector<Real> all(coefficients.size() + 1);
    f_.taylor(x, std::span<Real>(all));
    for (std::size_t k = 0; k < coefficients.size(); ++k)
      coefficients[k] = Real(static_cast<double>(k + 1)) * all[k + 1];
  }

  const SmoothFunction& f_;
};

/// f(x) for a series with a derivative.
template <class T, int Q>
Series<Series<T, Q>, 1> apply(const SmoothFunction& f, const Series<Series<T, Q>, 1>& x) {
  Series<Series<T, Q>, 1> value(apply(f, x[0]));
  value[1] = apply(Derivative(f), x[0]) * x[1];
  return value;
}

}  // namespace eigentrail

namespace eigentrail::test {
namespace {

constexpr int order = 3;
constexpr std::size_t count = 40;

/// Calls the force once for each component, with its derivative; the sum keeps the compiler from leaving it
/// out.
template <class Element>
double linearize_by_nested_series(const Sample<Element>& sample, const PathValues<double>& values) {
  using Base = Series<double, order>;
  using Nested = Series<Base, 1>;
  const auto series = [&](const Matrix& columns, int index) {
    Base result;
    for (int k = 0; k <= order; ++k) result[k] = columns(k, index);
    return result;
  };
  std::vector<Vec3<Base>> positions;
  for (const Place& place : sample.placed.arguments) {
    Vec3<Base> sum = Vec3<Base>::Zero();
    for (const Term& term : place.terms) {
      const Base weight = term.weight.slot < 0 ? Base(1.0) : series(values.numbers, term.weight.slot);
      for (int i = 0; i < 3; ++i) sum[i] += weight * series(values.coordinates, 3 * term.triple + i);
    }
    positions.push_back(sum);
  }
  const auto n_vectors = static_cast<int>(positions.size());
  double sum = 0.0;
  const RecordedEquations equations = sample.record();
  for (int motion = 0; motion < 3; ++motion) {
    constexpr std::array targets = {eigentrail::Target::stiffness, eigentrail::Target::damping,
                                    eigentrail::Target::mass};
    const std::vector<Entry>& entries = equations.batches.front().derivatives.entries;
    const bool depends = std::any_of(entries.begin(), entries.end(), [&](const Entry& entry) {
      return entry.target == targets[static_cast<std::size_t>(motion)];
    });
    if (!depends) continue;
    for (int component = 0; component < 3 * n_vectors; ++component) {
      std::vector<MovingVector<Nested>> vectors;
      for (int i = 0; i < n_vectors; ++i) {
        const Vec3<Nested> zero = Vec3<Nested>::Zero();
        MovingVector<Nested>& v =
            vectors.emplace_back(positions[static_cast<std::size_t>(i)].template cast<Nested>(), zero, zero);
        if (component / 3 != i) continue;
        Vec3<Nested>& moved = motion == 0 ? v.position : motion == 1 ? v.velocity : v.acceleration;
        moved[component % 3][1] = Base(1.0);
      }
      const std::vector<MovingState<Nested>> states(static_cast<std::size_t>(Sample<Element>::n_states));
      ElementView<Nested> view([&](int slot) { return Nested(series(values.numbers, slot)); },
                               std::move(vectors), states);
      sample.placed.element.force(view);
      for (const MovingVector<Nested>& v : view.vectors()) sum += v.force[0][1][0];
    }
  }
  return sum;
}

template <class Element>
Figure compare(const BenchOptions& options) {
  const Sample<Element> sample;
  eigentrail::Elements elements;
  std::get<std::vector<Placed<Element>>>(elements.lists).assign(count, sample.placed);
  const RecordedEquations equations = record_equations(sample.data, elements, {});
  const PathValues<double> values = sample.path_values(order);
  EquationWork<double> work;
  Linearization linearization;
  const int times = options.smoke ? 1 : 20;
  Rounds rounds;
  double sum = 0.0;
  for (int i = 0; i < options.repeats; ++i) {
    rounds.add({seconds_of([&] {
                  for (int k = 0; k < times; ++k)
                    evaluate_linearization(equations, values, work, linearization);
                }),
                seconds_of([&] {
                  for (int k = 0; k < times; ++k) {
                    for (std::size_t e = 0; e < count; ++e) sum += linearize_by_nested_series(sample, values);
                  }
                })});
  }
  const Batch& batch = equations.batches.front();
  return {"time of nested series / of the record, " + std::string(Element::name), rounds.ratio(1, 0),
          at_least(1.0),
          std::to_string(batch.derivatives.instructions.size()) + " operations, " +
              std::to_string(batch.derivatives.n_directions) + " directions, " +
              short_text(1e6 * rounds.seconds(0) / (times * static_cast<double>(count))) +
              " us for an element, order " + std::to_string(order) +
              (std::isfinite(sum) ? "" : ", not finite")};
}

}  // namespace

Figures physics(const BenchOptions& options) {
  return {compare<Spring>(options), compare<BeamSection>(options), compare<Strip>(options)};
}

}  // namespace eigentrail::test
