// Large multibody models with sparse and with dense matrices: elements, reduction and trace.
#include <gtest/gtest.h>

#include <cmath>

#include "model/recorded_equations.hpp"
#include "support/chains.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::sparse_route_test {
namespace {

constexpr double rounding = 1e-11;  ///< relative; some hundred rounded steps
constexpr int points = 14;          ///< of each of three chains: 126 coordinates, 84 constraints

class SparseRoute : public testing::Test {
 protected:
  PathProblem problem_of(const Model& model) const {
    PathProblem problem = problem_along(model, setting.options.parameter);
    problem.order = 3;
    return problem;
  }

  Setting setting = make_setting(rotating_chains(points));
  OtherKind dense{*setting.model, OtherKind::Kind::dense};
};

const Matrix& dense(const Matrix& A) {
  return A;
}
Matrix dense(const SystemMatrix& A) {
  return A.dense();
}

/// Largest difference of two series relative to the largest coefficient of the same order.
template <class Coefficient>
double difference(const std::vector<Coefficient>& a, const std::vector<Coefficient>& b) {
  if (a.size() != b.size()) return INFINITY;
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Matrix exact = dense(b[k]);
    const double size = std::max(exact.norm(), 1e-300);
    largest = std::max(largest, (dense(a[k]) - exact).norm() / size);
  }
  return largest;
}

TEST_F(SparseRoute, BeginsAtTheDocumentedSize) {
  const auto is_sparse = [](int size) {
    const Setting of = make_setting(rotating_chains(size));
    const PathProblem problem = of.problem();
    Linearization linearization;
    EvaluationCounts counts = of.model->new_counts();
    const Vector parameters = parameters_at(problem, 1.0);
    const Path path{parameters, of.model->initial_guess(parameters), Vector::Zero(of.model->n_constraints())};
    EXPECT_FALSE(of.model->linearize(path, 1, linearization, counts));
    return linearization.K[0].is_sparse();
  };
  EXPECT_FALSE(is_sparse((sparse_from - 1) / 9));
  EXPECT_TRUE(is_sparse(sparse_from / 9 + 1));
}

TEST_F(SparseRoute, LinearizationHasFewEntries) {
  RunCounts counts;
  const PathPoint point =
      reduce_at(problem_of(*setting.model), 2.0,
                {setting.model->initial_guess(setting.problem().parameters), Vector()}, Matrix(), counts);
  ASSERT_EQ(point.status, PointStatus::computed);
  const Linearization& lin = point.equilibrium.linearization;
  ASSERT_TRUE(lin.K[0].is_sparse());
  // A point has its own 3 x 3 block and one with either neighbour; a rod joins six coordinates.
  EXPECT_LE(lin.K[0].sparse().nonZeros(), 9 * 3 * 3 * points);
  EXPECT_LE(lin.A[0].sparse().nonZeros(), (6 + 1) * 3 * points);
  EXPECT_TRUE(point.equilibrium.kkt.constraints().is_sparse());
}

TEST_F(SparseRoute, SeriesAgreeWithTheDenseRoute) {
  const PathProblem by_sparse = problem_of(*setting.model), by_dense = problem_of(dense);
  RunCounts counts;
  const EquilibriumGuess guess{setting.model->initial_guess(by_sparse.parameters), Vector()};
  const PathPoint a = reduce_at(by_sparse, 2.0, guess, Matrix(), counts);
  PathPoint b = a;
  b.equilibrium = solve_equilibrium(dense, parameters_at(by_dense, 2.0), a.equilibrium.x,
                                    a.equilibrium.lambda, {}, counts.evaluations);
  const auto node_a = differentiate_point(by_sparse, a, counts);
  const auto node_b = differentiate_point(by_dense, b, counts);
  ASSERT_TRUE(node_a && node_b);
  for (Eigen::Index k = 0; k < node_a->path.x.cols(); ++k) {
    const Vector x = node_b->path.x.col(k), lambda = node_b->path.lambda.col(k);
    EXPECT_LT((node_a->path.x.col(k) - x).norm(), rounding * x.norm()) << k;
    EXPECT_LT((node_a->path.lambda.col(k) - lambda).norm(), rounding * lambda.norm()) << k;
  }
  EXPECT_LT(difference(node_a->linearization.M, node_b->linearization.M), rounding);
  EXPECT_LT(difference(node_a->linearization.C, node_b->linearization.C), rounding);
  EXPECT_LT(difference(node_a->linearization.K, node_b->linearization.K), rounding);
  EXPECT_LT(difference(node_a->linearization.A, node_b->linearization.A), rounding);
  EXPECT_LT(difference(node_a->basis.T, node_b->basis.T), rounding);
  EXPECT_LT(difference(node_a->pencil.K, node_b->pencil.K), rounding);
}

