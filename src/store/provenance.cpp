#include "store/provenance.hpp"

#include "core/blas.hpp"
#include "core/texts.hpp"
#include "eigentrail/core/version.hpp"

namespace eigentrail {

void write_provenance(Hdf5Writer& file, const std::string& format, int schema_version, const Scene& scene,
                      const TraceOptions& options) {
  file.set_attribute("format", format);
  file.set_attribute("schema_version", schema_version);
  file.set_attribute("program_version", version());
  file.set_attribute("blas_kernel", blas_kernel());
  file.set_attribute("title", scene.title);
  file.set_attribute("scene", scene.text);
  file.set_attribute("scene_path", scene.path);
  file.set_attribute("parameter", options.parameter);
  file.set_attribute("tolerance", options.tolerance);
  for (const auto& [key, text] : describe_options(options)) file.set_attribute("option_" + key, text);
  if (options.events.operating.ranges.empty()) return;
  file.set_attribute("operating_range", ranges_text(options.events.operating));
  file.set_attribute("separation_margin", margin_text(options.events.operating));
}

void check_schema(const Hdf5File& file, const std::string& path, int expected) {
  const std::int64_t found = file.integer_attribute("schema_version");
  if (found == expected) return;
  throw InputError(path + ": has schema " + std::to_string(found) + ", this program reads schema " +
                   std::to_string(expected));
}

void write_notes(Hdf5Writer& file, const std::vector<std::string>& notes) {
  file.set_attribute("notes", joined(notes, "; "));
}

}  // namespace eigentrail
