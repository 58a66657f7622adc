#include "eigentrail/steady/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>
#include <utility>

#include "core/positive_or_one.hpp"
#include "core/texts.hpp"
#include "eigentrail/steady/relaxation.hpp"
#include "steady/load_steps.hpp"
#include "steady/redundancy.hpp"
#include "steady/rounding.hpp"

namespace eigentrail {
namespace {

/// Residuals below this fraction of their scale are at the rounding level.
constexpr double rounded = 1e-13;
constexpr int max_corrections = 6;
/// Iterations after which another method tries from the guess. Where KINSOL's line search works it takes
/// fewer.
constexpr int first_iterations = 25;
/// From this number of coordinates on KINSOL comes last: the longer a chain of stiff elements, the shorter
/// the steps of its line search.
constexpr Eigen::Index many_coordinates = 1000;
/// Newton's method from the point before ends with a correction shorter than this, or after so many.
constexpr double whole_steps_tolerance = 1e-8;
constexpr int most_whole_steps = 200;
/// Corrections with the factors at the guess go on while each is below this share of the one before. With a
/// larger share they would take longer than new factors.
constexpr double fast_contraction = 0.1;
constexpr int most_chords = 12;
/// Relaxation works with dense matrices of the size of all freedoms.
constexpr Eigen::Index largest_relaxed = 5000;

/// Typical magnitudes at the guess. All coordinates of a model have the same unit, so one scale serves them.
struct Scales {
  double length = 1.0;
  double force = 1.0;
  Vector constraint;  ///< per row: |A row| * length
  Vector multiplier;
  Eigen::Index n_constraints = 0;

  /// Change of the forces by that of the multipliers.
  Vector reaction(const Linearization& at, const TrimDerivatives& trim, const Vector& dl) const {
    Vector result = at.A[0].transposed_times(dl.head(n_constraints));
    if (trim.force.cols() > 0) result += trim.force * dl.tail(trim.force.cols());
    return result;
  }
};

/// The scale of a condition is what the trimmed parameters contribute at their own scale, or its residual.
Scales find_scales(const Vector& x, const Vector& lambda, const Linearization& lin,
                   const SteadyResidual& residual, const TrimDerivatives& trim) {
  Scales scales;
  const Vector rows = lin.A[0].row_norms();
  scales.n_constraints = rows.size();
  const Eigen::Index k = lambda.size() - rows.size();
  const Vector unknown = lambda.tail(k).cwiseAbs().unaryExpr(&positive_or_one);
  scales.length = positive_or_one(x.lpNorm<Eigen::Infinity>());
  const Vector reaction = lin.A[0].transposed_times(lambda.head(rows.size()));
  scales.force =
      positive_or_one(std::max({lin.K[0].largest_entry() * scales.length, reaction.lpNorm<Eigen::Infinity>(),
                                residual.force.col(0).lpNorm<Eigen::Infinity>()}));
  scales.constraint.resize(lambda.size());
  scales.constraint.head(rows.size()) = (rows * scales.length).unaryExpr(&positive_or_one);
  const double multiplier =
      positive_or_one(rows.size() == 0 ? 1.0 : scales.force / positive_or_one(rows.maxCoeff()));
  scales.multiplier = Vector::Constant(lambda.size(), multiplier);
  scales.multiplier.tail(k) = unknown;
  if (k == 0) return scales;
  const Vector largest = (trim.x.cwiseAbs().rowwise().maxCoeff() * scales.length)
                             .cwiseMax(trim.trim.cwiseAbs() * unknown)
                             .cwiseMax(residual.constraint.col(0).tail(k).cwiseAbs());
  scales.constraint.tail(k) = largest.unaryExpr(&positive_or_one);
  return scales;
}

/// The model at fixed parameters, as a nonlinear problem in (x, lambda).
class SteadyProblem {
 public:
  SteadyProblem(const Model& model, const Vector& parameters, EvaluationCounts& counts, SteadyReport& report)
      : model_(model), counts_(counts), report_(report) {
    path_.parameters = parameters;
  }

  /// Residual at (x, lambda). Returns the element whose contribution is not finite, if any.
  EvaluationFault evaluate(const Vector& x, const Vector& lambda, SteadyResidual& residual) {
    ++report_.residual_evaluations;
    path_.x = x;
    path_.lambda = lambda;
    return noted(model_.residual(path_, 0, residual, counts_));
  }

