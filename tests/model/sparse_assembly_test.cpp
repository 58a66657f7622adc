// Matrices of a model that is large enough to be sparse: two equal blades in moving air against one, which is
// dense.
#include <gtest/gtest.h>

#include <random>

#include "model/recorded_equations.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::sparse_assembly_test {
namespace {

/// Blades in a rotating frame, with quantities that change with p; all elements of blades occur.
std::string blades(int count) {
  std::string text =
      "[parameters]\np = 3\n[trace]\nparameter = \"p\"\nfrom = 1\nto = 5\n[frame]\nangular_velocity = [0, 0, "
      "\"p\"]\n";
  for (int i = 0; i < count; ++i) {
    const std::string name = "\"blade" + std::to_string(i) + "\"";
    text += "[[beam]]\nname = " + name +
            "\nfrom = [0, 0, 0]\nto = [2, 0, 0]\nelements = 2\nmass = 1.5\nEA = 900\nEI_flap = 2\nEI_lag = "
            "3\nGJ = 1\ntension_y = 0.01\ncentre_y = 0.02\n[[beam_damping]]\nbeam = " +
            name + "\ntime = \"0.01*p\"\n[[strips]]\nname = " + name + "\non = " + name +
            "\nchord = \"0.1*p\"\nquarter_chord_y = 0.05\nincidence = 0.1\ndrag = 0.02\n";
  }
  return text + "[[lift_lag]]\n[[apparent_mass]]\n";
}

Linearization linearization(const Setting& setting, const Vector& x, const Vector& motion) {
  Path path{VectorSeries::Zero(setting.scene.parameters.declared_values().size(), 2),
            VectorSeries::Zero(x.size(), 3), VectorSeries::Zero(setting.model->n_constraints(), 3)};
  path.parameters << setting.scene.parameters.declared_values(), 1.0;
  path.x << x, motion, 0.1 * motion;
  Linearization result;
  EvaluationCounts counts = setting.model->new_counts();
  EXPECT_FALSE(setting.model->linearize(path, 2, result, counts));
  return result;
}

TEST(SparseAssembly, OfTwoBladesHasThatOfOneTwice) {
  const Setting one = make_setting(blades(1)), two = make_setting(blades(2));
  const Eigen::Index n = one.model->n_coordinates(), states = 8, vectors = n - states;
  ASSERT_LT(n, sparse_from);
  ASSERT_EQ(two.model->n_coordinates(), 2 * n);
  ASSERT_GE(2 * n, sparse_from);
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  const auto random = [&] { return 0.1 * normal(engine); };
  const Vector guess = one.model->initial_guess(one.scene.parameters.declared_values());
  const Vector x = guess + Vector::NullaryExpr(n, random), motion = Vector::NullaryExpr(n, random);
  const auto twice = [&](const Vector& v) {
    Vector both(2 * n);
    both << v.head(vectors), v.head(vectors), v.tail(states), v.tail(states);
    return both;
  };
  const Linearization dense = linearization(one, x, motion),
                      sparse = linearization(two, twice(x), twice(motion));
  std::vector<Eigen::Index> first(static_cast<std::size_t>(n)), second = first;
  for (Eigen::Index i = 0; i < n; ++i) {
    first[static_cast<std::size_t>(i)] = i < vectors ? i : i + vectors;
    second[static_cast<std::size_t>(i)] = i < vectors ? i + vectors : i + n;
  }
  for (const auto& matrix : {&Linearization::M, &Linearization::C, &Linearization::K}) {
    const SystemSeries &small = dense.*matrix, &large = sparse.*matrix;
    ASSERT_EQ(large.size(), small.size());
    for (std::size_t k = 0; k < small.size(); ++k) {
      ASSERT_TRUE(large[k].is_sparse());
      ASSERT_FALSE(small[k].is_sparse());
      const Matrix expected = small[k].dense(), found = large[k].dense();
      ASSERT_GT(expected.norm(), 0.0);
      const double rounding = 1e-14 * expected.norm();
      EXPECT_LT((found(first, first) - expected).norm(), rounding);
      EXPECT_LT((found(second, second) - expected).norm(), rounding);
      EXPECT_EQ(found(first, second).norm(), 0.0);
      EXPECT_EQ(found(second, first).norm(), 0.0);
    }
  }
}

}  // namespace
}  // namespace eigentrail::test::sparse_assembly_test
