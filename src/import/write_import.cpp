#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/import/importer.hpp"
#include "eigentrail/scene/limits.hpp"
#include "eigentrail/scene/units.hpp"
#include "eigentrail/store/output_file.hpp"
#include "store/labelled_datasets.hpp"

namespace eigentrail {
namespace {

template <class Element>
void write_array(Hdf5Writer& file, const std::string& name, const Shape& shape,
                 const std::vector<Element>& elements) {
  file.create_dataset({name, element_type<Element>(), shape, false, {}});
  file.write_rows(name, 0, elements);
}

/// Writes a list unless it is empty.
void write_list(Hdf5Writer& file, const std::string& name, const auto& list) {
  if (!list.empty()) write_array(file, name, {list.size()}, list);
}

void write_matrices(Hdf5Writer& file, const std::string& name, const std::vector<Matrix>& samples) {
  if (samples.empty()) return;
  std::vector<double> rows;
  for (const Matrix& sample : samples) {
    const std::vector<double> ordered = row_major(sample);
    rows.insert(rows.end(), ordered.begin(), ordered.end());
  }
  const auto n = static_cast<std::uint64_t>(samples.front().rows());
  write_array(file, name, {samples.size(), n, n}, rows);
}

std::string samples_file(const SampledData& data) {
  check(data);
  Hdf5Writer file = Hdf5Writer::in_memory("samples");
  DatasetSpec parameter{"parameter", ElementType::real, {data.count()}, false, {}};
  parameter.attributes["units"] = data.parameter_unit.empty() ? "1" : data.parameter_unit;
  if (!data.parameter_name.empty()) parameter.attributes["name"] = data.parameter_name;
  file.create_dataset(parameter);
  file.write_rows("parameter", 0, data.values);
  for (const SampledMatrix& named : sampled_matrices()) write_matrices(file, named.name, data.*named.samples);
  write_matrices(file, "A_error", data.A_error);
  write_list(file, "state_names", data.state_names);
  write_list(file, "state_units", data.state_units);
  write_list(file, "derivative_order",
             std::vector<std::int64_t>(data.derivative_order.begin(), data.derivative_order.end()));
  std::vector<std::string> frames;
  for (const StateFrame frame : data.state_frames)
    frames.emplace_back(frame == StateFrame::fixed ? "fixed" : "rotating");
  write_list(file, "frame", frames);
  if (data.digits) file.set_attribute("digits", *data.digits);
  if (!data.source.empty()) file.set_attribute("source", data.source);
  return file.image();
}

/// The number of states: columns of the first coefficient.
Eigen::Index family_size(const PolynomialData& family) {
  for (const std::vector<SystemMatrix>* list : {&family.M, &family.K, &family.C, &family.A}) {
    for (const SystemMatrix& one : *list) {
      if (one.size() != 0) return one.cols();
    }
  }
  return 0;
}

/// A text as a TOML string.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : printable(text)) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

/// Throws std::invalid_argument if the coefficients do not fit each other or are not finite.
void check(const PolynomialData& family) {
  const auto list = [&](const std::vector<SystemMatrix>& coefficients, const std::string& name, bool square) {
    Eigen::Index rows = -1;
    for (std::size_t power = 0; power < coefficients.size(); ++power) {
      const SystemMatrix& one = coefficients[power];
      if (one.size() == 0) continue;
      const Eigen::Index n = family_size(family);
      if (rows < 0) rows = square ? n : one.rows();
      const std::string which = name + ", power " + std::to_string(power);
      if (one.rows() != rows || one.cols() != n)
        throw std::invalid_argument(which + " is " + std::to_string(one.rows()) + " x " +
                                    std::to_string(one.cols()) + "; expected " + std::to_string(rows) +
                                    " x " + std::to_string(n));
      if (!std::isfinite(one.norm())) throw std::invalid_argument(which + " has an entry that is not finite");
    }
  };
  const bool second_order = !family.M.empty() || !family.C.empty() || !family.K.empty();
  if (second_order && (family.K.empty() || (family.M.empty() && family.C.empty())))
    throw std::invalid_argument("expected K with M, C or both, or A and optionally E");
  if (second_order && !family.E.empty()) throw std::invalid_argument("E cannot stand beside M, C or K");
  if (!second_order && family.A.empty()) throw std::invalid_argument("no matrix K or A");
  for (const auto& [name, coefficients] : polynomial_matrices)
    list(family.*coefficients, name, *name != 'A' || !second_order);
  const auto n = static_cast<std::size_t>(family_size(family));
  if (!family.state_names.empty() && family.state_names.size() != n)
    throw std::invalid_argument(std::to_string(family.state_names.size()) + " names for " +
                                std::to_string(n) + " states");
}

/// Compressed rows, as scipy.sparse.csr_matrix has them.
void write_sparse(Hdf5Writer& file, const std::string& name, const SparseMatrix& matrix) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> rows = matrix;
  const auto entries = static_cast<std::size_t>(rows.nonZeros());
  write_array(file, name + "/data", {entries},
              std::vector<double>(rows.valuePtr(), rows.valuePtr() + entries));
  write_array(file, name + "/indices", {entries},
              std::vector<std::int64_t>(rows.innerIndexPtr(), rows.innerIndexPtr() + entries));
  write_list(file, name + "/indptr",
             std::vector<std::int64_t>(rows.outerIndexPtr(), rows.outerIndexPtr() + rows.rows() + 1));
}

std::string family_file(const PolynomialData& family) {
  check(family);
  Hdf5Writer file = Hdf5Writer::in_memory("matrices");
  for (const auto& [name, coefficients] : polynomial_matrices) {
    for (std::size_t power = 0; power < (family.*coefficients).size(); ++power) {
      const SystemMatrix& coefficient = (family.*coefficients)[power];
      if (coefficient.size() == 0) continue;
      const std::string dataset = std::string(name) + "/" + std::to_string(power);
      if (coefficient.is_sparse()) {
        write_sparse(file, dataset, coefficient.sparse());
        continue;
      }
      const Shape shape{static_cast<std::uint64_t>(coefficient.rows()),
                        static_cast<std::uint64_t>(coefficient.cols())};
      write_array(file, dataset, shape, row_major(coefficient.dense()));
    }
  }
  write_list(file, "state_names", family.state_names);
  return file.image();
}

/// The bytes of the file that the scene names. Throws std::invalid_argument if its contents do not fit.
std::string data_file(const Imported& imported) {
  if (imported.stations) return imported.stations->csv;
  if (imported.family) return family_file(*imported.family);
  SampledData samples = imported.samples;
  samples.parameter_name = imported.parameter;
  return samples_file(samples);
}

std::string scene_text(const Imported& imported, const std::string& file) {
  std::string text = "title = " + quoted(imported.title) + "\n\n";
  for (const std::string& line : imported.understood) text += "# " + printable(line) + "\n";
  text += "\n";
  if (imported.stations) return text + imported.stations->tables + "file = " + quoted(file) + "\n";
  const SampledData& samples = imported.samples;
  const std::optional<PolynomialData>& family = imported.family;
  const auto [least, largest] = family ? std::pair(family->from, family->to)
                                       : std::pair(*std::ranges::min_element(samples.values),
                                                   *std::ranges::max_element(samples.values));
  const std::string& unit = family ? family->parameter_unit : samples.parameter_unit;
  const bool known_unit = !unit.empty() && unit_factor(unit).has_value();
  text += "[parameters]\n" + imported.parameter + " = { value = " + exact_text(least);
  text += (known_unit ? ", unit = " + quoted(unit) : "") + " }";
  text += (unit.empty() || known_unit ? "" : "  # " + printable(unit)) + "\n\n";
  text += std::string(family ? "[matrix_family]" : "[sampled_family]") + "\nfile = " + quoted(file) +
          "\n\n[trace]\n";
  text += "parameter = " + quoted(imported.parameter) + "\n";
  text += "from = " + exact_text(least) + "\n";
  if (!imported.one_point()) text += "to = " + exact_text(largest) + "\ntolerance = 1e-6\n";
  if (family && family_size(*family) > limits::matrix_rows) text += "modes = 6\n";
  return text;
}

}  // namespace