  EvaluationFault linearize(const Vector& x, const Vector& lambda, Linearization& linearization) {
    path_.x = x;
    path_.lambda = lambda;
    return noted(model_.linearize(path_, 0, linearization, counts_));
  }

  /// Sets the point at which `trim` is evaluated.
  void at(const Equilibrium& equilibrium) {
    path_.x = equilibrium.x;
    path_.lambda = equilibrium.lambda;
  }

  Vector first_multipliers() const { return model_.first_multipliers(path_.parameters.col(0)); }
  Eigen::Index n_constraints() const { return model_.n_constraints(); }

  /// The last fault that has a reason of its own: why an iteration could not go on.
  const EvaluationFault& reason() const { return reason_; }

  /// Residual and linearization at (at.x, at.lambda).
  EvaluationFault evaluate(Equilibrium& at, SteadyResidual& residual) {
    const EvaluationFault fault = evaluate(at.x, at.lambda, residual);
    return fault ? fault : linearize(at.x, at.lambda, at.linearization);
  }

  /// The derivatives of the trimmed parameters at the point of the last call of `linearize`; no columns
  /// without any.
  EvaluationFault trim(TrimDerivatives& derivatives) {
    if (model_.n_trims() == 0) return {};
    return noted(model_.trim_derivatives(path_, derivatives, counts_));
  }

  KktFactorization factor(const Linearization& linearization, const TrimDerivatives& trim) {
    ++report_.factorizations;
    return {linearization.K[0], linearization.A[0], trim};
  }

 private:
  EvaluationFault noted(EvaluationFault fault) {
    if (!fault.reason.empty()) reason_ = fault;
    return fault;
  }

