#include "steady/redundancy.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "core/singular_vectors.hpp"
#include "core/texts.hpp"

namespace eigentrail {
namespace {

/// Relative level between rounding and what is meant: half of the digits.
const double half_of_digits = std::sqrt(std::numeric_limits<double>::epsilon());

/// The second derivatives of constraints at an equilibrium.
class Curvature {
 public:
  Curvature(const Model& model, const Vector& parameters, const Equilibrium& at, EvaluationCounts& counts)
      : model_(model), at_(at), counts_(counts), path_{parameters, at.x, at.lambda} {
    stiffness_ = stiffness(Vector::Zero(model.n_constraints()));
  }

  /// Q2^T (A^T nu)_/x Q2, relative to what its terms are without their cancellation: rounding if the
  /// constraints are redundant beside the configuration, too.
  Matrix along_motions(const Vector& nu) {
    const Matrix& Q2 = at_.kkt.constraints().null_basis();
    Vector irregular(nu.size());
    for (Eigen::Index i = 0; i < nu.size(); ++i) irregular[i] = std::cos(static_cast<double>(i));
    const double terms = change(nu.cwiseProduct(irregular)).norm();
    // Redundant ones that are linear have none; what is left is rounding in nu of all others.
    const double of_all = change(nu.cwiseAbs().maxCoeff() * irregular).norm();
    if (!(terms > half_of_digits * of_all)) return Matrix::Zero(Q2.cols(), Q2.cols());
    // As large as the stiffness itself, so that the difference keeps its digits.
    const double size = stiffness_.norm() > 0.0 ? stiffness_.norm() : terms;
    return Q2.transpose() * (change(size / terms * nu) * Q2) / size;
  }

 private:
  SystemMatrix stiffness(const Vector& more) {
    path_.lambda = at_.lambda;
    path_.lambda.col(0).head(more.size()) += more;
    Linearization here;
    if (model_.linearize(path_, 0, here, counts_)) return at_.linearization.K[0];
    return std::move(here.K[0]);
  }
  SystemMatrix change(const Vector& nu) {
    SystemMatrix result = stiffness(nu);
    result.add_scaled(-1.0, stiffness_);
    return result;
  }

  const Model& model_;
  const Equilibrium& at_;
  EvaluationCounts& counts_;
  Path path_;
  SystemMatrix stiffness_;
};

/// The combinations of the redundant ones among `dependences` (m x d) on which the curvature depends.
Matrix curved(const Matrix& curvatures, const Matrix& dependences) {
  const SingularVectors<Matrix> svd = right_singular_vectors(curvatures);
  const Eigen::Index count = (svd.values.array() > half_of_digits).count();
  return dependences * svd.V.leftCols(count);
}

/// Names of the constraints whose reactions are not unique and change the stiffness of the allowed motions,
/// in the order of the model.
std::vector<std::string> undetermined_reactions(const Model& model, const Vector& parameters,
                                                const Equilibrium& at, EvaluationCounts& counts) {
  const ConstraintFactorization& constraints = at.kkt.constraints();
  if (constraints.rank() == model.n_constraints() || constraints.null_basis().cols() == 0) return {};
  const Matrix dependences = constraints.dependences();
  Curvature curvature(model, parameters, at, counts);
  // A combination of all, with weights that do not cancel by chance.
  Vector weights(dependences.cols());
  for (Eigen::Index i = 0; i < weights.size(); ++i) weights[i] = std::cos(static_cast<double>(i));
  const Matrix of_all = curvature.along_motions(dependences * weights);
  if (of_all.norm() <= half_of_digits) return {};
  Matrix curvatures(of_all.size(), dependences.cols());
  for (Eigen::Index i = 0; i < dependences.cols(); ++i)
    curvatures.col(i) = curvature.along_motions(dependences.col(i)).reshaped();
  const Vector shares = curved(curvatures, dependences).rowwise().norm();
  std::vector<std::string> names;
  for (Eigen::Index i = 0; i < shares.size(); ++i) {
    if (shares[i] > half_of_digits * shares.maxCoeff())
      names.push_back(model.description().constraint_names[static_cast<std::size_t>(i)]);
  }
  return names;
}

}  // namespace

std::string undetermined_stiffness(const Model& model, const Vector& parameters, const Equilibrium& at,
                                   EvaluationCounts& counts) {
  if (model.description().shares_reactions) return {};
  const std::vector<std::string> names = undetermined_reactions(model, parameters, at, counts);
  if (names.empty()) return {};
  return "the reactions of " + enumerated(names) +
         " are not unique, and the stiffness depends on them: these constraints say the same at this "
         "configuration, but not beside it; leave one out, put a spring in its place, or let all share the "
         "load with reactions = \"least squares\" above the first table of the scene";
}

bool shares_reactions(const Model& model, const ConstraintFactorization& constraints) {
  return model.description().shares_reactions && constraints.rank() < model.n_constraints();
}

Vector least_squares_multipliers(const Equilibrium& at) {
  const SystemMatrix& A = at.linearization.A[0];
  Vector lambda = at.lambda;
  lambda.head(A.rows()) =
      at.kkt.constraints().transposed_pseudo_inverse_times(A.transposed_times(Vector(lambda.head(A.rows()))));
  return lambda;
}

LeastSquaresSeries::LeastSquaresSeries(const Equilibrium& at)
    : constraints_(at.kkt.constraints()), A_(at.linearization.A[0].dense()) {
  const Vector lambda = at.lambda.head(A_.rows());
  w_.push_back(constraints_.pseudo_inverse_times(A_.rowwise().squaredNorm().cwiseProduct(lambda)));
}

EvaluationFault LeastSquaresSeries::complete(const Model& model, int k, Path& path,
                                             EvaluationCounts& counts) {
  Path up_to = path;
  up_to.x = path.x.leftCols(k + 1);
  up_to.lambda = path.lambda.leftCols(k + 1);
  Linearization along;
  if (auto fault = model.linearize(up_to, k, along, counts)) return fault;
  const auto A = [&](int i) {
    return static_cast<std::size_t>(i) < along.A.size() ? along.A[static_cast<std::size_t>(i)].dense()
                                                        : Matrix(Matrix::Zero(A_.rows(), A_.cols()));
  };
  // Series of 1 / |row|^2, and of D^2 A w without the unknown w_k.
  std::vector<Vector> squares, weights;
  for (int i = 0; i <= k; ++i) {
    squares.push_back(Vector::Zero(A_.rows()));
    for (int j = 0; j <= i; ++j) squares[i] += A(j).cwiseProduct(A(i - j)).rowwise().sum();
    Vector weight = i == 0 ? Vector(Vector::Ones(A_.rows())) : Vector(Vector::Zero(A_.rows()));
    for (int j = 1; j <= i; ++j) weight -= squares[j].cwiseProduct(weights[i - j]);
    weights.push_back(weight.cwiseQuotient(squares[0]));
  }
  Vector known = Vector::Zero(A_.rows());
  for (int i = 0; i < k; ++i) {
    for (int j = 0; j <= k - i; ++j) known += weights[k - i - j].cwiseProduct(A(j) * w_[i]);
  }
  auto lambda = path.lambda.col(k).head(A_.rows());
  lambda += known - constraints_.transposed_pseudo_inverse_times(A_.transpose() * known);
  w_.push_back(constraints_.pseudo_inverse_times(squares[0].cwiseProduct(lambda - known)));
  return {};
}

}  // namespace eigentrail
