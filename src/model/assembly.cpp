#include "model/assembly.hpp"

#include <cmath>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/evaluate_equations.hpp"
#include "model/record/recorder.hpp"

namespace eigentrail {

/// Memory of one evaluation.
template <class Real>
struct AssemblyWork {
  PathValues<Real> values;
  EquationWork<Real> equations;
  BasicSteadyResidual<Real> part;  ///< of the load of a trim
};

template <class Real>
struct Assembly::Pool {
  std::vector<Real> constants;  ///< quantities that are the same everywhere, by slot; the others are zero
  std::mutex mutex;
  std::vector<std::unique_ptr<AssemblyWork<Real>>> idle;
};

/// Memory that is given back at the end.
template <class Real>
class Assembly::Lease {
 public:
  explicit Lease(Pool<Real>& pool) : pool_(pool) {
    const std::lock_guard lock(pool.mutex);
    if (pool.idle.empty()) {
      work_ = std::make_unique<AssemblyWork<Real>>();
    } else {
      work_ = std::move(pool.idle.back());
      pool.idle.pop_back();
    }
  }
  ~Lease() {
    const std::lock_guard lock(pool_.mutex);
    pool_.idle.push_back(std::move(work_));
  }
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;

  AssemblyWork<Real>& operator*() { return *work_; }

 private:
  Pool<Real>& pool_;
  std::unique_ptr<AssemblyWork<Real>> work_;
};

namespace {

/// The virtual motion of a load at a point of the path.
template <class Base>
class MovedTriples {
 public:
  using Values = PathValues<typename Base::Coefficient>;

  MovedTriples(const VirtualMotion& motion, const Values& values) : axis_(values.vector(motion.axis)) {
    const bool turns = motion.about.has_value();
    const Vec3<Base> centre = turns ? values.vector(*motion.about) : Vec3<Base>(Vec3<Base>::Zero());
    const auto add = [&](int triple, const Vec3<Base>& arm) {
      moved_.push_back({triple, arm, turns ? Vec3<Base>(axis_.cross(arm)) : axis_});
    };
    for (const int triple : motion.places) add(triple, values.triple(triple) - centre);
    if (!turns) return;
    for (const int triple : motion.directions) add(triple, values.triple(triple));
  }

  /// Calls visit(triple, w).
  void for_each(auto visit) const {
    for (const Moved& moved : moved_) visit(moved.triple, moved.w);
  }

  /// Adds the derivative of the work of constant forces on w: that of e by the arm, and that of the arm.
  void add_gradient(const VirtualMotion& motion, const Values& values, const Vector& force,
                    Vector& of_x) const {
    const auto add = [&of_x, &values](const Term& term, const Eigen::Vector3d& gradient) {
      const double weight = term.weight.slot < 0 ? 1.0 : values.number(term.weight.slot)[0];
      of_x.segment<3>(3 * term.triple) += weight * gradient;
    };
    const auto number = [](const Vec3<Base>& v) { return Eigen::Vector3d(v[0][0], v[1][0], v[2][0]); };
    const Eigen::Vector3d axis = number(axis_);
    for (std::size_t j = 0; j < moved_.size(); ++j) {
      const Moved& moved = moved_[j];
      const Eigen::Vector3d f = force.segment<3>(3 * moved.triple);
      const Eigen::Vector3d of_axis = motion.about ? Eigen::Vector3d(number(moved.arm).cross(f)) : f;
      for (const Term& term : motion.axis.terms) add(term, of_axis);
      if (!motion.about) continue;
      const Eigen::Vector3d of_arm = f.cross(axis);
      add({moved.triple, {}}, of_arm);
      if (j >= motion.places.size()) continue;
      for (const Term& term : motion.about->terms) add(term, -of_arm);
    }
  }