std::string common_name(const std::vector<std::string>& files) {
  std::string name = std::filesystem::path(files.front()).stem().string();
  const std::string first = name;
  for (const std::string& file : files) {
    const std::string other = std::filesystem::path(file).stem().string();
    const auto place =
        std::mismatch(name.begin(), name.end(), other.begin(), other.end()).first - name.begin();
    const auto end = static_cast<std::size_t>(place);
    if (end < name.size()) name.erase(std::min(name.find_last_of("._-", end), end));
  }
  // "ws" of ws00.0.1.lin and ws03.0.1.lin, and not "ws0".
  const bool within_number = name.size() < first.size() && !name.empty() &&
                             std::isdigit(static_cast<unsigned char>(first[name.size()])) != 0;
  if (within_number) name.erase(name.find_last_not_of("0123456789") + 1);
  return name;
}

std::string write_import(const Imported& imported, const std::string& folder, const std::string& name,
                         bool force) {
  namespace fs = std::filesystem;
  const fs::path scene = fs::path(folder) / (name + ".toml");
  const fs::path data = fs::path(folder) / (name + (imported.stations ? ".csv" : ".h5"));
  const Existing existing =
      existing_pair(data.string(), scene.string(), force, "--force replaces it, --name gives another name");
  const std::string bytes = data_file(imported), text = scene_text(imported, data.filename().string());
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder + ": the folder cannot be made: " + error.message());
  write_durably({{data.string(), {bytes}}, {scene.string(), {text}}}, existing);
  return scene.string();
}

}  // namespace eigentrail
