// Bytes as a file of eigentrail: read as loci and evaluated, and turned into the data of a report page, which
// shows boundaries, maps and accuracy studies too.
#include <cmath>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/store/loci_file.hpp"
#include "fuzz/entry.hpp"
#include "fuzz/scratch_folder.hpp"
#include "report/file_data.hpp"

using namespace eigentrail;

namespace {

void evaluate(const LociFile& loci) {
  for (std::size_t mode = 0; mode < loci.modes.size(); ++mode) (void)loci.certified_share(mode);
  if (loci.p.empty()) return;
  const double range = loci.highest() - loci.lowest();
  for (const double share : {0.0, 0.3, 0.5, 1.0}) {
    const double p = loci.lowest() + share * range;
    try {
      (void)loci.eigenvalues_at(p);
    } catch (const InputError&) {
    }
  }
}

/// Files of other kinds are turned into the data of a page as well.
void show_other(const std::string& path, const ReportBudget& budget) {
  try {
    (void)page_json(file_data(path, budget));
  } catch (const InputError&) {
  }
}

}  // namespace

EIGENTRAIL_FUZZ(loci) {
  static const fuzz::ScratchFolder folder;
  const std::string path = folder.write("loci.h5", bytes);
  ReportBudget budget;
  budget.roots = 4'000;  // they take twenty times as long with sanitizers
  try {
    const LociFile loci = read_loci(path);
    evaluate(loci);
    (void)page_json(loci_data(loci, Hdf5File::open(path), budget));
  } catch (const InputError&) {
    show_other(path, budget);
  }
}
