#include "eigentrail/store/projection_file.hpp"

#include <filesystem>
#include <regex>

#include "core/hdf5_writer.hpp"
#include "eigentrail/store/output_file.hpp"
#include "store/labelled_datasets.hpp"

namespace eigentrail {
namespace {

void write_terms(Hdf5Writer& file, const std::string& letter, const std::vector<AffineTerm<Matrix>>& terms) {
  for (const AffineTerm<Matrix>& term : terms) {
    const std::string name = letter + "/" + term.name;
    const auto size = static_cast<std::uint64_t>(term.matrix.rows());
    file.create_dataset({name, ElementType::real, {size, size}, false, {}});
    file.write_rows(name, 0, row_major(term.matrix));
  }
}

}  // namespace

std::string write_projected(const std::string& path, const Scene& scene, const ProjectedFamily& family,
                            bool force) {
  namespace fs = std::filesystem;
  const std::string beside = fs::path(path).replace_extension(".toml").string();
  const Existing existing = existing_pair(path, beside, force, "--force replaces it");
  Hdf5Writer file = Hdf5Writer::in_memory(path);
  write_terms(file, "M", family.pencil().M);
  write_terms(file, "C", family.pencil().C);
  write_terms(file, "K", family.pencil().K);
  // A scene of a large model has one key `file`, that of its matrices.
  static const std::regex key("(^|\n)([ \t]*file[ \t]*=[ \t]*)(\"[^\"\n]*\"|'[^'\n]*')");
  const std::string name = fs::path(path).filename().string();
  const std::string image = file.image(), text = std::regex_replace(scene.text, key, "$1$2\"" + name + "\"");
  write_durably({{path, {image}}, {beside, {text}}}, existing);
  return beside;
}

}  // namespace eigentrail
