// How long the certificate may shorten steps.
#include "continuation/step/certificate_patience.hpp"

#include <gtest/gtest.h>

namespace eigentrail::test {
namespace {

const PathFrame frame{PathRange{0, 0.0, 10.0}};

TEST(CertificatePatience, RejectsAtFirst) {
  const CertificatePatience patience;
  EXPECT_EQ(patience.treatment(frame, 0.1, 1.0, 5, true), Uncertified::is_rejected);
  EXPECT_FALSE(patience.is_in_vain(0.0));
}

TEST(CertificatePatience, LetsShortStepsPassWhereStepsHaveShrunk) {
  const CertificatePatience patience;
  const double tiny = 0.9 * uncertified_share * 10.0;
  EXPECT_EQ(patience.treatment(frame, tiny, 1.0, 5, true), Uncertified::passes);
  EXPECT_EQ(patience.treatment(frame, -tiny, 1.0, 5, true), Uncertified::passes);
  // All steps are as short: the model changes on so small a part of the range.
  EXPECT_EQ(patience.treatment(frame, tiny, 2.0 * tiny, 5, true), Uncertified::is_rejected);
  EXPECT_EQ(patience.treatment(frame, tiny, 0.0, 0, true), Uncertified::is_rejected) << "the first step";
}

TEST(CertificatePatience, EndsAfterManyFailuresAndReturnsWithNewPoints) {
  CertificatePatience patience;
  int failures = 0;
  while (patience.treatment(frame, 0.1, 1.0, 8, true) == Uncertified::is_rejected && failures < 1000) {
    patience.count_failure();
    ++failures;
  }
  EXPECT_GT(failures, 10);
  EXPECT_LT(failures, 100);
  EXPECT_EQ(patience.treatment(frame, 0.1, 1.0, 8, true), Uncertified::passes_by_shape);
  EXPECT_EQ(patience.treatment(frame, 0.1, 1.0, 40, true), Uncertified::is_rejected);
}

TEST(CertificatePatience, FailuresOneAfterTheOtherOfAccurateStepsAreInVain) {
  CertificatePatience patience;
  for (int i = 0; i < 3; ++i) patience.count_failure();
  EXPECT_TRUE(patience.is_in_vain(1e-4));
  EXPECT_FALSE(patience.is_in_vain(0.5)) << "a shorter step changes more than the certificate";
  patience.count_step();
  EXPECT_FALSE(patience.is_in_vain(1e-4));
}

TEST(CertificatePatience, LeavesOutTheTestIfItCostsTooMuch) {
  const CertificatePatience patience;
  EXPECT_EQ(patience.treatment(frame, 0.1, 1.0, 5, false), Uncertified::is_not_tested);
}

TEST(CertificateMayCost, AFixedAmountAndAShareOfAllOtherWork) {
  RunCounts counts;
  const auto count = [&counts](double factorizations, double n) {
    counts.certificate_work = factorizations * n * n * (n / 3.0 + 30.0);
  };
  count(4000, 24);
  EXPECT_TRUE(certificate_may_cost(counts, 24, 0.0)) << "small";
  count(400, 224);
  EXPECT_FALSE(certificate_may_cost(counts, 224, 0.1));
  EXPECT_TRUE(certificate_may_cost(counts, 224, 1.0));
  count(50000, 224);
  EXPECT_FALSE(certificate_may_cost(counts, 224, 1.0));
  counts.modes.factorizations = 200000;
  EXPECT_TRUE(certificate_may_cost(counts, 224, 1.0));
}

TEST(CertificateMayCost, LessWhereItDoesNotClose) {
  RunCounts counts;
  counts.certificate_work = 2e9;
  EXPECT_TRUE(certificate_may_cost(counts, 24, 1.0));
  counts.certificate_in_vain = 1.1e9;
  EXPECT_TRUE(certificate_may_cost(counts, 24, 1.0)) << "most of it was useful";
  counts.certificate_in_vain = 1.8e9;
  EXPECT_FALSE(certificate_may_cost(counts, 24, 1.0));
}

/// Two failures before every step: they add up.
TEST(CertificatePatience, CountsFailuresOfEarlierStepsLess) {
  CertificatePatience patience;
  for (int step = 0; step < 3; ++step) {
    patience.count_failure();
    patience.count_failure();
    EXPECT_EQ(patience.is_in_vain(0.0), step > 0);
    patience.count_step();
  }
}

}  // namespace
}  // namespace eigentrail::test