  const Model& model_;
  EvaluationCounts& counts_;
  SteadyReport& report_;
  EvaluationFault reason_;
  Path path_;
};

/// Writes the largest scaled residual and its equation into the report.
void report_residual(const Model& model, const SteadyResidual& residual, const Scales& scales,
                     SteadyReport& report) {
  Eigen::Index row = 0;
  report.residual = residual.force.col(0).cwiseAbs().maxCoeff(&row) / scales.force;
  report.worst_equation =
      "balance of forces at " + model.description().coordinate_names[static_cast<std::size_t>(row)];
  if (residual.constraint.rows() == 0) return;
  const double worst = residual.constraint.col(0).cwiseAbs().cwiseQuotient(scales.constraint).maxCoeff(&row);
  if (worst > report.residual) {
    report.residual = worst;
    const Eigen::Index trim = row - model.n_constraints();
    report.worst_equation =
        trim < 0
            ? "constraint " + model.description().constraint_names[static_cast<std::size_t>(row)]
            : "trim condition '" + model.description().trims[static_cast<std::size_t>(trim)].condition + "'";
  }
}

/// At a first guess KINSOL; where that takes long, the load is added in steps from the same guess, because
/// damped steps from a far guess become shorter and shorter; in large models this comes first. On the path
/// (no `options.relax`) only a solution beside the guess will do.
NonlinearResult solve_by_turns(const NonlinearProblem& problem, Eigen::Index n, const SteadyOptions& options,
                               Vector& u) {
  const bool large = n >= many_coordinates;
  const int first = std::min(first_iterations, options.max_iterations);
  const auto by_kinsol = [&](int iterations, Vector& v) {
    return solve_with_kinsol(problem, options.tolerance, iterations, v);
  };
  if (!options.relax)
    return large ? solve_by_whole_steps(problem, n, whole_steps_tolerance, most_whole_steps, u)
                 : by_kinsol(first, u);
  NonlinearResult result;
  const auto turn = [&](const auto& solve) {
    if (result.converged) return;
    Vector from_the_guess = u;
    const int before = result.iterations;
    result = solve(from_the_guess);
    result.iterations += before;
    if (result.converged) u = std::move(from_the_guess);
  };
  if (!large) turn([&](Vector& v) { return by_kinsol(first, v); });
  turn([&](Vector& v) { return solve_in_load_steps(problem, n, v); });
  if (options.max_iterations > first) turn([&](Vector& v) { return by_kinsol(options.max_iterations, v); });
  return result;
}

/// Size of a correction relative to the scales. Changes of the multipliers are measured by the reaction A^T
/// lambda, because dependent constraints leave lambda itself undetermined.
double size_of(const Vector& dx, const Vector& dl, const Scales& scales, const Linearization& at,
               const TrimDerivatives& trim) {
  const Vector reaction = scales.reaction(at, trim, dl);
  return std::max(dx.lpNorm<Eigen::Infinity>() / scales.length,
                  reaction.lpNorm<Eigen::Infinity>() / scales.force);
}

/// The chord method from a guess beside the solution, as the series of the last point give it: one
/// factorization, and a residual and a solution per correction. Returns false, and leaves (x, lambda) as they
/// are, where corrections do not decrease fast.
bool follow_chords(SteadyProblem& problem, const Scales& scales, const Linearization& linearization,
                   const TrimDerivatives& trim, SteadyResidual residual, Vector& x, Vector& lambda) {
  const KktFactorization kkt = problem.factor(linearization, trim);
  Vector at = x, multipliers = lambda, dx, dl;
  double last = INFINITY;
  for (int i = 0; i < most_chords; ++i) {
    kkt.solve(-residual.force.col(0), -residual.constraint.col(0), dx, dl);
    const double size = size_of(dx, dl, scales, linearization, trim);
    const bool at_rounding = size < newton_rounding_floor;
    if (!std::isfinite(size) || (!at_rounding && size > fast_contraction * last)) return false;
    at += dx;
    multipliers += dl;
    // The next correction is smaller by the same factor.
    const double next = std::isfinite(last) ? size * size / last : size;
    if (next <= newton_rounding || (at_rounding && size > fast_contraction * last)) break;
    if (problem.evaluate(at, multipliers, residual)) return false;
    last = size;
  }
  x = std::move(at);
  lambda = std::move(multipliers);
  return true;
}

/// Solves from (x, lambda).
NonlinearResult iterate(SteadyProblem& problem, const Scales& scales, const SteadyOptions& options, Vector& x,
                        Vector& lambda) {
  const Eigen::Index n = x.size();
  const Eigen::Index m = lambda.size();
  KktFactorization kkt;
  SteadyResidual residual;
  Linearization linearization;
  TrimDerivatives trim;
  NonlinearProblem nonlinear;
  nonlinear.residual = [&](const Vector& u, Vector& f) {
    if (problem.evaluate(u.head(n), u.tail(m), residual)) return false;
    f.resize(n + m);
    f << residual.force.col(0), residual.constraint.col(0);
    return true;
  };
  nonlinear.factor = [&](const Vector& u) {
    if (problem.linearize(u.head(n), u.tail(m), linearization) || problem.trim(trim)) return false;
    kkt = problem.factor(linearization, trim);
    return true;
  };
  nonlinear.solve = [&](const Vector& b, Vector& du) {
    Vector dx, dl;
    kkt.solve(b.head(n), b.tail(m), dx, dl);
    du.resize(n + m);
    du << dx, dl;
  };
  nonlinear.u_scale.resize(n + m);
  nonlinear.u_scale << Vector::Constant(n, 1.0 / scales.length), scales.multiplier.cwiseInverse();
  nonlinear.f_scale.resize(n + m);
  nonlinear.f_scale << Vector::Constant(n, 1.0 / scales.force), scales.constraint.cwiseInverse();

  Vector u(n + m);
  u << x, lambda;
  NonlinearResult result = solve_by_turns(nonlinear, n, options, u);
  x = u.head(n);
  lambda = u.tail(m);
  return result;
}

/// Newton corrections down to the rounding level. Leaves the linearization and factorization at the iterate
/// before the last correction.
bool polish(SteadyProblem& problem, const Scales& scales, Equilibrium& result) {
  // With nearly parallel constraints, rounding of the constraints moves positions by more than rounding of
  // the positions themselves does.
  const auto floor = [&](const SteadyResidual& residual) {
    const bool solved =
        residual.force.col(0).lpNorm<Eigen::Infinity>() <= rounded * scales.force &&
        (residual.constraint.col(0).cwiseAbs().array() <= rounded * scales.constraint.array()).all();
    const double moves = newton_rounding / result.kkt.constraints().independence();
    return solved ? std::max(newton_rounding_floor, moves) : newton_rounding_floor;
  };
  double last = INFINITY;
  SteadyResidual residual;
  TrimDerivatives trim;
  for (int i = 0; i < max_corrections; ++i) {
    if (problem.evaluate(result.x, result.lambda, residual)) return false;
    if (problem.linearize(result.x, result.lambda, result.linearization) || problem.trim(trim)) return false;
    result.kkt = problem.factor(result.linearization, trim);
    Vector dx, dl;
    result.kkt.solve(-residual.force.col(0), -residual.constraint.col(0), dx, dl);
    const double size = size_of(dx, dl, scales, result.linearization, trim);
    if (!std::isfinite(size)) return false;
    result.x += dx;
    result.lambda += dl;
    if (size <= newton_rounding) return true;
    if (size > 0.5 * last) return size < floor(residual);
    last = size;
  }
  return last < floor(residual);
}

std::string failure_message(const NonlinearResult& kinsol, const SteadyReport& report) {
  std::ostringstream message;
  message << "no equilibrium found: largest residual " << report.residual << " of its scale, in the "
          << report.worst_equation
          << "; check what acts there, or begin closer to the equilibrium (KINSOL stopped after "
          << kinsol.iterations
          << " iterations: " << (kinsol.converged ? "its last iterate is not isolated" : kinsol.message)
          << ")";
  return message.str();
}

/// Why the conditions of a trim do not determine its unknowns; empty if they do.
std::string undetermined_trim(const Model& model, const KktFactorization& kkt) {
  constexpr double takes_part = 1e-6;
  const Matrix shares = kkt.undetermined();
  std::vector<std::string> unknowns, conditions;
  for (Eigen::Index i = 0; i < shares.cols(); ++i) {
    const Trim& trim = model.description().trims[static_cast<std::size_t>(i)];
    const auto& names = model.description().parameters.names();
    if (shares(0, i) > takes_part)
      unknowns.push_back("'" + names[static_cast<std::size_t>(trim.parameter)] + "'");
    if (shares(1, i) > takes_part) conditions.push_back("'" + trim.condition + "'");
  }
  if (unknowns.empty() && conditions.empty()) return {};
  return "the trim is singular: " +
         (conditions.empty() ? "the equilibrium" : "the condition " + joined(conditions)) +
         " does not change with " + (unknowns.empty() ? "the unknowns" : "the unknown " + joined(unknowns)) +
         "; state conditions that depend on the unknowns, and hold all other freedoms";
}

/// The same at a guess (x, lambda) from which no solution was found.
std::string undetermined_trim(const Model& model, SteadyProblem& problem,
                              const std::pair<Vector, Vector>& at) {
  Equilibrium guess;
  std::tie(guess.x, guess.lambda) = at;
  SteadyResidual residual;
  TrimDerivatives trim;
  if (model.n_trims() == 0 || problem.evaluate(guess, residual) || problem.trim(trim)) return {};
  return undetermined_trim(model, problem.factor(guess.linearization, trim));
}

Equilibrium not_finite(Equilibrium result, const EvaluationFault& fault) {
  result.status = SteadyStatus::not_finite;
  result.report.message = fault.message();
  return result;
}

/// Factors the constraints at at.x and sets the multipliers there to those of least squares (Eq. 15).
EvaluationFault settle_multipliers(SteadyProblem& problem, Equilibrium& at) {
  SteadyResidual residual;
  at.lambda = problem.first_multipliers();
  if (auto fault = problem.evaluate(at, residual)) return fault;
  at.kkt = KktFactorization(at.linearization.A[0]);
  at.lambda.head(problem.n_constraints()) =
      at.kkt.constraints().transposed_pseudo_inverse_times(-residual.force.col(0));
  return {};
}

Equilibrium solve_from(const Model& model, const Vector& parameters, const Vector& x, const Vector& lambda,
                       const SteadyOptions& options, EvaluationCounts& counts) {
  Equilibrium result;
  result.x = x;
  result.lambda = lambda;
  SteadyProblem problem(model, parameters, counts, result.report);
  SteadyResidual residual;
  if (lambda.size() != model.n_multipliers()) {
    if (const auto fault = settle_multipliers(problem, result)) return not_finite(std::move(result), fault);
  }
  TrimDerivatives trim;
  if (const auto fault = problem.evaluate(result, residual)) return not_finite(std::move(result), fault);
  if (const auto fault = problem.trim(trim)) return not_finite(std::move(result), fault);
  const Scales scales = find_scales(result.x, result.lambda, result.linearization, residual, trim);
  const auto first = std::pair(result.x, result.lambda);
  // Beside the solution of a large model; a small one takes no time, and its results do not change in the
  // last bit.
  const bool is_beside = !options.relax && result.linearization.K[0].is_sparse();
  NonlinearResult kinsol;
  if (!is_beside ||
      !follow_chords(problem, scales, result.linearization, trim, residual, result.x, result.lambda))
    kinsol = iterate(problem, scales, options, result.x, result.lambda);
  result.report.iterations = kinsol.iterations;
  const auto last = std::pair(result.x, result.lambda);
  const bool polished = polish(problem, scales, result);
  if (polished && shares_reactions(model, result.kkt.constraints())) {
    result.lambda = least_squares_multipliers(result);
    if (const auto fault = problem.linearize(result.x, result.lambda, result.linearization))
      return not_finite(std::move(result), fault);
    if (problem.trim(trim)) return result;
    result.kkt = problem.factor(result.linearization, trim);
  }
  // Undamped Newton corrections far from a solution may diverge: after a failure the result is KINSOL's last
  // iterate.
  if (!polished) std::tie(result.x, result.lambda) = last;
  if (const auto fault = problem.evaluate(result.x, result.lambda, residual)) {
    result.report.message = undetermined_trim(model, problem, first);
    return result.report.message.empty() ? not_finite(std::move(result), fault) : result;
  }
  report_residual(model, residual, scales, result.report);
  // KINSOL may report stagnation although the iteration reached the rounding level. The residual and the last
  // correction decide.
  const bool converged = polished && result.report.residual < newton_rounding_floor;
  std::string loose = undetermined_trim(model, result.kkt);
  result.status = converged && loose.empty() ? SteadyStatus::converged : SteadyStatus::not_converged;
  if (result.status == SteadyStatus::converged) return result;
  if (loose.empty() && problem.reason()) loose = undetermined_trim(model, problem, first);
  result.report.message = !loose.empty()     ? loose
                          : problem.reason() ? problem.reason().message()
                                             : failure_message(kinsol, result.report);
  return result;
}

}  // namespace

Equilibrium solve_equilibrium(const Model& model, const Vector& parameters, const Vector& x,
                              const Vector& lambda, const SteadyOptions& options, EvaluationCounts& counts) {
  Equilibrium result = solve_from(model, parameters, x, lambda, options, counts);
  if (result.status == SteadyStatus::converged || !options.relax || x.size() > largest_relaxed) return result;
  SteadyReport report = result.report;
  Vector rested = x;
  Vector reactions;
  // Approximate rest may suffice as a guess, and with circulatory forces there may be no state of rest.
  for (const double rest : {1e-2, 1e-5, 1e-8}) {
    const RelaxationResult relaxed_guess = relax(model, parameters, rest, rested, reactions, counts);
    if (!relaxed_guess.unmet.empty()) {
      result.report.message +=
          "; no configuration near the starting guess meets all constraints: in the closest one "
          "found " +
          relaxed_guess.unmet +
          "; check lengths, angles and starting positions, and constraints that contradict "
          "each other";
    }
    if (!relaxed_guess.at_rest) return result;
    Equilibrium relaxed = solve_from(model, parameters, rested, reactions, options, counts);
    report.iterations += relaxed.report.iterations;
    report.factorizations += relaxed.report.factorizations;
    report.residual_evaluations += relaxed.report.residual_evaluations;
    if (relaxed.status != SteadyStatus::converged) continue;
    report.residual = relaxed.report.residual;
    report.worst_equation = relaxed.report.worst_equation;
    report.message.clear();
    report.relaxed = true;
    relaxed.report = report;
    return relaxed;
  }
  return result;
}

Equilibrium equilibrium_at_rest(const Model& model, const Vector& parameters, const Vector& x,
                                EvaluationCounts& counts) {
  Equilibrium result;
  result.x = x;
  SteadyProblem problem(model, parameters, counts, result.report);
  if (const auto fault = settle_multipliers(problem, result)) return not_finite(std::move(result), fault);
  if (const auto fault = problem.linearize(result.x, result.lambda, result.linearization))
    return not_finite(std::move(result), fault);
  result.status = SteadyStatus::converged;
  return result;
}

std::optional<Equilibrium> find_rest(const Model& model, const Vector& parameters, const Vector& x,
                                     EvaluationCounts& counts) {
  Equilibrium at = equilibrium_at_rest(model, parameters, x, counts);
  SteadyProblem problem(model, parameters, counts, at.report);
  SteadyResidual residual;
  if (at.status != SteadyStatus::converged || problem.evaluate(at.x, at.lambda, residual))
    return std::nullopt;
  TrimDerivatives trim;
  if (problem.trim(trim)) return std::nullopt;
  const Scales scales = find_scales(at.x, at.lambda, at.linearization, residual, trim);
  Vector dx, dl;
  problem.factor(at.linearization, trim).solve(-residual.force.col(0), -residual.constraint.col(0), dx, dl);
  if (!(dx.lpNorm<Eigen::Infinity>() <= newton_rounding * scales.length)) return std::nullopt;
  return at;
}

Equilibrium keep_equilibrium(const Model& model, const Vector& parameters, const Vector& x,
                             const Vector& lambda, EvaluationCounts& counts) {
  Equilibrium result;
  result.x = x;
  result.lambda = lambda;
  const Path path{parameters, x, lambda};
  if (const auto fault = model.linearize(path, 0, result.linearization, counts)) {
    return not_finite(std::move(result), fault);
  }
  result.kkt = KktFactorization(result.linearization.A[0]);
  result.status = SteadyStatus::converged;
  return result;
}

EvaluationFault differentiate_equilibrium(const Model& model, const Equilibrium& equilibrium,
                                          const VectorSeries& parameters, int order, Path& path,
                                          EvaluationCounts& counts) {
  path.parameters = parameters;
  path.x = VectorSeries::Zero(model.n_coordinates(), order + 1);
  path.lambda = VectorSeries::Zero(model.n_multipliers(), order + 1);
  path.x.col(0) = equilibrium.x;
  path.lambda.col(0) = equilibrium.lambda;
  // For a kept equilibrium only the constraints are factored. The complete factorization is made here if it
  // is missing.
  KktFactorization complete;
  if (!equilibrium.kkt.can_solve()) {
    SteadyReport report;
    SteadyProblem problem(model, parameters.col(0), counts, report);
    TrimDerivatives trim;
    problem.at(equilibrium);
    if (auto fault = problem.trim(trim)) return fault;
    complete = problem.factor(equilibrium.linearization, trim);
  }
  const KktFactorization& kkt = equilibrium.kkt.can_solve() ? equilibrium.kkt : complete;
  SteadyResidual residual;
  Vector dx, dl;
  std::optional<LeastSquaresSeries> shared;
  if (shares_reactions(model, kkt.constraints())) shared.emplace(equilibrium);
  for (int k = 1; k <= order; ++k) {
    if (auto fault = model.residual(path, k, residual, counts)) return fault;
    kkt.solve(-residual.force.col(k), -residual.constraint.col(k), dx, dl);
    path.x.col(k) = dx;
    path.lambda.col(k) = dl;
    if (!shared) continue;
    if (auto fault = shared->complete(model, k, path, counts)) return fault;
  }
  return {};
}

EvaluationFault differentiate_multipliers(const Model& model, const Equilibrium& equilibrium,
                                          const VectorSeries& parameters, int order, Path& path,
                                          EvaluationCounts& counts) {
  path.parameters = parameters;
  path.x = equilibrium.x;
  path.lambda = VectorSeries::Zero(model.n_multipliers(), order + 1);
  path.lambda.col(0) = equilibrium.lambda;
  SteadyResidual residual;
  for (int k = 1; k <= order; ++k) {
    if (auto fault = model.residual(path, k, residual, counts)) return fault;
    path.lambda.col(k) =
        equilibrium.kkt.constraints().transposed_pseudo_inverse_times(-residual.force.col(k));
  }
  return {};
}

}  // namespace eigentrail
