// Modes that come among the followed ones, by closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "eigentrail/projection/project.hpp"
#include "support/large_families.hpp"

namespace eigentrail::test::mode_entries_test {
namespace {

/// n independent masses with s^2 = -k: k = 1, 2 and 3 of the modes that are followed, k = 3 + 4 (entry -
/// omega) of one that comes below them at omega = entry, and 30 and more of all others.
AffinePencil<SparseMatrix> masses_with_an_entering_mode(Eigen::Index n, double entry) {
  SparseMatrix M(n, n), K0(n, n), K1(n, n);
  M.setIdentity();
  for (Eigen::Index i = 0; i < n; ++i)
    K0.insert(i, i) = i < 3 ? static_cast<double>(i + 1) : 30.0 + 0.1 * static_cast<double>(i);
  K0.coeffRef(3, 3) = 3.0 + 4.0 * entry;
  K1.insert(3, 3) = -4.0;
  K0.makeCompressed();
  K1.makeCompressed();
  return {{{1.0, M}}, {}, {{1.0, K0}, {Expression::of_parameter(0), K1}}};
}

TEST(ModeEntries, AreNotedWithinTheStepInWhichTheyEnter) {
  for (const double entry : {0.08, 0.37, 0.625, 0.93}) {
    const TraceSetup setup = large_setup(masses_with_an_entering_mode(300, entry), 0.0, 1.0, 3, 1e-6);
    const auto model = projected_family(setup, setup.options);
    ASSERT_EQ(model->projection()->notes.size(), 1U) << entry;
    const std::string& note = model->projection()->notes.front();
    double from = 0.0, to = 0.0, frequency = 0.0;
    const std::size_t where = note.find("between");
    ASSERT_NE(where, std::string::npos) << note;
    ASSERT_EQ(
        std::sscanf(note.c_str() + where, "between omega = %lf and %lf, at %lf", &from, &to, &frequency), 3)
        << note;
    EXPECT_LE(from, entry) << note;
    EXPECT_GE(to, entry) << note;
    EXPECT_LE(to - from, 1.0 / 16.0 + 1e-4) << note;  // the longest step of the trace that looks for it
    EXPECT_LE(frequency, std::sqrt(3.0) + 1e-3) << note;
    EXPECT_GE(frequency, std::sqrt(3.0 - 4.0 / 16.0) - 1e-3) << note;
  }
}

TEST(ModeEntries, AreNotNotedWhereTheyStayAway) {
  const TraceSetup setup = large_setup(masses_with_an_entering_mode(300, 1.1), 0.0, 1.0, 3, 1e-6);
  const auto model = projected_family(setup, setup.options);
  EXPECT_TRUE(model->projection()->notes.empty()) << model->projection()->notes.front();
}

}  // namespace
}  // namespace eigentrail::test::mode_entries_test
