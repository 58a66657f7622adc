#include "eigentrail/core/errors.hpp"
#include "eigentrail/import/importer.hpp"
#include "import/formats.hpp"

namespace eigentrail {

const std::vector<Importer>& importers() {
  static const std::vector<Importer> all{openfast_importer(), matrix_market_importer(), matlab_importer(),
                                         nastran_importer(), numpy_importer()};
  return all;
}

const Importer& importer(const std::string& format) {
  std::vector<std::string> known;
  for (const Importer& one : importers()) {
    if (one.format == format) return one;
    known.push_back(one.format);
  }
  throw InputError("unknown format '" + format + "'; " + suggestion(format, known));
}

}  // namespace eigentrail
