#include "array_files.hpp"

#include <matio.h>
#include <sys/mman.h>
#include <unistd.h>
#include <zip.h>

#include <array>
#include <bit>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/core/version.hpp"

namespace eigentrail::app {
namespace {

using Json = nlohmann::ordered_json;

/// Stands in the first bytes of every file: a file without it is somebody else's.
constexpr const char* mark = "eigentrail";

bool is_ours(const std::string& path) {
  constexpr std::size_t header_of_matlab = 128;
  std::string begin(header_of_matlab, '\0');
  std::ifstream(path, std::ios::binary).read(begin.data(), header_of_matlab);
  return begin.find(mark) != std::string::npos;
}

/// What a kind of file is called, where it may be replaced.
OutputFormat ours(const std::string& name) {
  return {name + " of eigentrail", is_ours};
}

/// Extents of a single sample.
std::vector<std::size_t> shape_of(const NamedSamples& array) {
  if (!array.texts.empty()) return {array.texts.size()};
  const std::vector<std::size_t> all{static_cast<std::size_t>(array.samples.front().rows()),
                                     static_cast<std::size_t>(array.samples.front().cols())};
  return {all.begin(), all.begin() + array.rank};
}

/// The code points of a text in UTF-8; what is none is kept byte by byte.
std::u32string code_points(const std::string& text) {
  std::u32string points;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const int ones = std::countl_one(first);
    const std::size_t length = ones < 2 || ones > 4 || i + static_cast<std::size_t>(ones) > text.size()
                                   ? 1
                                   : static_cast<std::size_t>(ones);
    char32_t point = length == 1 ? first : first & (0x7FU >> length);
    for (std::size_t k = 1; k < length; ++k)
      point = (point << 6U) | (static_cast<unsigned char>(text[i + k]) & 0x3FU);
    points += point;
    i += length;
  }
  return points;
}

/// A file of NumPy's format (version 1.0): a header that is a dictionary of Python, then the entries.
std::string npy(const NamedSamples& array) {
  std::vector<std::size_t> shape = shape_of(array);
  if (array.samples.size() > 1) shape.insert(shape.begin(), array.samples.size());
  std::string type = "<f8", entries;
  if (array.texts.empty()) {
    for (const Matrix& sample : array.samples) {
      for (const double entry : sample.reshaped<Eigen::RowMajor>())
        entries.append(reinterpret_cast<const char*>(&entry), sizeof entry);
    }
  } else {
    std::vector<std::u32string> texts;
    std::size_t longest = 1;
    for (const std::string& text : array.texts)
      longest = std::max(longest, texts.emplace_back(code_points(text)).size());
    type = "<U" + std::to_string(longest);
    for (std::u32string& text : texts) {
      text.resize(longest);
      entries.append(reinterpret_cast<const char*>(text.data()), longest * sizeof(char32_t));
    }
  }
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  for (const std::size_t extent : shape) header += std::to_string(extent) + ", ";
  header += "), }";
  constexpr std::size_t before = 10, aligned = 64;
  header.append(aligned - 1 - (before + header.size()) % aligned, ' ');
  header += '\n';
  const auto length = static_cast<std::uint16_t>(header.size());
  return std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(length & 0xFFU) +
         static_cast<char>(length >> 8U) + header + entries;
}

std::string npz(const std::vector<NamedSamples>& arrays) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* whole = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_source_keep(whole);
  const std::unique_ptr<zip_source_t, decltype(&zip_source_free)> owner(whole, &zip_source_free);
  zip_t* archive = zip_open_from_source(whole, ZIP_TRUNCATE, &error);
  if (archive == nullptr) throw std::runtime_error(zip_error_strerror(&error));
  std::vector<std::string> files;  // which the archive reads when it is closed
  for (const NamedSamples& array : arrays) files.push_back(npy(array));
  for (std::size_t i = 0; i < arrays.size(); ++i)
    zip_file_add(archive, (arrays[i].name + ".npy").c_str(),
                 zip_source_buffer(archive, files[i].data(), files[i].size(), 0), ZIP_FL_ENC_UTF_8);
  if (zip_close(archive) != 0) throw std::runtime_error(zip_strerror(archive));
  zip_stat_t size;
  zip_source_stat(whole, &size);
  std::string bytes(size.size, '\0');
  zip_source_open(whole);
  zip_source_read(whole, bytes.data(), bytes.size());
  zip_source_close(whole);
  return bytes;
}

using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

/// The samples along the last dimension; texts as a column of cells.
Variable variable_of(const NamedSamples& array) {
  std::vector<std::size_t> shape = shape_of(array);
  const std::size_t samples = array.samples.size();
  if (array.rank == 1 && samples <= 1) shape.push_back(1);
  if (array.rank == 0) shape.push_back(1);
  if (samples > 1) shape.push_back(samples);
  if (shape.size() == 1) shape.push_back(1);
  const auto rank = static_cast<int>(shape.size());
  if (array.texts.empty()) {
    Vector entries(static_cast<Eigen::Index>(samples) * array.samples.front().size());
    for (std::size_t i = 0; i < samples; ++i) {
      const Matrix& sample = array.samples[i];
      entries.segment(static_cast<Eigen::Index>(i) * sample.size(), sample.size()) = sample.reshaped();
    }
    return {
        Mat_VarCreate(array.name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, rank, shape.data(), entries.data(), 0),
        &Mat_VarFree};
  }
  std::vector<matvar_t*> cells;  // which belong to the variable then
  for (const std::string& text : array.texts) {
    std::u16string units;
    for (const char32_t point : code_points(text))
      units += point < 0xD800U ? static_cast<char16_t>(point) : u'?';
    std::array<std::size_t, 2> extents{units.empty() ? 0U : 1U, units.size()};
    cells.push_back(Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF16, 2, extents.data(), units.data(), 0));
  }
  return {Mat_VarCreate(array.name.c_str(), MAT_C_CELL, MAT_T_CELL, rank, shape.data(), cells.data(), 0),
          &Mat_VarFree};
}

