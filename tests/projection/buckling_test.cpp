// Branch points of large scenes are those of the whole scene, whatever modes are followed.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "eigentrail/projection/project.hpp"
#include "eigentrail/projection/route.hpp"
#include "eigentrail/steady/equilibrium.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::buckling_test {
namespace {

/// A column of 60 elements that stands on a clamp, 732 coordinates, under a growing weight w per length, in
/// EI / L^3.
Setting column(const std::string& modes) {
  return scene_setting("rotating_cantilever", {{"modes", modes}, {"to", "8.5"}},
                       {{"elements     = 10", "elements = 60\ndegree = 1"},
                        {"slender = 1e-6", "slender = 1e-4\nw = 0"},
                        {"parameter = \"eta\"", "parameter = \"w\""},
                        {"[[beam]] ", "[gravity]\nacceleration = [\"-w\", 0, 0]\n[[beam]] "}});
}

/// Modes whose motions do not have the shape in which the column buckles.
constexpr const char* high_modes = "near = '20 Hz', count = 3";

struct Buckling {
  RecordedTrace trace;
  std::vector<Event> branch_points;

  explicit Buckling(Setting setting) {
    EXPECT_TRUE(is_large(*setting.model, setting.options));
    project_if_large(setting.model, setting.options);
    trace = completed_trace(setting);
    branch_points = events_of(trace.result, EventKind::branch_point);
  }
  double place() const { return branch_points.empty() ? NAN : branch_points.front().p; }
};

/// The stiffness of the motions that the constraints of the whole scene allow, and its eigenvalues: those of
/// the null space of the constraints by dense matrices.
struct WholeStiffness {
  Matrix basis;
  Vector eigenvalues;
  Vector buckling;  ///< of the smallest one

  explicit WholeStiffness(double w) {
    const Equilibrium at = at_rest(column("1"), {{"w", w}});
    EXPECT_EQ(at.status, SteadyStatus::converged) << at.report.message;
    basis = ConstraintFactorization(SystemMatrix(at.linearization.A[0].dense())).null_basis();
    const Matrix K = basis.transpose() * (at.linearization.K[0] * basis);
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(0.5 * (K + K.transpose()));
    eigenvalues = solver.eigenvalues();
    buckling = basis * solver.eigenvectors().col(0);
  }
  Eigen::Index n_negative() const { return (eigenvalues.array() < 0.0).count(); }
};

TEST(BucklingOfLargeScenes, IsFoundWhereTheWholeStiffnessIsSingular) {
  const Buckling seen(column(high_modes));
  ASSERT_EQ(seen.branch_points.size(), 1u);
  const double w = seen.place();
  EXPECT_NEAR(w, 7.8373474, 5e-3);  // Greenhill 1881, of a column without shear; 9 j^2 / 4 with J_-1/3(j) = 0
  EXPECT_EQ(WholeStiffness(w * (1.0 - 1e-7)).n_negative(), 0);
  const WholeStiffness behind(w * (1.0 + 1e-7));
  EXPECT_EQ(behind.n_negative(), 1);
  // None of the followed modes vanishes there; the shape is that of the motion that does.
  EXPECT_GT(seen.trace.eigenvalues_at(w).cwiseAbs().minCoeff(), 50.0);
  const ComplexVector shape = seen.branch_points.front().shape;
  EXPECT_NEAR(std::abs(shape.dot(behind.buckling.cast<Complex>())) / shape.norm(), 1.0, 1e-6);
  // With the mode that vanishes it is at the same place.
  const Buckling followed(column("4"));
  ASSERT_EQ(followed.branch_points.size(), 1u);
  EXPECT_NEAR(followed.place(), w, 1e-7);
}

}  // namespace
}  // namespace eigentrail::test::buckling_test
