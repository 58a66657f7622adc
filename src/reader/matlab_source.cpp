#include "reader/matlab_source.hpp"

#include <matio.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"

namespace eigentrail::reader {
namespace {

// The elements of files of version 5 (MathWorks, MAT-File Format), checked before libmatio reads them.

constexpr std::size_t tag_bytes = 8;
/// Enough for what stands in front of the numbers of a variable.
constexpr std::size_t beginning_bytes = 1U << 14U;
constexpr std::uint32_t compressed_type = 15, matrix_type = 14;

/// Type, length and content of an element within a variable.
struct Element {
  std::uint32_t type = 0;
  std::size_t length = 0;
  std::string_view content;  ///< as far as it is there
};

/// Goes through the first elements of a variable.
class Elements {
 public:
  Elements(std::string_view bytes, bool swapped) : rest_(bytes), swapped_(swapped) {}

  std::uint32_t word(std::string_view bytes, std::size_t at) const {
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < 4; ++i)
      result = 256 * result + static_cast<unsigned char>(bytes[at + (big_endian() ? i : 3 - i)]);
    return result;
  }

  /// The next element, or nothing where the bytes end. Contents of at most four bytes may stand in the tag.
  std::optional<Element> next() {
    if (rest_.size() < tag_bytes) return std::nullopt;
    const std::uint32_t first = word(rest_, 0);
    const bool in_tag = first >> 16U != 0;
    const Element element{first & 0xFFFFU, in_tag ? first >> 16U : word(rest_, 4),
                          rest_.substr(in_tag ? 4 : tag_bytes)};
    const std::size_t size = in_tag ? tag_bytes : tag_bytes + (element.length + 7) / 8 * 8;
    rest_.remove_prefix(std::min(rest_.size(), size));
    return Element{element.type, element.length, element.content.substr(0, element.length)};
  }

  void skip(std::size_t bytes) { rest_.remove_prefix(std::min(rest_.size(), bytes)); }

 private:
  bool big_endian() const { return swapped_ == (std::endian::native == std::endian::little); }

  std::string_view rest_;
  bool swapped_;
};

/// Bytes of a number of a type; 0 for types that hold no numbers.
std::size_t bytes_of_number(std::uint32_t type) {
  constexpr std::array<std::size_t, 14> sizes{0, 1, 1, 2, 2, 4, 4, 4, 0, 8, 0, 0, 8, 8};
  return type < sizes.size() ? sizes[type] : 0;
}

/// Checks a variable of numbers by its first bytes.
void check_variable(std::string_view bytes, bool swapped) {
  Elements elements(bytes, swapped);
  if (bytes.size() < tag_bytes || elements.word(bytes, 0) != matrix_type) return;
  elements.skip(tag_bytes);
  const auto flags = elements.next(), dimensions = elements.next(), name = elements.next(),
             data = elements.next();
  if (!data || flags->content.size() < 4) return;
  constexpr std::uint32_t first_class = 6, last_class = 15;  // double to uint64
  const std::uint32_t kind = elements.word(flags->content, 0) & 0xFFU;
  const std::size_t size = bytes_of_number(data->type);
  if (kind < first_class || kind > last_class || size == 0) return;
  std::size_t count = 1;
  for (std::size_t at = 0; at + 4 <= dimensions->content.size(); at += 4) {
    const std::size_t extent = elements.word(dimensions->content, at);
    if (extent != 0 && count > limits::matrix_numbers / extent) return;  // refused elsewhere
    count *= extent;
  }
  if (data->length / size >= count) return;
  std::string shown(name->content);
  for (char& c : shown) c = static_cast<unsigned char>(c) < 128 ? c : '?';
  throw std::runtime_error("variable " + printable(shown) + " has " + std::to_string(data->length / size) +
                           " numbers; its dimensions announce " + std::to_string(count));
}

/// The first bytes of what was compressed; fewer if they are damaged.
std::string unpacked(const std::string& bytes) {
  std::string result(beginning_bytes, '\0');
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return "";
  std::string input = bytes;
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  inflate(&stream, Z_SYNC_FLUSH);
  result.resize(result.size() - stream.avail_out);
  inflateEnd(&stream);
  return result;
}

/// libmatio reads a file that is cut short as if it had fewer variables, and fills a variable that has fewer
/// numbers than its dimensions say up with zeros. Throws std::runtime_error for both. Files of other versions
/// pass.
void check_mat_elements(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 128> header{};
  if (!file.read(header.data(), header.size())) return;
  const std::string_view order(header.data() + 126, 2);
  if (order != "IM" && order != "MI") return;  // another version
  const bool swapped = (order == "MI") == (std::endian::native == std::endian::little);
  if (header[swapped ? 124 : 125] != 1) return;
  const std::uintmax_t size = std::filesystem::file_size(path);
  std::uintmax_t at = header.size();
  while (at < size) {
    std::string beginning(static_cast<std::size_t>(std::min<std::uintmax_t>(size - at, beginning_bytes)),
                          '\0');
    file.seekg(static_cast<std::streamoff>(at));
    if (!file.read(beginning.data(), static_cast<std::streamsize>(beginning.size())) ||
        beginning.size() < tag_bytes)
      break;
    const Elements top(beginning, swapped);
    const bool compressed = top.word(beginning, 0) == compressed_type;
    at += tag_bytes + top.word(beginning, 4);
    check_variable(compressed ? unpacked(beginning.substr(tag_bytes)) : beginning, swapped);
  }
  if (at != size) throw std::runtime_error("ends within a variable; it was cut short");
}

using MatFile = std::unique_ptr<mat_t, decltype(&Mat_Close)>;
using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

/// The last message of the library; without a function of ours it would print.
std::string& last_message() {
  static std::string message;
  return message;
}

void keep_message(int /*level*/, char* message) {
  last_message() = message == nullptr ? "" : message;
}

class MatReader {
 public:
  explicit MatReader(const char* path) : file_(nullptr, &Mat_Close) {
    Mat_LogInitFunc("eigentrail", keep_message);
    check_mat_elements(path);
    file_.reset(Mat_Open(path, MAT_ACC_RDONLY));
    if (!file_) fail("is no file of MATLAB (.mat)" + reason());
  }

