// How often a step is retried with a shorter length because its certificate fails.
#include "continuation/step/certificate_retries.hpp"

#include <gtest/gtest.h>

namespace eigentrail::test::certificate_retries_test {
namespace {

const PathFrame frame{PathRange{0, 0.0, 10.0}};

TEST(CertificateRetries, RejectsAtFirst) {
  const CertificateRetries retries;
  EXPECT_EQ(retries.treatment(frame, 0.1, 1.0, 5, CertificateBudget::within), Uncertified::is_rejected);
  EXPECT_FALSE(retries.is_in_vain(0.0));
}

TEST(CertificateRetries, LetsShortStepsPassWhereStepsHaveShrunk) {
  const CertificateRetries retries;
  const double tiny = 0.9 * uncertified_share * 10.0;
  EXPECT_EQ(retries.treatment(frame, tiny, 1.0, 5, CertificateBudget::within), Uncertified::passes);
  EXPECT_EQ(retries.treatment(frame, -tiny, 1.0, 5, CertificateBudget::within), Uncertified::passes);
  // All steps are as short: the model changes on so small a part of the range.
  EXPECT_EQ(retries.treatment(frame, tiny, 2.0 * tiny, 5, CertificateBudget::within),
            Uncertified::is_rejected);
  EXPECT_EQ(retries.treatment(frame, tiny, 0.0, 0, CertificateBudget::within), Uncertified::is_rejected)
      << "the first step";
}

TEST(CertificateRetries, EndsAfterManyFailuresAndReturnsWithNewPoints) {
  CertificateRetries retries;
  int failures = 0;
  while (retries.treatment(frame, 0.1, 1.0, 8, CertificateBudget::within) == Uncertified::is_rejected &&
         failures < 1000) {
    retries.count_failure();
    ++failures;
  }
  EXPECT_GT(failures, 10);
  EXPECT_LT(failures, 100);
  EXPECT_EQ(retries.treatment(frame, 0.1, 1.0, 8, CertificateBudget::within), Uncertified::passes_by_shape);
  EXPECT_EQ(retries.treatment(frame, 0.1, 1.0, 40, CertificateBudget::within), Uncertified::is_rejected);
}

TEST(CertificateRetries, FailuresOneAfterTheOtherOfAccurateStepsAreInVain) {
  CertificateRetries retries;
  for (int i = 0; i < 3; ++i) retries.count_failure();
  EXPECT_TRUE(retries.is_in_vain(1e-4));
  EXPECT_FALSE(retries.is_in_vain(0.5)) << "a shorter step changes more than the certificate";
  retries.count_step({}, {}, {});
  EXPECT_FALSE(retries.is_in_vain(1e-4));
}

TEST(CertificateRetries, LetsStepsPassIfTheBudgetIsSpent) {
  const CertificateRetries retries;
  for (const CertificateBudget budget : {CertificateBudget::spent_in_vain, CertificateBudget::spent}) {
    EXPECT_EQ(retries.treatment(frame, 0.1, 1.0, 5, budget), Uncertified::passes_by_shape);
  }
  EXPECT_EQ(retries.test_of(1, CertificateBudget::spent, true), TrackTest::none);
  EXPECT_EQ(retries.test_of(1, CertificateBudget::spent_in_vain, true), TrackTest::strict) << "never failed";
}

TEST(CertificateRetries, ATrackThatFailedRejectsNoStepUntilItIsCertified) {
  CertificateRetries retries;
  EXPECT_EQ(retries.test_of(7, CertificateBudget::within, true), TrackTest::strict);
  retries.count_step({7, 8}, {TrackTest::strict, TrackTest::strict}, {false, true});
  EXPECT_EQ(retries.test_of(7, CertificateBudget::within, true), TrackTest::lenient);
  EXPECT_EQ(retries.test_of(7, CertificateBudget::within, false), TrackTest::strict) << "a small model";
  EXPECT_EQ(retries.test_of(7, CertificateBudget::spent_in_vain, true), TrackTest::none);
  EXPECT_EQ(retries.test_of(8, CertificateBudget::spent_in_vain, true), TrackTest::strict);
  retries.count_step({7, 8}, {TrackTest::none, TrackTest::none}, {false, false});
  EXPECT_EQ(retries.test_of(7, CertificateBudget::within, true), TrackTest::lenient) << "was not tested";
  EXPECT_EQ(retries.test_of(8, CertificateBudget::within, true), TrackTest::strict) << "has not failed";
  retries.count_step({7, 8}, {TrackTest::lenient, TrackTest::strict}, {true, true});
  EXPECT_EQ(retries.test_of(7, CertificateBudget::within, true), TrackTest::strict) << "certified again";
}

TEST(CertificateBudget, IsAFixedAmountAndAShareOfAllOtherWork) {
  RunCounts counts;
  const auto count = [&counts](double factorizations, double n) {
    counts.certificate_work = factorizations * n * n * (n / 3.0 + 200.0);
  };
  const auto at = [&counts](Eigen::Index n, double progress) {
    return certificate_budget(counts, n, progress);
  };
  count(1500, 24);
  EXPECT_EQ(at(24, 0.0), CertificateBudget::within) << "small";
  count(150, 224);
  EXPECT_EQ(at(224, 0.1), CertificateBudget::spent);
  EXPECT_EQ(at(224, 1.0), CertificateBudget::within);
  count(50000, 224);
  EXPECT_EQ(at(224, 1.0), CertificateBudget::spent);
  counts.modes.factorizations = 300000;
  EXPECT_EQ(at(224, 1.0), CertificateBudget::within);
}

TEST(CertificateBudget, IsLessWhereItDoesNotClose) {
  RunCounts counts;
  counts.certificate_work = 2.2e9;
  EXPECT_EQ(certificate_budget(counts, 24, 1.0), CertificateBudget::within);
  counts.certificate_in_vain = 5e8;
  EXPECT_EQ(certificate_budget(counts, 24, 1.0), CertificateBudget::within) << "most of it was useful";
  EXPECT_TRUE(is_costly_in_vain(counts));
  counts.certificate_in_vain = 2e9;
  EXPECT_EQ(certificate_budget(counts, 24, 1.0), CertificateBudget::spent_in_vain);
  counts.certificate_in_vain = 0.0;
  EXPECT_FALSE(is_costly_in_vain(counts));
}

/// Two failures before every step: they add up.
TEST(CertificateRetries, CountsFailuresOfEarlierStepsLess) {
  CertificateRetries retries;
  for (int step = 0; step < 3; ++step) {
    retries.count_failure();
    retries.count_failure();
    EXPECT_EQ(retries.is_in_vain(0.0), step > 0);
    retries.count_step({}, {}, {});
  }
}

}  // namespace
}  // namespace eigentrail::test::certificate_retries_test
