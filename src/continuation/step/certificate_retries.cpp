#include "continuation/step/certificate_retries.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace eigentrail {
namespace {

/// A short step passes without certificate only if it is shorter than this share of the longest one of the
/// last steps. Else it is short because the eigenvalues change on a small part of the range, and a
/// certificate can be expected.
constexpr double shrunk = 1e-2;
/// Steps are rejected because their certificate fails only up to this many times, plus this share of the
/// number of points. Beyond, they pass without certificate if the shapes of their modes agree, and are marked
/// so. Larger values take longer there; with smaller ones steps that could be certified stay without.
constexpr double free_attempts = 30.0;
constexpr double attempts_share = 0.25;
/// If the certificate has failed more often than this of late, and the error of the step is below this share
/// of the accepted one, it does not fail because of the length. With more failures longer is tried, with
/// fewer blocks are formed where a shorter step would do.
constexpr double enough_failures = 2.5;
constexpr double not_by_error = 1e-2;

/// Work is counted in multiplications at the speed of an LU, of which 1e9 take about 0.3 s on a processor of
/// 2020. The certificate may take so many in any case, most of them in proportion to the share of the range.
/// Beyond, it may take this share of all other work: a trace takes up to one and a half times as long.
constexpr double free_work = 2.5e9;
constexpr double free_at_start = 0.1;
constexpr double share_of_work = 0.5;
/// The same for what it may take in vain, for tracks that it does not certify: where it seldom closes it is
/// given up earlier. A larger share certifies a few more steps of sensitive eigenvalues, at a high price.
constexpr double free_in_vain = 1e9;
constexpr double share_in_vain = 0.12;
/// The work in vain, in multiplications, from which on a track that failed on the last step rejects none.
constexpr double noticed_in_vain = 2.5e8;
/// For each factorization of a mode, of n^3 / 3 multiplications, its corrections, its series and the search
/// for events take about so many times n^2: solutions and products with single vectors, which are several
/// times slower than factorizations.
constexpr double vectors_of_mode = 250.0;
/// Multiplications of a spectrum, of a pencil of size n, in n^3.
constexpr double spectrum_work = 480.0;

}  // namespace

Uncertified CertificateRetries::treatment(const PathFrame& frame, double h, double longest, int points,
                                          CertificateBudget budget) const {
  if (budget != CertificateBudget::within) return Uncertified::passes_by_shape;
  if (std::abs(h) <= shrunk * longest && may_stay_uncertified(frame, h)) return Uncertified::passes;
  const bool exhausted = all_ > free_attempts + attempts_share * points;
  return exhausted ? Uncertified::passes_by_shape : Uncertified::is_rejected;
}

TrackTest CertificateRetries::test_of(std::uint64_t lineage, CertificateBudget budget, bool costly) const {
  if (budget == CertificateBudget::spent) return TrackTest::none;
  const bool failed = std::find(failing_.begin(), failing_.end(), lineage) != failing_.end();
  if (!failed || !costly) return TrackTest::strict;
  return budget == CertificateBudget::spent_in_vain ? TrackTest::none : TrackTest::lenient;
}

void CertificateRetries::count_step(const std::vector<std::uint64_t>& lineages,
                                    const std::vector<TrackTest>& tests, const std::vector<bool>& certified) {
  recent_ *= forgetting;
  const std::vector<std::uint64_t> before = std::exchange(failing_, {});  // tracks that are gone are dropped
  for (std::size_t i = 0; i < lineages.size() && i < tests.size() && i < certified.size(); ++i) {
    const bool failed = std::find(before.begin(), before.end(), lineages[i]) != before.end();
    if (!certified[i] && (failed || tests[i] != TrackTest::none)) failing_.push_back(lineages[i]);
  }
}

CertificateBudget certificate_budget(const RunCounts& counts, Eigen::Index n, double progress) {
  const auto size = static_cast<double>(n);
  const auto work = [size](std::uint64_t factorizations, double vectors) {
    return static_cast<double>(factorizations) * size * size * (size / 3.0 + vectors);
  };
  const double certificate = counts.certificate_work;
  const double others = work(counts.modes.factorizations + counts.event_factorizations, vectors_of_mode) +
                        work(8 * counts.modes.modal_bases, vectors_of_mode) +
                        static_cast<double>(counts.spectra) * spectrum_work * size * size * size;
  const double free = free_work * (free_at_start + (1.0 - free_at_start) * progress);
  const double useful = certificate - counts.certificate_in_vain;
  if (certificate > free + share_of_work * others) return CertificateBudget::spent;
  const bool in_vain = counts.certificate_in_vain > free_in_vain + share_in_vain * (others + useful);
  return in_vain ? CertificateBudget::spent_in_vain : CertificateBudget::within;
}

bool is_costly_in_vain(const RunCounts& counts) {
  return counts.certificate_in_vain > noticed_in_vain;
}

void CertificateRetries::count_failure() {
  recent_ += 1.0;
  ++all_;
}

bool CertificateRetries::is_in_vain(double error) const {
  return recent_ > enough_failures && error < not_by_error;
}

}  // namespace eigentrail
