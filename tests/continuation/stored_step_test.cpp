// A step as it is stored, and the certificates of its tracks.
#include "continuation/step/stored_step.hpp"

#include <gtest/gtest.h>

#include "continuation/planted_search.hpp"
#include "continuation/step/step_judgement.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail::test::stored_step_test {
namespace {

/// Frequencies 2 + p and 2.6 - p in one block, and 5.
struct Lines {
  explicit Lines(double to = 0.2)
      : planted(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}, {5.0, 0.0}}))),
        left(planted.family.point(0.0, {{{5.0 * j}}, {{2.0 * j, 2.6 * j}}})),
        step(planted.step(left, to, {{{5.0 * j}}, {{(2.0 + to) * j, (2.6 - to) * j}}})) {}
  PathStep stored(const std::vector<bool>& certified) {
    return stored_step(planted.family.problem(), step, certified);
  }
  PlantedSearch planted;
  PathNode left;
  Step step;
};

TEST(StoredStep, HoldsTheFunctionsOfEveryTrackAtBothEnds) {
  Lines lines;
  const PathStep stored = lines.stored({true, true});
  EXPECT_EQ(stored.length, 0.2);
  ASSERT_EQ(stored.blocks.size(), 2U);
  EXPECT_EQ(stored.blocks[0].modes, std::vector<int>{0});
  EXPECT_EQ(stored.blocks[1].modes, (std::vector<int>{1, 2}));
  const ComplexVector at_left{{5.0 * j, 2.0 * j, 2.6 * j}};
  const ComplexVector at_right{{5.0 * j, 2.2 * j, 2.4 * j}};
  const ComplexVector middle = step_eigenvalues(stored, at_left, at_right, 0.5);
  EXPECT_LT(distance(middle, ComplexVector{{5.0 * j, 2.1 * j, 2.5 * j}}), 1e-12);
}

TEST(StoredStep, IsCertifiedWhereItsTracksAre) {
  Lines lines;
  const PathStep stored = lines.stored({false, true});
  EXPECT_FALSE(stored.blocks[0].certified);
  EXPECT_TRUE(stored.blocks[1].certified);
}

TEST(StoredStep, WithoutACertificateIsNotCertified) {
  Lines lines;
  for (const DenseBlock& block : lines.stored({}).blocks) EXPECT_FALSE(block.certified);
}

/// Strict tests of so many tracks.
std::vector<TrackTest> strict(std::size_t count) {
  return std::vector<TrackTest>(count, TrackTest::strict);
}

/// Three single modes of which two arrive exchanged.
struct Exchanged {
  Exchanged(std::size_t one, std::size_t other) {
    std::swap(step.right.tracks[one], step.right.tracks[other]);
  }
  PlantedSearch planted{Planted::frequencies(uncoupled(Matrix{{2.0, 0.1}, {2.6, 0.1}, {5.0, 0.1}}))};
  PathNode left = planted.family.point(0.0, alone({2.0 * j, 2.6 * j, 5.0 * j}));
  Step step = planted.step(left, 0.1, alone({2.01 * j, 2.61 * j, 5.01 * j}));
};

/// A mode in the chart of s, and two eigenvalues, with their conjugates, in that of 1/s, whose mass goes to
/// zero. How far these are from that one is a difference of reciprocals, in every unit of time.
TEST(Certify, ClosesInBothChartsInAnyUnitOfTime) {
  const Matrix light{{1.0, 0.0}, {0.0, 0.0}}, heavy{{0.0, 0.0}, {0.0, 1.0}};
  const Matrix damping{{0.1, 0.05}, {0.05, 0.4}}, stiffness{{1.0, 0.2}, {0.2, 1.0}};
  for (const double time : {1e-5, 1.0, 1e5}) {
    const Matrix C = damping / time, K = stiffness / (time * time);
    PlantedSearch planted(Planted({{light, heavy}, {C}, {K}}));
    const auto tracks = [&](double p) {
      const Spectrum spectrum = compute_spectrum(light + p * heavy, C, K);
      Together fast{{}, Chart::reciprocal};
      for (std::size_t i = 1; i < spectrum.modes.size(); ++i) {
        fast.s.push_back(spectrum.modes[i].s);
        if (fast.s.back().imag() != 0.0) fast.s.push_back(std::conj(fast.s.back()));
      }
      return std::vector<Together>{{{spectrum.modes[0].s}}, fast};
    };
    const PathNode left = planted.family.point(0.16, tracks(0.16));
    const Step step = planted.step(left, 0.01, tracks(0.01));
    RunCounts counts;
    std::vector<TrackTest> tests = strict(2);
    EXPECT_EQ(certify(planted.family.problem(), step, false, tests, counts), (std::vector<bool>{true, true}))
        << time;
  }
}

TEST(Certify, DoesNotDependOnTheNumberOfThreads) {
  Exchanged last(1, 2);
  std::vector<std::uint64_t> work;
  for (const int threads : {1, 4}) {
    PathProblem problem = last.planted.family.problem();
    problem.threads = threads;
    RunCounts counts;
    std::vector<TrackTest> tests = strict(3);
    EXPECT_EQ(certify(problem, last.step, false, tests, counts), (std::vector<bool>{true, false, false}));
    work.push_back(counts.certificate_factorizations);
  }
  EXPECT_EQ(work[0], work[1]);
}

}  // namespace
}  // namespace eigentrail::test::stored_step_test
