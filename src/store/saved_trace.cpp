#include "eigentrail/store/saved_trace.hpp"

#include "core/archive.hpp"
#include "core/blas.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/plain_file.hpp"
#include "eigentrail/core/version.hpp"
#include "eigentrail/store/loci_file.hpp"
#include "store/differences.hpp"
#include "store/marked_data.hpp"

namespace eigentrail {
namespace {

void check_same(const LociFile& loci, const Scene& scene, const TraceOptions& options) {
  Settings before{{"version", loci.attribute("program_version")}, {"scene", loci.attribute("scene")}};
  Settings now{{"version", version()}, {"scene", scene.text}};
  for (const auto& [key, text] : describe_options(options)) {
    before.emplace_back(key, loci.attribute("option_" + key));
    now.emplace_back(key, text);
  }
  require_same_run(loci.path, before, now);
}

/// Separates the states from the HDF5 data. Throws InputError if there is no state or it is damaged.
SavedTrace split(const std::string& path, std::string_view bytes) {
  const std::string refusal = path + ": cannot be resumed: it ";
  const auto file = take_apart(bytes, InputError(refusal + "is damaged; begin anew with --force"));
  if (!file) throw InputError(refusal + "holds no state of the trace; begin anew with --force");
  SavedTrace saved;
  unpack(file->data, saved.trace, saved.writer);
  saved.image = file->image;
  return saved;
}

}  // namespace

std::optional<SavedTrace> read_saved_trace(const std::string& path, const Scene& scene,
                                           const TraceOptions& options) {
  const LociFile loci = read_loci(path);
  check_same(loci, scene, options);
  const std::string& status = loci.attribute("status");
  if (status != "running" && status != "interrupted") return std::nullopt;
  try {
    SavedTrace saved = split(path, bytes_of_file(path));
    saved.path = static_cast<const RecordedPath&>(loci);
    const std::string& kernel = loci.attribute("blas_kernel");
    if (kernel != blas_kernel()) saved.other_kernel = kernel;
    return saved;
  } catch (const ArchiveError& error) {
    throw InputError(path + ": cannot be resumed: the state of the trace is damaged: " + error.what());
  }
}

}  // namespace eigentrail