  std::vector<NamedArray> read() {
    while (const Variable info{Mat_VarReadNextInfo(file_.get()), &Mat_VarFree}) {
      check_size(*info);
      if (info->class_type == MAT_C_FUNCTION || info->class_type == MAT_C_OPAQUE) continue;
      const Variable variable(Mat_VarRead(file_.get(), info->name), &Mat_VarFree);
      if (!variable) fail("variable " + name_of(*info) + " cannot be read" + reason());
      add(*variable, name_of(*info));
    }
    if (!last_message().empty()) fail("is damaged" + reason());
    return std::move(arrays_);
  }

 private:
  [[noreturn]] static void fail(const std::string& message) { throw std::runtime_error(message); }

  static std::string reason() { return last_message().empty() ? "" : ": " + printable(last_message()); }

  /// MATLAB's names are ASCII; anything else comes from damaged files.
  static std::string name_of(const matvar_t& variable) {
    std::string name = variable.name == nullptr ? "" : variable.name;
    for (char& c : name) c = static_cast<unsigned char>(c) < 128 ? c : '?';
    return name;
  }

  static std::vector<std::size_t> shape_of(const matvar_t& variable) {
    return {variable.dims, variable.dims + variable.rank};
  }

  void check_size(const matvar_t& variable) {
    std::size_t count = 1;
    for (const std::size_t extent : shape_of(variable)) {
      if (extent != 0 && count > (limits::matrix_numbers - numbers_) / extent)
        fail("more than " + std::to_string(limits::matrix_numbers) + " numbers in all variables together");
      count *= extent;
    }
    if (variable.class_type != MAT_C_SPARSE) numbers_ += count;
  }

  void add(matvar_t& variable, const std::string& name) {
    switch (variable.class_type) {
      case MAT_C_STRUCT:
        return add_fields(variable);
      case MAT_C_CELL:
        return add_cell(variable, name);
      case MAT_C_CHAR:
        return add_text(variable, name);
      case MAT_C_SPARSE:
        return add_sparse(variable, name);
      default:
        add_numbers(variable, name);
    }
  }

  /// The fields of a structure as variables.
  void add_fields(matvar_t& variable) {
    if (empty_array(variable, "").size() != 1) return;
    const unsigned count = variable.data == nullptr ? 0 : Mat_VarGetNumberOfFields(&variable);
    check_holds(variable, name_of(variable), count, sizeof(matvar_t*));
    char* const* names = Mat_VarGetStructFieldnames(&variable);
    for (unsigned i = 0; i < count && names != nullptr; ++i) {
      matvar_t* field = Mat_VarGetStructFieldByIndex(&variable, i, 0);
      if (field == nullptr || field->data == nullptr || names[i] == nullptr) continue;
      check_size(*field);
      if (field->class_type != MAT_C_STRUCT) add(*field, names[i]);
    }
  }

  static NamedArray empty_array(const matvar_t& variable, const std::string& name) {
    NamedArray array{name, shape_of(variable), {}, {}, {}, false};
    array.set_order(false);
    return array;
  }

  void add_cell(const matvar_t& variable, const std::string& name) {
    NamedArray array = empty_array(variable, name);
    array.is_text = true;
    auto* const* cells = static_cast<matvar_t* const*>(variable.data);
    check_holds(variable, name, array.size(), sizeof(matvar_t*));
    for (std::size_t i = 0; i < array.size(); ++i) {
      if (cells == nullptr || cells[i] == nullptr || cells[i]->class_type != MAT_C_CHAR)
        return;  // other contents
      const std::vector<std::string> lines = text_lines(*cells[i]);
      array.texts.push_back(lines.empty() ? "" : lines.front());
    }
    arrays_.push_back(std::move(array));
  }