 private:
  struct Moved {
    int triple;
    Vec3<Base> arm, w;
  };
  Vec3<Base> axis_;
  std::vector<Moved> moved_;  ///< those of places come first
};

RecordedEquations record_condition(const MultibodyData& data, const TrimCondition& trim) {
  if (const auto* row = std::get_if<ConstraintRow>(&trim.quantity)) return record_equation(data, *row);
  const TrimLoad& load = std::get<TrimLoad>(trim.quantity);
  return record_equations(data, load.elements, load.constraints);
}

template <class Real>
std::vector<Real> constants_of(const std::vector<Expression>& quantities) {
  std::vector<Real> constants;
  for (const Expression& quantity : quantities)
    constants.push_back(quantity.is_constant() ? quantity.evaluate(std::span<const Series<Real, 0>>())[0]
                                               : Real(0.0));
  return constants;
}

void add_counts(std::vector<std::uint64_t>& sum, const std::vector<std::uint64_t>& counts) {
  for (std::size_t i = 0; i < counts.size(); ++i) sum[i] += counts[i];
}

/// A residual of zero for equations, and `more` conditions.
template <class Real>
void reset(BasicSteadyResidual<Real>& result, const RecordedEquations& equations, int order,
           std::size_t more) {
  result.force.setZero(equations.n, order + 1);
  result.constraint.setZero(equations.m + static_cast<Eigen::Index>(more), order + 1);
}

}  // namespace

Assembly::Assembly(MultibodyData data)
    : data_(std::move(data)),
      equations_(record_equations(data_, data_.elements, data_.constraints)),
      pools_(std::make_unique<Pool<double>>(), std::make_unique<Pool<Extended>>()) {
  for (const TrimCondition& trim : data_.trims) conditions_.push_back(record_condition(data_, trim));
  pool<double>().constants = constants_of<double>(data_.quantities);
  pool<Extended>().constants = constants_of<Extended>(data_.quantities);
  Recorder recorder;
  const auto number = [&recorder](double value) { return recorder.constant(value); };
  std::vector<Recorded> parameters;
  for (std::size_t i = 0; i < data_.parameters.size(); ++i)
    parameters.push_back(recorder.number(static_cast<int>(i)));
  data_.parameters.to_si(std::span<Recorded>(parameters), number);
  for (std::size_t i = 0; i < data_.quantities.size(); ++i) {
    if (data_.quantities[i].is_constant()) continue;
    const Recorded value = data_.quantities[i].evaluate(std::span<const Recorded>(parameters), number);
    recorder.record().values.push_back(recorder.node(value));
    varying_.push_back(static_cast<int>(i));
  }
  quantity_values_ = value_program(recorder.record());
}

Assembly::~Assembly() = default;
Assembly::Assembly(Assembly&&) noexcept = default;
Assembly& Assembly::operator=(Assembly&&) noexcept = default;

template <class Real>
void Assembly::set_path(AssemblyWork<Real>& work, const BasicPath<Real>& path, int order) const {
  if (order < 0 || order > max_order)
    throw std::invalid_argument("order of a series: expected 0 to " + std::to_string(max_order) + ", got " +
                                std::to_string(order));
  PathValues<Real>& values = work.values;
  values.order = order;
  const auto set = [order](auto& columns, std::vector<char>& varies, Eigen::Index column,
                           auto coefficient_of) {
    bool any = false;
    for (int k = 0; k <= order; ++k) {
      columns(k, column) = coefficient_of(k);
      any = any || (k > 0 && columns(k, column) != Real(0.0));
    }
    varies[static_cast<std::size_t>(column)] = any;
  };
  values.coordinates.resize(order + 1, data_.n_coordinates);
  values.coordinate_varies.resize(static_cast<std::size_t>(data_.n_coordinates));
  for (Eigen::Index i = 0; i < data_.n_coordinates; ++i)
    set(values.coordinates, values.coordinate_varies, i, [&](int k) { return coefficient(path.x, i, k); });

  const std::vector<Real>& constants = pool<Real>().constants;
  const auto n_quantities = static_cast<Eigen::Index>(constants.size());
  values.numbers.setZero(order + 1, n_quantities + data_.n_constraints);
  values.number_varies.assign(static_cast<std::size_t>(values.numbers.cols()), false);
  for (Eigen::Index i = 0; i < n_quantities; ++i)
    values.numbers(0, i) = constants[static_cast<std::size_t>(i)];
  for (Eigen::Index i = 0; i < data_.n_constraints; ++i)
    set(values.numbers, values.number_varies, n_quantities + i,
        [&](int k) { return coefficient(path.lambda, i, k); });

  Evaluation<Real, 1>& evaluation = work.equations.single;
  evaluation.begin(quantity_values_, order);
  for (const LocalValue& input : quantity_values_.numbers) {
    const auto* source = &path.parameters;
    Eigen::Index row = input.index;
    for (std::size_t i = 0; i < data_.trims.size(); ++i) {
      if (data_.trims[i].parameter != input.index) continue;
      source = &path.lambda;
      row = data_.n_constraints + static_cast<Eigen::Index>(i);
    }
    bool any = false;
    for (int k = 0; k <= order; ++k) {
      const Real value = coefficient(*source, row, k);
      evaluation.series(input.slot)[k][0] = value;
      any = any || (k > 0 && value != Real(0.0));
    }
    evaluation.set_varies(input.slot, any);
  }
  evaluation.run(quantity_values_, {});
  for (const LocalValue& value : quantity_values_.values) {
    const bool varies = evaluation.varies(value.slot);
    set(values.numbers, values.number_varies, varying_[static_cast<std::size_t>(value.index)],
        [&](int k) { return k == 0 || varies ? evaluation.series(value.slot)[k][0] : Real(0.0); });
  }
}

template <class Real>
EvaluationFault Assembly::residual(const BasicPath<Real>& path, int order, BasicSteadyResidual<Real>& result,
                                   EvaluationCounts& counts) const {
  Lease<Real> lease(pool<Real>());
  AssemblyWork<Real>& work = *lease;
  set_path(work, path, order);
  reset(result, equations_, order, data_.trims.size());
  add_counts(counts.residual, equations_.counts);
  EvaluationFault fault = evaluate_residual(equations_, work.values, work.equations, result);
  for (std::size_t i = 0; i < data_.trims.size(); ++i) {
    Series<Real, max_order> value;
    if (auto of_trim = condition(i, work, value, counts); of_trim && !fault) fault = of_trim;
    for (int k = 0; k <= order; ++k)
      result.constraint(data_.n_constraints + static_cast<Eigen::Index>(i), k) = value[k];
  }
  return fault;
}

template <class Real>
EvaluationFault Assembly::linearize(const BasicPath<Real>& path, int order, BasicLinearization<Real>& result,
                                    EvaluationCounts& counts) const {
  Lease<Real> lease(pool<Real>());
  AssemblyWork<Real>& work = *lease;
  set_path(work, path, order);
  add_counts(counts.linearization, equations_.counts);
  return evaluate_linearization(equations_, work.values, work.equations, result);
}

/// Quantity minus target.
template <class Real>
EvaluationFault Assembly::condition(std::size_t trim, AssemblyWork<Real>& work,
                                    Series<Real, max_order>& value, EvaluationCounts& counts) const {
  using LongSeries = Series<Real, max_order>;
  const int order = work.values.order;
  const TrimCondition& own = data_.trims[trim];
  const RecordedEquations& equations = conditions_[trim];
  reset(work.part, equations, order, 0);
  EvaluationFault fault = evaluate_residual(equations, work.values, work.equations, work.part);
  value = LongSeries();
  if (const auto* load = std::get_if<TrimLoad>(&own.quantity)) {
    add_counts(counts.residual, equations.counts);
    const auto force = [&](int coordinate) {
      LongSeries series;
      for (int k = 0; k <= order; ++k) series[k] = work.part.force(coordinate, k);
      return series;
    };
    const MovedTriples<LongSeries> moved(load->motion, work.values);
    moved.for_each([&](int triple, const Vec3<LongSeries>& w) {
      value -= w.dot(Vec3<LongSeries>(force(3 * triple), force(3 * triple + 1), force(3 * triple + 2)));
    });
    value *= load->motion.factor;
    value -= work.values.number(own.target.slot);
  } else {
    for (int k = 0; k <= order; ++k) value[k] = work.part.constraint(0, k);
  }
  using std::isfinite;
  for (int k = 0; k <= order; ++k) {
    if (!isfinite(value[k]) && fault.source.empty()) fault.source = "the trim condition " + own.text;
  }
  return fault;
}

EvaluationFault Assembly::trim_rows(const Path& at, TrimDerivatives& result, EvaluationCounts& counts) const {
  Lease<double> lease(pool<double>());
  AssemblyWork<double>& work = *lease;
  set_path(work, at, 0);
  result.x.setZero(static_cast<Eigen::Index>(data_.trims.size()), data_.n_coordinates);
  result.lambda.setZero(result.x.rows(), data_.n_constraints);
  for (std::size_t i = 0; i < data_.trims.size(); ++i) {
    Vector of_x = Vector::Zero(data_.n_coordinates);
    if (std::holds_alternative<TrimLoad>(data_.trims[i].quantity)) {
      if (auto fault = load_row(i, work, of_x, result, counts)) return fault;
    } else {
      Linearization gradient;
      if (auto fault = evaluate_linearization(conditions_[i], work.values, work.equations, gradient))
        return fault;
      of_x = gradient.A[0].transposed_times(Vector::Ones(1));
    }
    result.x.row(static_cast<Eigen::Index>(i)) = of_x.transpose();
  }
  return {};
}

EvaluationFault Assembly::load_row(std::size_t trim, AssemblyWork<double>& work, Vector& of_x,
                                   TrimDerivatives& result, EvaluationCounts& counts) const {
  const VirtualMotion& motion = std::get<TrimLoad>(data_.trims[trim].quantity).motion;
  const RecordedEquations& equations = conditions_[trim];
  reset(work.part, equations, 0, 0);
  add_counts(counts.residual, equations.counts);
  add_counts(counts.linearization, equations.counts);
  Linearization of_load;
  if (auto fault = evaluate_residual(equations, work.values, work.equations, work.part)) return fault;
  if (auto fault = evaluate_linearization(equations, work.values, work.equations, of_load)) return fault;
  const MovedTriples<Series<double, max_order>> moved(motion, work.values);
  Vector w = Vector::Zero(data_.n_coordinates);
  moved.for_each([&](int triple, const Vec3<Series<double, max_order>>& direction) {
    for (int axis = 0; axis < 3; ++axis) w[3 * triple + axis] += direction[axis][0];
  });
  of_x = -of_load.K[0].transposed_times(w);
  moved.add_gradient(motion, work.values, -work.part.force.col(0), of_x);
  of_x *= motion.factor;
  result.lambda.row(static_cast<Eigen::Index>(trim)) = -motion.factor * (of_load.A[0] * w).transpose();
  return {};
}

template EvaluationFault Assembly::residual(const Path&, int, SteadyResidual&, EvaluationCounts&) const;
template EvaluationFault Assembly::residual(const BasicPath<Extended>&, int, BasicSteadyResidual<Extended>&,
                                            EvaluationCounts&) const;
template EvaluationFault Assembly::linearize(const Path&, int, Linearization&, EvaluationCounts&) const;
template EvaluationFault Assembly::linearize(const BasicPath<Extended>&, int, BasicLinearization<Extended>&,
                                             EvaluationCounts&) const;

}  // namespace eigentrail
