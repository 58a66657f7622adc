#include <algorithm>
#include <cctype>
#include <filesystem>

#include "core/hdf5_file.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/import/importer.hpp"
#include "eigentrail/import/write_samples.hpp"
#include "eigentrail/scene/units.hpp"
#include "eigentrail/store/output_file.hpp"

namespace eigentrail {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

const char* frame_name(StateFrame frame) {
  return frame == StateFrame::fixed ? "fixed" : "rotating";
}

void write_list(Hdf5File& file, const std::string& name, ElementType type, const auto& list) {
  if (list.empty()) return;
  file.create_dataset({name, type, {list.size()}, false, {}});
  file.write_rows(name, 0, list);
}

void write_matrices(Hdf5File& file, const std::string& name, const std::vector<Matrix>& samples) {
  if (samples.empty()) return;
  std::vector<double> rows;
  for (const Matrix& sample : samples) {
    const RowMajor ordered = sample;
    rows.insert(rows.end(), ordered.data(), ordered.data() + ordered.size());
  }
  const auto n = static_cast<std::uint64_t>(samples.front().rows());
  file.create_dataset({name, ElementType::real, {samples.size(), n, n}, false, {}});
  file.write_rows(name, 0, rows);
}

}  // namespace

void write_samples(const std::string& path, const SampledData& data) {
  check(data);
  Hdf5File file = Hdf5File::in_memory(path);
  DatasetSpec parameter{"parameter", ElementType::real, {data.count()}, false, {}};
  parameter.attributes["units"] = data.parameter_unit.empty() ? "1" : data.parameter_unit;
  if (!data.parameter_name.empty()) parameter.attributes["name"] = data.parameter_name;
  file.create_dataset(parameter);
  file.write_rows("parameter", 0, data.values);
  for (const SampledMatrix& named : sampled_matrices()) write_matrices(file, named.name, data.*named.samples);
  write_matrices(file, "A_error", data.A_error);
  write_list(file, "state_names", ElementType::text, data.state_names);
  write_list(file, "state_units", ElementType::text, data.state_units);
  write_list(file, "derivative_order", ElementType::integer,
             std::vector<std::int64_t>(data.derivative_order.begin(), data.derivative_order.end()));
  std::vector<std::string> frames;
  for (const StateFrame frame : data.state_frames) frames.emplace_back(frame_name(frame));
  write_list(file, "frame", ElementType::text, frames);
  if (data.digits) file.set_attribute("digits", static_cast<std::int64_t>(*data.digits));
  if (!data.source.empty()) file.set_attribute("source", data.source);
  write_durably(path, {file.image()});
}

namespace {

/// A text as a TOML string.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : printable(text)) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string scene_text(const Imported& imported, const std::string& file) {
  const SampledData& samples = imported.samples;
  const auto [least, largest] = std::minmax_element(samples.values.begin(), samples.values.end());
  const std::string& unit = samples.parameter_unit;
  const bool known_unit = !unit.empty() && unit_factor(unit).has_value();
  std::string text = "title = " + quoted(imported.title) + "\n\n";
  for (const std::string& line : imported.understood) text += "# " + printable(line) + "\n";
  text += "\n[parameters]\n" + imported.parameter + " = { value = " + exact_text(*least);
  text += (known_unit ? ", unit = " + quoted(unit) : "") + " }";
  text += (unit.empty() || known_unit ? "" : "  # " + printable(unit)) + "\n\n";
  text += "[sampled_family]\nfile = " + quoted(file) + "\n\n[trace]\n";
  text += "parameter = " + quoted(imported.parameter) + "\n";
  text += "from = " + exact_text(*least) + "\n";
  if (samples.count() > 1) text += "to = " + exact_text(*largest) + "\ntolerance = 1e-6\n";
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
  return name.empty() ? first : name;
}

std::string write_import(const Imported& imported, const std::string& folder, const std::string& name,
                         bool force) {
  namespace fs = std::filesystem;
  const fs::path scene = fs::path(folder) / (name + ".toml");
  const fs::path data = fs::path(folder) / (name + ".h5");
  std::error_code error;
  for (const fs::path& path : {scene, data}) {
    if (!force && fs::exists(path, error))
      throw InputError(path.string() + ": exists already; --force replaces it, --name gives another name");
  }
  fs::create_directories(folder, error);
  if (error) throw InputError(folder + ": the folder cannot be made: " + error.message());
  SampledData samples = imported.samples;
  samples.parameter_name = imported.parameter;
  write_samples(data.string(), samples);
  write_durably(scene.string(), {scene_text(imported, data.filename().string())});
  return scene.string();
}

}  // namespace eigentrail