  void add_text(const matvar_t& variable, const std::string& name) {
    NamedArray array{name, {}, {}, {}, text_lines(variable), true};
    array.shape = {array.texts.size()};
    array.set_order(false);
    arrays_.push_back(std::move(array));
  }

  /// The rows of a matrix of characters, without the blanks at their ends.
  std::vector<std::string> text_lines(const matvar_t& variable) const {
    if (variable.rank != 2 || variable.data == nullptr) return {};
    const std::size_t rows = variable.dims[0], columns = variable.dims[1];
    check_holds(variable, name_of(variable), rows * columns, Mat_SizeOf(variable.data_type));
    std::vector<std::string> lines(rows);
    for (std::size_t i = 0; i < rows * columns; ++i) add_character(variable, i, lines[i % rows]);
    for (std::string& line : lines) line.erase(line.find_last_not_of(' ') + 1);
    return lines;
  }

  static void add_character(const matvar_t& variable, std::size_t i, std::string& line) {
    if (Mat_SizeOf(variable.data_type) == 1) {
      line += static_cast<const char*>(variable.data)[i];
    } else {
      append_utf8(line, static_cast<std::uint32_t>(number(variable.data_type, variable.data, i)));
    }
  }

  /// The parts of complex numbers are stored apart; imaginary parts must be zero.
  const void* real_part(const matvar_t& variable, const std::string& name, const void* data,
                        std::size_t count) const {
    if (variable.isComplex == 0) return data;
    const auto* parts = static_cast<const mat_complex_split_t*>(data);
    for (std::size_t i = 0; i < count; ++i) {
      if (number(variable.data_type, parts->Im, i) != 0.0)
        fail("variable " + name + " is complex; expected real numbers");
    }
    return parts->Re;
  }

  static double number(matio_types type, const void* data, std::size_t i) {
    const std::size_t bytes = Mat_SizeOf(type);
    std::uint64_t bits = 0;
    std::memcpy(&bits, static_cast<const char*>(data) + i * bytes, bytes);
    const bool is_real = type == MAT_T_DOUBLE || type == MAT_T_SINGLE;
    const bool is_signed =
        type == MAT_T_INT8 || type == MAT_T_INT16 || type == MAT_T_INT32 || type == MAT_T_INT64;
    return stored_number(bits, bytes, is_real ? 'f' : is_signed ? 'i' : 'u');
  }

  /// In damaged files, the type of the elements does not fit the memory that the library has filled.
  void check_holds(const matvar_t& variable, const std::string& name, std::size_t count,
                   std::size_t element) const {
    if (element == 0 || count > variable.nbytes / element) fail("variable " + name + " is damaged");
  }

  void add_numbers(const matvar_t& variable, const std::string& name) {
    const bool known = variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT64;
    NamedArray array = empty_array(variable, name);
    if (!known || (variable.data == nullptr && array.size() > 0)) return;
    check_holds(variable, name, array.size(), Mat_SizeOf(variable.data_type));
    const void* data = real_part(variable, name, variable.data, array.size());
    for (std::size_t i = 0; i < array.size(); ++i)
      array.numbers.push_back(number(variable.data_type, data, i));
    arrays_.push_back(std::move(array));
  }

  void add_sparse(const matvar_t& variable, const std::string& name) {
    const auto* sparse = static_cast<const mat_sparse_t*>(variable.data);
    if (variable.rank != 2) return;
    const std::size_t rows = variable.dims[0], columns = variable.dims[1];
    if (rows > limits::matrix_rows || columns > limits::matrix_rows)
      fail("variable " + name + " has more than " + std::to_string(limits::matrix_rows) + " rows or columns");
    NamedArray array = empty_array(variable, name);
    array.numbers.assign(rows * columns, 0.0);
    if (sparse == nullptr || sparse->njc != columns + 1) fail("variable " + name + " is damaged");
    const void* data = real_part(variable, name, sparse->data, sparse->ndata);
    for (std::size_t c = 0; c < columns; ++c) {
      for (std::size_t k = sparse->jc[c]; k < sparse->jc[c + 1]; ++k) {
        if (k >= sparse->nir || k >= sparse->ndata || sparse->ir[k] >= rows)
          fail("variable " + name + " is damaged");
        array.numbers[c * rows + sparse->ir[k]] = number(variable.data_type, data, k);
      }
    }
    numbers_ += array.numbers.size();
    arrays_.push_back(std::move(array));
  }

  MatFile file_;
  std::size_t numbers_ = 0;
  std::vector<NamedArray> arrays_;
};

}  // namespace

std::vector<NamedArray> read_matlab(const char* path, const std::function<void()>& opened) {
  MatReader reader(path);
  opened();
  return reader.read();
}

}  // namespace eigentrail::reader
