#include "import/market_file.hpp"

#include <array>

#include "core/texts.hpp"
#include "eigentrail/scene/limits.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {
namespace {

enum class Symmetry { none, symmetric, skew };

class MarketReader {
 public:
  MarketReader(std::string_view text, const std::string& path) : lines_(text, path), size_(text.size()) {}

  SystemMatrix read() {
    read_banner();
    read_sizes();
    if (array_) {
      matrix_ = Matrix::Zero(rows_, columns_);
      read_array();
    } else {
      triplets_.reserve(static_cast<std::size_t>(symmetry_ == Symmetry::none ? entries_ : 2 * entries_));
      for (long i = 0; i < entries_; ++i) read_entry(i);
    }
    if (next_line())
      lines_.fail("more lines than the " + std::to_string(entries_) + " entries that are announced");
    if (array_) return std::move(matrix_);
    SparseMatrix sparse(rows_, columns_);
    sparse.setFromTriplets(triplets_.begin(), triplets_.end());
    return sparse;
  }

 private:
  /// "%%MatrixMarket matrix coordinate real general", in any case.
  void read_banner() {
    const auto line = lines_.next();
    const auto words = line ? words_of(*line) : std::vector<std::string_view>();
    if (words.empty() || !equal_words(words[0], "%%MatrixMarket"))
      lines_.fail(
          "expected '%%MatrixMarket matrix ...' on the first line; is this a file of the Matrix Market?");
    if (words.size() != 5 || !equal_words(words[1], "matrix"))
      lines_.fail("expected five words: %%MatrixMarket matrix, coordinate or array, a field, a symmetry");
    array_ = one_of(words[2], {"coordinate", "array"}) == 1;
    const std::size_t field = one_of(words[3], {"real", "double", "integer", "pattern", "complex"});
    pattern_ = field == 3;
    complex_ = field == 4;
    if (pattern_ && array_) lines_.fail("an array cannot be a pattern");
    const std::size_t symmetry = one_of(words[4], {"general", "symmetric", "skew-symmetric", "hermitian"});
    // A Hermitian matrix is symmetric if its imaginary parts are zero, as they must be here.
    symmetry_ = symmetry == 0 ? Symmetry::none : symmetry == 2 ? Symmetry::skew : Symmetry::symmetric;
    if (symmetry == 3 && !complex_) lines_.fail("a matrix that is not complex cannot be hermitian");
    if (pattern_ && symmetry_ == Symmetry::skew) lines_.fail("a pattern cannot be skew-symmetric");
  }

  std::size_t one_of(std::string_view word, const std::vector<std::string>& known) {
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (equal_words(word, known[i])) return i;
    }
    lines_.fail("expected " + enumerated(known, " or ") + ", found " + shown(word));
  }

  /// The next line that is neither empty nor a comment.
  std::optional<std::string_view> next_line() {
    while (const auto line = lines_.next()) {
      const std::string_view content = trimmed(*line);
      if (!content.empty() && content.front() != '%') return content;
    }
    return std::nullopt;
  }

  void read_sizes() {
    const auto line = next_line();
    if (!line) lines_.fail("the file ends before the line with the sizes");
    const auto words = words_of(*line);
    const std::size_t expected = array_ ? 2 : 3;
    if (words.size() != expected)
      lines_.fail("expected " +
                  std::string(array_ ? "rows and columns" : "rows, columns and number of entries") +
                  ", found " + std::to_string(words.size()) + (words.size() == 1 ? " word" : " words"));
    std::array<long, 3> sizes{};
    for (std::size_t i = 0; i < expected; ++i) sizes[i] = lines_.whole(words[i], "expected a size", 0);
    const auto [rows, columns, entries] = sizes;
    const long most = array_ ? limits::matrix_rows : static_cast<long>(limits::sparse_rows);
    if (rows < 1 || columns < 1 || rows > most || columns > most)
      lines_.fail("the matrix is " + std::to_string(rows) + " x " + std::to_string(columns) +
                  "; matrices of 1 to " + std::to_string(most) + " rows and columns can be imported" +
                  (array_ ? ", larger ones as coordinate" : ""));
    if (symmetry_ != Symmetry::none && rows != columns) lines_.fail("a symmetric matrix is square");
    const long half = rows * (rows + (symmetry_ == Symmetry::skew ? -1 : 1)) / 2;
    entries_ = !array_ ? entries : symmetry_ == Symmetry::none ? rows * columns : half;
    // Before memory is taken: each entry needs a line.
    if (static_cast<std::size_t>(entries_) > size_ / 2)
      lines_.fail(std::to_string(entries_) + " entries are announced, more than the file has room for");
    rows_ = rows;
    columns_ = columns;
  }

