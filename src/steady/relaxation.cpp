#include "eigentrail/steady/relaxation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <sstream>

#include "core/positive_or_one.hpp"

namespace eigentrail {
namespace {

constexpr int most_projections = 50;
/// Steps, each of which costs a factorization of A and of the tangent stiffness.
constexpr int most_relaxations = 2000;
constexpr double longest_move = 0.2;   ///< longest step, in units of the largest coordinate
constexpr double on_manifold = 1e-10;  ///< largest |c| relative to |A row| times the length
/// Projections go on below it as long as each reduces c to this share: the rank of constraints that are
/// dependent only on the manifold shows at rounding.
constexpr double fast_projection = 0.1;
constexpr double least_regularization = 1e-14;  ///< of the unit diagonal, for dependent rows
/// Fraction of its initial value by which the force along a step may reverse.
constexpr double overshoot = 0.3;
constexpr double first_delta = 1.0;  ///< in units of the largest entry of K
constexpr double smallest_delta = 1e-12;
constexpr double largest_delta = 1e12;

/// A configuration on the manifold and the forces in it.
struct RelaxedPlace {
  Vector x, lambda;
  Linearization linearization;
  ConstraintFactorization constraints;
  Vector pull;         ///< Q2^T (f - A^T lambda)
  double force = 0.0;  ///< norm of the forces f
};

/// The Levenberg-Marquardt correction for c = `error` with rows of A scaled to unit length. The
/// regularization by |c| converges fast also where rows are dependent on the manifold, and only there
/// (Yamashita & Fukushima, Computing Suppl. 15, 2001): beside it pivots of the size of c say nothing.
Vector regularized_correction(const SystemMatrix& A, const Vector& error, const Vector& rows, double length) {
  const Vector scale = rows.unaryExpr(&positive_or_one).cwiseInverse();
  const Vector miss = scale.cwiseProduct(error);
  const double mu = std::max(miss.norm() / length, least_regularization);
  if (A.is_sparse()) {
    const SparseMatrix S = scale.asDiagonal() * A.sparse();
    SparseMatrix normal = S * SparseMatrix(S.transpose());
    normal.diagonal().array() += mu;
    return -(S.transpose() * Eigen::SimplicialLDLT<SparseMatrix>(normal).solve(miss));
  }
  const Matrix S = scale.asDiagonal() * A.dense();
  Matrix normal = S * S.transpose();
  normal.diagonal().array() += mu;
  return -(S.transpose() * normal.llt().solve(miss));
}

class Relaxation {
 public:
  Relaxation(const Model& model, const Vector& parameters, EvaluationCounts& counts)
      : model_(model), counts_(counts) {
    path_.parameters = parameters;
  }

  /// Moves x to the manifold: by regularized corrections, or by those of minimum norm, which nearly parallel
  /// constraints need. If that fails, `unmet()` describes the closest configuration.
  bool project(Vector& x, double length) {
    Vector plain = x;
    if (project(x, length, regularized_correction)) return true;
    const auto minimum_norm = [](const SystemMatrix& A, const Vector& error, const Vector&,
                                 double) -> Vector {
      return -ConstraintFactorization(A).pseudo_inverse_times(error);
    };
    if (!project(plain, length, minimum_norm)) return false;
    x = std::move(plain);
    return true;
  }

  /// The same by corrections of one kind, which are halved as long as they increase the error.
  template <class Correction>
  bool project(Vector& x, double length, const Correction& correction_for) {
    double share = 1.0;
    Vector start = x;
    Vector correction = Vector::Zero(x.size());
    double last = INFINITY;
    for (int i = 0; i < most_projections; ++i) {
      SteadyResidual residual;
      Linearization linearization;
      path_.x = x;
      path_.lambda = model_.first_multipliers(path_.parameters.col(0));
      if (model_.residual(path_, 0, residual, counts_) || model_.linearize(path_, 0, linearization, counts_))
        return false;
      const Vector rows = linearization.A[0].row_norms();
      if (rows.size() == 0) return true;
      const Vector error = residual.constraint.col(0).head(rows.size());
      const Vector miss = error.cwiseAbs().cwiseQuotient((rows * length).unaryExpr(&positive_or_one));
      const double size = miss.maxCoeff();
      if (!std::isfinite(size)) return false;
      if (size == 0.0 || (size <= on_manifold && size >= fast_projection * last)) return true;
      if (size >= last) {
        share *= 0.5;
        if (share < 1e-3) return false;
        x = start + share * correction;
        continue;
      }
      note_miss(error, rows);
      last = size;
      start = x;
      share = 1.0;
      correction = correction_for(linearization.A[0], error, rows, length);
      x += correction;
    }
    return false;
  }

