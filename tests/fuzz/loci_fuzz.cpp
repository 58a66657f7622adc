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
    (void)loci.nearest_node(p);
    try {
      (void)loci.eigenvalues_at(p);
    } catch (const InputError&) {
    }
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFolder folder;
  const std::string path = folder.write("loci.h5", data, size);
  try {
    evaluate(read_loci(path));
  } catch (const InputError&) {
  }
  try {
    // Roots take twenty times as long with sanitizers.
    ReportBudget budget;
    budget.roots = 20'000;
    (void)page_json(file_data(path, budget));
  } catch (const InputError&) {
  }
  return 0;
}