  /// "row column value"; the value is one in a pattern.
  void read_entry(long i) {
    const auto line = next_line();
    if (!line)
      lines_.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(entries_) +
                  " entries");
    const auto words = words_of(*line);
    const std::size_t expected = pattern_ ? 2 : complex_ ? 4 : 3;
    if (words.size() != expected)
      lines_.fail("expected " + std::to_string(expected) + " numbers, found " + std::to_string(words.size()));
    const long r = index(words[0], rows_, "row"), c = index(words[1], columns_, "column");
    const double value = pattern_ ? 1.0 : real(words[2]);
    if (complex_) check_imaginary(words[3]);
    add(r, c, value);
  }

  long index(std::string_view word, Eigen::Index count, const char* what) {
    const auto number = whole_number_of(word);
    if (!number || *number < 1 || *number > count)
      lines_.fail("expected a " + std::string(what) + " from 1 to " + std::to_string(count) + ", found " +
                  shown(word));
    return *number - 1;
  }

  double real(std::string_view word) { return lines_.number(word, "expected a finite number"); }

  void check_imaginary(std::string_view word) {
    if (real(word) != 0.0) lines_.fail("the matrix is complex; expected real numbers");
  }

  void add(Eigen::Index r, Eigen::Index c, double value) {
    put(r, c, value);
    if (symmetry_ == Symmetry::none) return;
    if (r == c) {
      if (symmetry_ == Symmetry::skew) lines_.fail("a skew-symmetric matrix has no entries on its diagonal");
      return;
    }
    // The format asks for the lower triangle. Some programs write the upper one.
    (r > c ? below_ : above_) = true;
    if (below_ && above_)
      lines_.fail(
          "the file has entries on both sides of the diagonal of a symmetric matrix; expected one side");
    put(c, r, symmetry_ == Symmetry::skew ? -value : value);
  }

  void put(Eigen::Index r, Eigen::Index c, double value) {
    if (array_) {
      matrix_(r, c) = value;
    } else {
      triplets_.emplace_back(r, c, value);
    }
  }

  /// The numbers of an array column by column, of a symmetric one from the diagonal on, of a skew-symmetric
  /// one from below it.
  void read_array() {
    for (Eigen::Index c = 0; c < matrix_.cols(); ++c) {
      const Eigen::Index first = symmetry_ == Symmetry::none ? 0 : symmetry_ == Symmetry::skew ? c + 1 : c;
      for (Eigen::Index r = first; r < matrix_.rows(); ++r) {
        const double value = real(next_word(r, c));
        if (complex_) check_imaginary(next_word(r, c));
        add(r, c, value);
      }
    }
    if (place_ < words_.size()) lines_.fail("more numbers on the line than the matrix has entries");
  }

  std::string_view next_word(Eigen::Index r, Eigen::Index c) {
    while (place_ == words_.size()) {
      const auto line = next_line();
      if (!line)
        lines_.fail("the file ends before row " + std::to_string(r + 1) + " of column " +
                    std::to_string(c + 1));
      words_ = words_of(*line);
      place_ = 0;
    }
    return words_[place_++];
  }

  TextLines lines_;
  std::size_t size_;
  bool array_ = false, pattern_ = false, complex_ = false, below_ = false, above_ = false;
  Symmetry symmetry_ = Symmetry::none;
  long entries_ = 0;
  Eigen::Index rows_ = 0, columns_ = 0;
  Matrix matrix_;                                 ///< of an array
  std::vector<Eigen::Triplet<double>> triplets_;  ///< of coordinates
  std::vector<std::string_view> words_;           ///< of the present line of an array
  std::size_t place_ = 0;
};

}  // namespace

SystemMatrix parse_market_file(std::string_view text, const std::string& path) {
  return MarketReader(text, path).read();
}

}  // namespace eigentrail
