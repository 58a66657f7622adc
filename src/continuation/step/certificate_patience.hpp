// How long the certificate may shorten steps: where eigenvalues are very sensitive, no length makes it close.
#pragma once

#include "continuation/step/step_judgement.hpp"

namespace eigentrail {

class CertificatePatience {
 public:
  /// Visits all members, for saving and restoring the state of a trace.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.recent_, self.all_);
  }

  /// What becomes of a step of length h whose certificate fails. `longest`: of the last steps. `points`: of
  /// the trace so far. `may_cost`: whether the work for the certificate so far is within its limits.
  Uncertified treatment(const PathFrame& frame, double h, double longest, int points, bool may_cost) const;

  /// Call when a step was rejected because its certificate failed.
  void count_failure();
  /// Call when a step was taken.
  void count_step() { recent_ *= forgetting; }

  /// Whether the certificate has failed so often of late that it is not the length of the step that makes it
  /// fail. `error`: of the step / accepted error.
  bool is_in_vain(double error) const;

 private:
  /// With every step that is taken, earlier failures count less by this factor.
  static constexpr double forgetting = 0.5;

  double recent_ = 0.0;  ///< failures of late
  int all_ = 0;          ///< failures so far
};

/// Whether the work for the certificate so far is within its limits: a fixed amount, which small models never
/// reach, and half of all other work. `n`: freedoms. `progress`: share of the range that the trace has
/// covered.
bool certificate_may_cost(const RunCounts& counts, Eigen::Index n, double progress);

}  // namespace eigentrail
