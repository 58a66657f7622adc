// OUTPUT4 in binary form: records of Fortran with their length in front and behind. Words have 4 bytes, or 8
// in files of programs that count in 64 bits.
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "import/op4.hpp"

namespace eigentrail {
namespace {

constexpr std::size_t marker_bytes = 4;
constexpr std::size_t header_words = 6;  // four numbers and the name

class Op4BinaryReader {
 public:
  Op4BinaryReader(std::string_view bytes, const std::string& path, const Op4Choice& wanted)
      : rest_(bytes), path_(path), wanted_(wanted) {
    find_order();
  }

  std::vector<Op4Matrix> read() {
    while (!rest_.empty()) {
      if (matrices_.size() == most_op4_matrices)
        fail("more than " + std::to_string(most_op4_matrices) + " matrices");
      read_header(record());
      while (read_column(record())) {
      }
    }
    return std::move(matrices_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    std::string where = path_ + ": ";
    if (!header_.name.empty()) where += "matrix " + printable(header_.name) + ", ";
    if (last_column_ > 0) where += "column " + std::to_string(last_column_) + ": ";
    throw InputError(where + message);
  }

  /// The order of the bytes and the size of words, from the length of the first record.
  void find_order() {
    if (rest_.size() < marker_bytes) fail("ends within its first record; it was cut short");
    for (const bool swapped : {false, true}) {
      swapped_ = swapped;
      const auto length = static_cast<std::size_t>(number<std::uint32_t>(rest_.substr(0, marker_bytes)));
      for (const std::size_t word : {std::size_t{4}, std::size_t{8}}) {
        word_ = word;
        if (length == header_words * word) return;
      }
    }
    fail("is no file of Nastran's OUTPUT4: expected text, or a first record of 24 or 48 bytes");
  }

  template <class T>
  T number(std::string_view bytes) const {
    std::array<char, sizeof(T)> copy{};
    std::copy_n(bytes.begin(), sizeof(T), copy.begin());
    if (swapped_) std::reverse(copy.begin(), copy.end());
    return std::bit_cast<T>(copy);
  }

  /// The content of the next record.
  std::string_view record() {
    const auto length = [this](std::size_t at) {
      return static_cast<std::size_t>(number<std::uint32_t>(rest_.substr(at, marker_bytes)));
    };
    if (rest_.size() < marker_bytes) fail("the file ends between two records; it was cut short");
    const std::size_t size = length(0);
    if (rest_.size() - marker_bytes < size || rest_.size() - marker_bytes - size < marker_bytes)
      fail("the file ends within a record of " + std::to_string(size) + " bytes; it was cut short");
    if (length(marker_bytes + size) != size)
      fail("a record has the length " + std::to_string(size) + " in front and another one behind");
    const std::string_view content = rest_.substr(marker_bytes, size);
    rest_.remove_prefix(size + 2 * marker_bytes);
    return content;
  }

  /// The whole number in word i.
  std::int64_t whole(std::string_view content, std::size_t i) const {
    if (i >= content.size() / word_) fail("a record ends too early");
    const std::string_view bytes = content.substr(i * word_, word_);
    return word_ == 4 ? number<std::int32_t>(bytes) : number<std::int64_t>(bytes);
  }

  void read_header(std::string_view content) {
    header_ = {};
    last_column_ = 0;
    if (content.size() != header_words * word_)
      fail("expected the header of a matrix, a record of " + std::to_string(header_words * word_) +
           " bytes; found " + std::to_string(content.size()));
    header_.columns = whole(content, 0);
    header_.set_rows(whole(content, 1));
    header_.form = whole(content, 2);
    header_.type = whole(content, 3);
    for (const char c : content.substr(4 * word_)) {
      if (c != ' ' && c != '\0')
        header_.name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    matrices_.push_back(op4_matrix(header_, wanted_, [this](const std::string& why) { fail(why); }));
  }

  /// Column, first row and number of words, then the numbers. Returns whether there are more: the last column
  /// is one beyond those of the matrix.
  bool read_column(std::string_view content) {
    const std::int64_t column = whole(content, 0), row = whole(content, 1), words = whole(content, 2);
    if (column <= last_column_ || column > header_.columns + 1)
      fail("a record of column " + std::to_string(column) + " of " + std::to_string(header_.columns) +
           " follows");
    last_column_ = static_cast<long>(column);
    const std::string_view data = content.substr(3 * word_);
    if (row < 0 || words < 0 || static_cast<std::uint64_t>(words) > data.size() / word_)
      fail("expected row and number of words, and as many words; found row " + std::to_string(row) + ", " +
           std::to_string(words) + " words announced and " + std::to_string(data.size() / word_) + " there");
    if (column == header_.columns + 1) return false;
    const std::string_view announced = data.substr(0, static_cast<std::size_t>(words) * word_);
    if (row > 0) {
      read_numbers(announced, row);
    } else {
      read_strings(announced);
    }
    return true;
  }

  /// Strings of numbers with their length in words and their first row in front.
  void read_strings(std::string_view data) {
    while (!data.empty()) {
      const std::int64_t first = whole(data, 0);
      const std::int64_t length = header_.bigmat ? first : first / op4_packing;
      const std::int64_t row = header_.bigmat ? whole(data, 1) : first % op4_packing;
      const std::size_t in_front = header_.bigmat ? 2 : 1;
      const std::size_t room = data.size() / word_ - in_front;
      if (length < 2 || row < 1 || static_cast<std::uint64_t>(length - 1) > room)
        fail("expected the length and the first row of a string of numbers");
      const auto size = static_cast<std::size_t>(length - 1) * word_;
      read_numbers(data.substr(in_front * word_, size), row);
      data.remove_prefix(in_front * word_ + size);
    }
  }

  void read_numbers(std::string_view data, std::int64_t row) {
    const std::size_t bytes = header_.single() ? word_ : 8;
    const auto count = static_cast<std::int64_t>(data.size() / bytes);
    const std::int64_t per_entry = header_.complex() ? 2 : 1;
    if (data.size() % bytes != 0) fail("a number has one word only; expected two");
    if (row > header_.rows || count > (header_.rows - row + 1) * per_entry)
      fail(std::to_string(count) + " numbers from row " + std::to_string(row) + " on; the matrix has " +
           std::to_string(header_.rows) + " rows");
    Matrix& values = matrices_.back().values;
    if (values.size() == 0) return;
    for (std::int64_t i = 0; i < count; ++i) {
      const std::string_view one = data.substr(static_cast<std::size_t>(i) * bytes, bytes);
      const double value = bytes == 4 ? static_cast<double>(number<float>(one)) : number<double>(one);
      if (!std::isfinite(value)) fail("row " + std::to_string(row + i) + " is not finite");
      values(row - 1 + i, last_column_ - 1) = value;
    }
  }

  std::string_view rest_;
  const std::string& path_;
  const Op4Choice& wanted_;
  bool swapped_ = false;
  std::size_t word_ = 4;
  std::vector<Op4Matrix> matrices_;
  Op4Header header_;  ///< of the present matrix
  long last_column_ = 0;
};

}  // namespace

std::vector<Op4Matrix> parse_op4_binary(std::string_view bytes, const std::string& path,
                                        const Op4Choice& wanted) {
  return Op4BinaryReader(bytes, path, wanted).read();
}

}  // namespace eigentrail