  /// The same from a guess that may be symmetric, such as links in one line: if it fails, tries random points
  /// at increasing distance around the guess.
  bool project_from_guess(Vector& x, double length) {
    const Vector guess = x;
    if (project(x, length)) return true;
    const std::string unmet = unmet_;
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (const double reach : {0.01, 0.03, 0.1, 0.1, 0.3, 0.3}) {
      x = guess + reach * length * Vector::NullaryExpr(guess.size(), [&] { return uniform(engine); });
      if (project(x, length)) return true;
    }
    x = guess;
    unmet_ = unmet;
    return false;
  }

  const std::string& unmet() const { return unmet_; }

  std::optional<RelaxedPlace> at(const Vector& x) {
    RelaxedPlace place;
    place.x = x;
    path_.x = x;
    path_.lambda = place.lambda = model_.first_multipliers(path_.parameters.col(0));
    SteadyResidual residual;
    if (model_.residual(path_, 0, residual, counts_) ||
        model_.linearize(path_, 0, place.linearization, counts_))
      return std::nullopt;
    place.constraints = ConstraintFactorization(place.linearization.A[0]);
    const Vector load = -residual.force.col(0);
    place.lambda.head(model_.n_constraints()) = place.constraints.transposed_pseudo_inverse_times(load);
    // K includes the stiffness of the constraint forces, (A^T lambda)_/x, so lambda must be known first.
    path_.lambda = place.lambda;
    if (model_.linearize(path_, 0, place.linearization, counts_)) return std::nullopt;
    place.pull = place.constraints.null_basis().transpose() * load;
    place.force = load.norm();
    return place;
  }

 private:
  /// Notes the constraint with the largest error, as the least distance by which the coordinates must move to
  /// meet it.
  void note_miss(const Vector& constraint, const Vector& rows) {
    Eigen::Index worst = 0;
    const double distance =
        constraint.cwiseAbs().cwiseQuotient(rows.unaryExpr(&positive_or_one)).maxCoeff(&worst);
    std::ostringstream text;
    text << "the constraint '" << model_.description().constraint_names[static_cast<std::size_t>(worst)]
         << "' is missed by " << distance << " (m for places, rad for directions)";
    unmet_ = text.str();
  }

  const Model& model_;
  EvaluationCounts& counts_;
  Path path_;
  std::string unmet_;
};

/// The implicit step with the least damping, from `delta` on, for which it does not go against the force.
Vector downhill_step(const RelaxedPlace& place, double scale, double& delta) {
  const Matrix& Q2 = place.constraints.null_basis();
  const Matrix K = Q2.transpose() * place.linearization.K[0] * Q2;
  const Matrix identity = Matrix::Identity(K.rows(), K.cols());
  for (; delta <= largest_delta; delta *= 4.0) {
    const Eigen::LLT<Matrix> symmetric(Matrix(0.5 * (K + K.transpose()) + delta * scale * identity));
    if (symmetric.info() != Eigen::Success || !(symmetric.rcond() > smallest_delta)) continue;
    // Circulatory forces give K a skew part. It changes the direction of the step, but not against the force.
    return Eigen::PartialPivLU<Matrix>(K + delta * scale * identity).solve(place.pull);
  }
  return Vector::Zero(place.pull.size());
}

}  // namespace

RelaxationResult relax(const Model& model, const Vector& parameters, double tolerance, Vector& x,
                       Vector& lambda, EvaluationCounts& counts) {
  Relaxation relaxation(model, parameters, counts);
  const double length = positive_or_one(x.lpNorm<Eigen::Infinity>());
  if (!relaxation.project_from_guess(x, length)) return {false, relaxation.unmet()};
  std::optional<RelaxedPlace> here = relaxation.at(x);
  double delta = first_delta;
  double largest_force = 0.0;
  for (int i = 0; here && i < most_relaxations; ++i) {
    x = here->x;
    lambda = here->lambda;
    // Relative to the largest force so far: without constraints the forces themselves vanish at rest.
    largest_force = std::max(largest_force, here->force);
    if (here->pull.norm() <= tolerance * largest_force) return {true, {}};
    const double scale = positive_or_one(here->linearization.K[0].largest_entry());
    Vector step = downhill_step(*here, scale, delta);
    const double size = step.lpNorm<Eigen::Infinity>();
    if (!(size > 0.0)) return {};
    step *= std::min(1.0, longest_move * length / size);
    const Vector move = here->constraints.null_basis() * step;
    Vector ahead = here->x + move;
    std::optional<RelaxedPlace> there;
    if (relaxation.project(ahead, length)) there = relaxation.at(ahead);
    // Accept the step unless the force along it reverses by more than `overshoot`.
    const double before = here->pull.dot(step);
    const double behind = there ? (there->constraints.null_basis() * there->pull).dot(move) : -INFINITY;
    if (behind < -overshoot * before) {
      delta = std::max(4.0 * delta, 1e-3);
      if (delta > largest_delta) return {};
      continue;
    }
    delta = std::max(0.4 * delta, smallest_delta);
    here = std::move(there);
  }
  return {};
}

}  // namespace eigentrail
