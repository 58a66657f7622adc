#include "eigentrail/store/saved_trace.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/archive.hpp"
#include "core/blas.hpp"
#include "core/fingerprint.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/version.hpp"
#include "eigentrail/store/loci_file.hpp"
#include "store/differences.hpp"
#include "store/saved_state.hpp"

namespace eigentrail {
namespace {

/// The last bytes of a file that contains a state.
struct Mark {
  static constexpr std::string_view text = "eigentrail-state";
  std::array<char, text.size()> name = {};
  std::uint64_t size = 0;      ///< size of the state, which precedes the mark, in bytes
  std::uint64_t checksum = 0;  ///< of all bytes before the mark
};

void check_same(const LociFile& loci, const Scene& scene, const TraceOptions& options) {
  Settings before{{"version", loci.attribute("program_version")}, {"scene", loci.attribute("scene")}};
  Settings now{{"version", version()}, {"scene", scene.text}};
  for (const auto& [key, text] : describe_options(options)) {
    before.emplace_back(key, loci.attribute("option_" + key));
    now.emplace_back(key, text);
  }
  require_same_run(loci.path, before, now);
}

}  // namespace

std::string saved_state(std::string_view image, const std::string& trace, const std::string& writer) {
  std::string bytes = packed(trace, writer);
  Mark mark{{}, bytes.size(), fingerprint(bytes, fingerprint(image))};
  std::copy(Mark::text.begin(), Mark::text.end(), mark.name.begin());
  bytes.append(reinterpret_cast<const char*>(&mark), sizeof mark);
  return bytes;
}

namespace {

/// Separates the states from the HDF5 data. Throws InputError if there is no state or it is damaged.
SavedTrace split(const std::string& path, std::string_view bytes) {
  Mark mark;
  const bool has_mark = bytes.size() >= sizeof mark;
  if (has_mark) std::memcpy(&mark, bytes.data() + bytes.size() - sizeof mark, sizeof mark);
  if (!has_mark || std::string_view(mark.name.data(), mark.name.size()) != Mark::text)
    throw InputError(path + ": cannot be resumed: it holds no state of the trace; begin anew with --force");
  const std::string_view before = bytes.substr(0, bytes.size() - sizeof mark);
  if (mark.size > before.size() || fingerprint(before) != mark.checksum)
    throw InputError(path + ": cannot be resumed: it is damaged; begin anew with --force");
  const std::string_view state = before.substr(before.size() - mark.size);
  SavedTrace saved;
  ArchiveReader archive(state);
  archive(saved.trace, saved.writer);
  archive.finish();
  saved.image = before.substr(0, before.size() - state.size());
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