TEST_F(SparseRoute, TracesAgreeWithTheDenseRoute) {
  TraceOptions options = setting.options;
  options.to = 4.0;
  options.tolerance = 1e-6;
  options.modes.count = 6;
  const auto record = [&](const Model& model) {
    ComplexVector last;
    TraceObserver observer;
    observer.point = [&](const TracePoint& point) {
      last.resize(static_cast<Eigen::Index>(point.modes.size()));
      for (const ModeState& state : point.modes) last[state.mode] = state.s;
      return true;
    };
    EXPECT_EQ(trace(model, options, observer).status, TraceStatus::completed);
    return last;
  };
  const ComplexVector a = record(*setting.model), b = record(dense);
  ASSERT_EQ(a.size(), 6);
  ASSERT_EQ(b.size(), 6);
  for (Eigen::Index i = 0; i < 6; ++i) EXPECT_LT(std::abs(a[i] - b[i]), options.tolerance * std::abs(b[i]));
}

TEST_F(SparseRoute, RedundantConstraintsAgreeWithTheDenseRoute) {
  // The same rod twice: sparse matrices, and the rank-revealing factorization.
  const std::string again = "[[rod]]\nfrom = \"chain 0 point 3\"\nto = \"chain 0 point 4\"\nlength = 0.05\n";
  const Setting doubled = make_setting(rotating_chains(points) + again);
  const OtherKind doubled_dense(*doubled.model, OtherKind::Kind::dense);
  RunCounts counts;
  const EquilibriumGuess guess{doubled.model->initial_guess(doubled.problem().parameters), Vector()};
  const PathPoint a = reduce_at(problem_of(*doubled.model), 2.0, guess, Matrix(), counts);
  const PathPoint b = reduce_at(problem_of(doubled_dense), 2.0, guess, Matrix(), counts);
  ASSERT_EQ(a.status, PointStatus::computed);
  EXPECT_TRUE(a.equilibrium.linearization.K[0].is_sparse());
  EXPECT_FALSE(a.equilibrium.kkt.constraints().is_sparse());
  EXPECT_EQ(a.pencil.size(), 3 * points);
  EXPECT_LT((a.equilibrium.x - b.equilibrium.x).norm(), rounding * b.equilibrium.x.norm());
  EXPECT_LT(difference(a.pencil.K, b.pencil.K), rounding);
}

TEST(SparseKind, OfASmallModelFindsTheSameEvents) {
  // Every scene may take the sparse route: the fold and the planes of a pendulum go through its fallbacks.
  // Steps behind the fold may differ, where their length follows from rounding.
  const Setting setting = pushed_pendulum({});
  const OtherKind by_sparse(*setting.model, OtherKind::Kind::sparse);
  const TraceResult expected = trace(*setting.model, setting.options, {});
  const TraceResult found = trace(by_sparse, setting.options, {});
  EXPECT_EQ(found.status, expected.status);
  EXPECT_EQ(found.nodes, expected.nodes);
  ASSERT_FALSE(expected.events.empty());
  ASSERT_EQ(found.events.size(), expected.events.size());
  for (std::size_t i = 0; i < found.events.size(); ++i) {
    EXPECT_EQ(found.events[i].kind, expected.events[i].kind);
    EXPECT_NEAR(found.events[i].p, expected.events[i].p, 1e-9);
  }
}

}  // namespace
}  // namespace eigentrail::test::sparse_route_test