/// A file of version 5. Matio writes files by name only: one in memory has the name of its descriptor.
std::string mat(const std::vector<NamedSamples>& arrays) {
  struct Memory {
    int descriptor = memfd_create("arrays", MFD_CLOEXEC);
    ~Memory() { close(descriptor); }
  } memory;
  const std::string name = "/proc/self/fd/" + std::to_string(memory.descriptor);
  {
    const std::unique_ptr<mat_t, decltype(&Mat_Close)> file(Mat_CreateVer(name.c_str(), mark, MAT_FT_MAT5),
                                                            &Mat_Close);
    if (!file) throw std::runtime_error("a file of MATLAB cannot be written into memory");
    for (const NamedSamples& array : arrays) {
      if (Mat_VarWrite(file.get(), variable_of(array).get(), MAT_COMPRESSION_ZLIB) != 0)
        throw std::runtime_error("array " + array.name + " cannot be written to a file of MATLAB");
    }
  }
  std::ifstream file(name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Json json_of(const Matrix& sample, int rank) {
  if (rank == 0) return sample(0, 0);
  if (rank == 1) return std::vector<double>(sample.data(), sample.data() + sample.size());
  Json rows = Json::array();
  for (const auto& row : sample.rowwise()) rows.push_back(std::vector<double>(row.begin(), row.end()));
  return rows;
}

Json json_of(const NamedSamples& array) {
  if (!array.texts.empty()) return array.texts;
  if (array.samples.size() == 1) return json_of(array.samples.front(), array.rank);
  Json samples = Json::array();
  for (const Matrix& sample : array.samples) samples.push_back(json_of(sample, array.rank));
  return samples;
}

std::string json_text(const std::vector<NamedSamples>& arrays) {
  const auto member = [](const NamedSamples& array) {
    const auto replace = Json::error_handler_t::replace;  // texts that are not UTF-8
    return Json(array.name).dump() + ": " + json_of(array).dump(-1, ' ', false, replace);
  };
  return "{" + joined(arrays, ",\n ", member) + "}\n";
}

/// The entries that are not zero (Matrix Market, coordinate format).
std::string matrix_market(const Matrix& matrix) {
  std::string entries;
  Eigen::Index count = 0;
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      if (matrix(i, j) == 0.0) continue;
      ++count;
      entries += std::to_string(i + 1) + " " + std::to_string(j + 1) + " " + exact_text(matrix(i, j)) + "\n";
    }
  }
  return "%%MatrixMarket matrix coordinate real general\n% " + std::string(mark) + "\n" +
         std::to_string(matrix.rows()) + " " + std::to_string(matrix.cols()) + " " + std::to_string(count) +
         "\n" + entries;
}

bool is_file(const NamedSamples& array) {
  return array.rank == 2 && array.texts.empty();
}

std::vector<ArrayFile> folder_of(const std::string& output, const std::vector<NamedSamples>& arrays) {
  const std::filesystem::path folder = output;
  std::vector<ArrayFile> files;
  std::set<std::filesystem::path> names;
  std::vector<NamedSamples> others;
  for (const NamedSamples& array : arrays) {
    if (!is_file(array)) {
      others.push_back(array);
      continue;
    }
    files.push_back({folder / (array.name + ".mtx"), ours("file of Matrix Market"),
                     matrix_market(array.samples.front())});
  }
  files.push_back({folder / "model.json", ours("file of JSON"), json_text(others)});
  for (const ArrayFile& file : files) names.insert(file.path);
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".mtx" && !names.contains(entry.path()))
      throw InputError(entry.path().string() +
                       ": is a matrix of something else; give another folder, or remove it");
  }
  return files;
}

}  // namespace

void check_array_output(const std::string& output, std::size_t samples) {
  const std::string ending = extension_of(output);
  if (ending.empty() && samples > 1)
    throw InputError(output + ": a folder of files of Matrix Market holds the matrices of one value; found " +
                     std::to_string(samples) + " values: give a name that ends in .npz, .mat or .json");
  if (!ending.empty() && ending != ".npz" && ending != ".mat" && ending != ".json")
    throw InputError(output +
                     ": expected a name that ends in .npz, .mat or .json, or a folder without an ending");
}

std::vector<ArrayFile> array_files(const std::string& output, std::vector<NamedSamples> arrays) {
  arrays.insert(arrays.begin(), {mark, 1, {}, {version()}});
  const std::string ending = extension_of(output);
  if (ending == ".npz") return {{output, ours("archive of NumPy"), npz(arrays)}};
  if (ending == ".mat") return {{output, ours("file of MATLAB"), mat(arrays)}};
  if (ending == ".json") return {{output, ours("file of JSON"), json_text(arrays)}};
  return folder_of(output, arrays);
}

}  // namespace eigentrail::app
