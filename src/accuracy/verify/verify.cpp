#include "eigentrail/accuracy/verify.hpp"

#include <algorithm>

#include "accuracy/verify/comparisons.hpp"
#include "eigentrail/core/errors.hpp"

namespace eigentrail {

bool VerifyReport::passed() const {
  return !comparisons.empty() && std::all_of(comparisons.begin(), comparisons.end(),
                                             [](const Comparison& one) { return one.faults.empty(); });
}

VerifyReport verify_loci(const LociFile& loci, const VerifyOptions& options) {
  if (loci.n_nodes() == 0) throw InputError(loci.path + ": holds no points");
  const TraceSetup setup = setup_of(loci);
  const CheckedFile file = checked_file(loci, setup);
  FreshSolver solver(setup, loci);
  VerifyReport report;
  report.comparisons = {compare_labels(file), compare_columns(file), compare_stability(file, solver),
                        compare_spectra(file, options, solver)};
  if (!solver.is_of_large_model()) report.comparisons.push_back(compare_points(file, options, solver));
  report.comparisons.push_back(compare_events(file, solver));
  // What is wrong already is told where it is; a new trace takes longest.
  if (report.passed()) report.comparisons.push_back(compare_new_trace(file));
  return report;
}

}  // namespace eigentrail
