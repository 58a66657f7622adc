#include "model/family_tables.hpp"

#include <algorithm>

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/traced_parameter.hpp"

namespace eigentrail {

const Table& only_table(const Scene& scene, const std::string& name) {
  const std::vector<const Table*> found = tables(scene, name);
  if (found.empty()) throw InputError(scene.path + ": [" + name + "]: is an empty list");
  if (found.size() > 1) throw scene_error(scene, found[1]->where, "[" + name + "]: a scene has one of these");
  return *found.front();
}

int traced_index(const Scene& scene, const std::string& name, const std::string& what) {
  if (const auto index = scene.parameters.index(traced_parameter(scene))) return *index;
  throw InputError(scene.path + ": [trace] parameter: a scene with [" + name + "] names here " + what);
}

std::string unknown_member(const Hdf5File& file, const std::vector<std::string>& known) {
  for (const std::string& name : file.members("/")) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      return "unknown '" + name + "' in it; " + suggestion(name, known);
  }
  return "";
}

std::string fault_of_names(const std::vector<std::string>& names, Eigen::Index n) {
  if (!names.empty() && static_cast<Eigen::Index>(names.size()) != n)
    return "has " + std::to_string(names.size()) + " names for " + std::to_string(n) + " states";
  const auto same = first_repetition(names);
  return same ? "has '" + names[same->first] + "' twice, for states " + std::to_string(same->first + 1) +
                    " and " + std::to_string(same->second + 1) + "; give every state a name of its own"
              : "";
}

ModelDescription describe_states(Eigen::Index n, const std::vector<std::string>& names,
                                 const std::vector<std::string>& units) {
  ModelDescription description;
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
    description.coordinate_names.push_back(names.empty() ? "x" + std::to_string(i + 1) : names[i]);
    description.coordinate_units.push_back(units.empty() || units[i].empty() ? "1" : units[i]);
  }
  return description;
}

bool is_compressed(const Hdf5File& file, const std::string& path) {
  return file.has(path + "/indptr");
}

std::size_t compressed_numbers(const Hdf5File& file, const std::string& path) {
  const Shape shape = file.has(path + "/data") ? file.shape(path + "/data") : Shape();
  return shape.size() == 1 ? shape[0] : 0;
}

SparseMatrix read_compressed_rows(const Hdf5File& file, const std::string& path, Eigen::Index most_rows,
                                  const TableReader& table) {
  const auto fail = [&](const std::string& message) { table.fail("file", "matrix " + path + message); };
  for (const char* part : {"/data", "/indices"}) {
    if (!file.has(path + part))
      fail(" has no dataset" + std::string(part).replace(0, 1, " ") +
           "; a sparse matrix has data, indices and indptr, as scipy.sparse.csr_matrix");
  }
  const Shape starts_shape = file.shape(path + "/indptr"), data_shape = file.shape(path + "/data");
  if (starts_shape.size() != 1 || starts_shape[0] < 2 || data_shape.size() != 1 ||
      file.shape(path + "/indices") != data_shape)
    fail(
        ": expected lists data and indices of one length, and indptr with one entry more than there are "
        "rows");
  const auto n = static_cast<Eigen::Index>(starts_shape[0] - 1);
  if (n > most_rows)
    fail(" has " + std::to_string(n) + " rows; expected at most " + std::to_string(most_rows));
  const std::vector<double> data = file.read_real(path + "/data");
  const std::vector<std::int64_t> indices = file.read_integers(path + "/indices");
  const std::vector<std::int64_t> starts = file.read_integers(path + "/indptr");
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(data.size());
  for (Eigen::Index row = 0; row < n; ++row) {
    const auto r = static_cast<std::size_t>(row);
    if (starts[0] != 0 || starts[r + 1] < starts[r] || starts[r + 1] > static_cast<std::int64_t>(data.size()))
      fail(": indptr does not ascend from 0 to the length of data at row " + std::to_string(row + 1));
    for (auto at = static_cast<std::size_t>(starts[r]); at < static_cast<std::size_t>(starts[r + 1]); ++at) {
      if (indices[at] < 0 || indices[at] >= n)
        fail(": row " + std::to_string(row + 1) + " has an entry in column " + std::to_string(indices[at]) +
             " (from 0); it is square with " + std::to_string(n) + " columns");
      entries.emplace_back(row, static_cast<Eigen::Index>(indices[at]), data[at]);
    }
  }
  SparseMatrix result(n, n);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace eigentrail
