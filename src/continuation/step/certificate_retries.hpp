// How often a step is retried with a shorter length because its certificate fails: where eigenvalues are very
// sensitive, no length makes it close.
#pragma once

#include <cstdint>
#include <vector>

#include "continuation/step/step_judgement.hpp"

namespace eigentrail {

/// What the work for the certificate so far leaves.
enum class CertificateBudget {
  within,
  spent_in_vain,  ///< tracks whose certificate failed are not tested again for now
  spent           ///< nothing is tested for now
};

class CertificateRetries {
 public:
  /// Visits all members, for saving and restoring the state of a trace.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.recent_, self.all_, self.failing_);
  }

  /// What becomes of a step of length h whose certificate fails. `longest`: of the last steps. `points`: of
  /// the trace so far.
  Uncertified treatment(const PathFrame& frame, double h, double longest, int points,
                        CertificateBudget budget) const;

  /// How a track is tested on the next step. `costly`: whether the work in vain so far is noticeable at all;
  /// else every track is tested on every step.
  TrackTest test_of(std::uint64_t lineage, CertificateBudget budget, bool costly) const;

  /// Call when a step was rejected because its certificate failed.
  void count_failure();
  /// Call when a step was taken, with its tracks, how they were tested and whether they are certified.
  void count_step(const std::vector<std::uint64_t>& lineages, const std::vector<TrackTest>& tests,
                  const std::vector<bool>& certified);

  /// Whether the certificate has failed so often of late that it is not the length of the step that makes it
  /// fail. `error`: of the step / accepted error.
  bool is_in_vain(double error) const;

 private:
  /// With every step that is taken, earlier failures count less by this factor.
  static constexpr double forgetting = 0.5;

  double recent_ = 0.0;                 ///< failures of late
  int all_ = 0;                         ///< failures so far
  std::vector<std::uint64_t> failing_;  ///< tracks that were not certified when they were last tested
};

/// What is left of the limits of the work for the certificate: a fixed amount, which small models never
/// reach, and a share of all other work. `n`: freedoms. `progress`: share of the range that the trace has
/// covered.
CertificateBudget certificate_budget(const RunCounts& counts, Eigen::Index n, double progress);

/// Whether the work in vain so far is so large that tracks that failed on the last step reject none.
bool is_costly_in_vain(const RunCounts& counts);

}  // namespace eigentrail
