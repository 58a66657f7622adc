// A boundary search gives the same, bit for bit, whoever computes its pieces.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "stability/boundaries.hpp"

namespace eigentrail::test::boundary_workers_test {
namespace {

/// Three circles of flutter of different modes that intersect, and a line of divergence.
BoundarySetup several_curves() {
  BoundaryRequest request = square_window();
  return prepare_boundary(parse_scene(freedoms({{"(P - 0.1)^2 + (Q + 0.2)^2 - 0.16", "1.4 - P - Q"},
                                                {"(P - 0.3)^2 + Q^2 - 0.3", "4"},
                                                {"(P + 0.4)^2 + (Q - 0.3)^2 - 0.1", "9"}}),
                                      "test.toml"),
                          request);
}

void expect_same(const BoundaryResult& a, const BoundaryResult& b) {
  ASSERT_EQ(a.curves.size(), b.curves.size());
  for (std::size_t i = 0; i < a.curves.size(); ++i) {
    EXPECT_EQ(a.curves[i].mode, b.curves[i].mode);
    ASSERT_EQ(a.curves[i].steps.size(), b.curves[i].steps.size());
    for (std::size_t k = 0; k < a.curves[i].steps.size(); ++k) {
      EXPECT_EQ(a.curves[i].steps[k].left, b.curves[i].steps[k].left);
      EXPECT_EQ(a.curves[i].steps[k].right, b.curves[i].steps[k].right);
    }
  }
  ASSERT_EQ(a.corners.size(), b.corners.size());
  for (std::size_t i = 0; i < a.corners.size(); ++i) EXPECT_EQ(a.corners[i].place, b.corners[i].place);
  EXPECT_EQ(a.notes, b.notes);
  EXPECT_EQ(a.rejected_steps, b.rejected_steps);
  EXPECT_EQ(a.counts.modes.factorizations, b.counts.modes.factorizations);
  EXPECT_EQ(a.counts.spectra, b.counts.spectra);
}

BoundaryResult found_by(int jobs, const BoundarySetup& setup) {
  Threads threads(jobs);
  const auto lines = numbers_to(boundary_lines(setup.options));
  const auto scans = scan_boundaries(*setup.model, setup.options, lines, threads);
  return follow_boundaries(*setup.model, setup.options, scans, threads);
}

TEST(BoundaryWorkers, AnyNumberFindsTheSame) {
  const BoundarySetup setup = several_curves();
  const BoundaryResult alone = found_by(1, setup);
  EXPECT_GE(alone.curves.size(), 4U);
  EXPECT_FALSE(alone.corners.empty());
  for (const int jobs : {2, 3, 16}) expect_same(found_by(jobs, setup), alone);
}

TEST(BoundaryWorkers, LinesThatWereSearchedApartGiveTheSame) {
  const BoundarySetup setup = several_curves();
  Threads threads(2);
  std::vector<std::string> scans(boundary_lines(setup.options));
  for (int number = 1; number <= 3; ++number) {
    const std::vector<std::size_t> lines = Part{number, 3}.pieces(scans.size());
    const auto found = scan_boundaries(*setup.model, setup.options, lines, threads);
    for (std::size_t i = 0; i < lines.size(); ++i) scans[lines[i]] = found[i];
  }
  expect_same(follow_boundaries(*setup.model, setup.options, scans, threads), found_by(2, setup));
  scans[3].pop_back();
  EXPECT_THROW((void)follow_boundaries(*setup.model, setup.options, scans, threads), InputError);
}

}  // namespace
}  // namespace eigentrail::test::boundary_workers_test
