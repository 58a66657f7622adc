#include "import/op4.hpp"

#include <cstdlib>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/scene/limits.hpp"

namespace eigentrail {
namespace {

/// More are a sign of another kind of file.
constexpr long most_rows = 1'000'000'000;

}  // namespace

std::vector<Op4Matrix> parse_op4(std::string_view bytes, const std::string& path, const Op4Choice& wanted) {
  if (bytes.empty()) throw InputError(path + ": is empty");
  // The length of the first record of a binary file has bytes of zero; a text has none.
  const bool binary = bytes.substr(0, 16).find('\0') != std::string_view::npos;
  return binary ? parse_op4_binary(bytes, path, wanted) : parse_op4_text(bytes, path, wanted);
}

void Op4Header::set_rows(long signed_rows) {
  bigmat = signed_rows < 0;
  rows = signed_rows < -most_rows ? 0 : std::abs(signed_rows);
}

Op4Matrix op4_matrix(const Op4Header& header, const Op4Choice& wanted,
                     const std::function<void(const std::string& message)>& fail) {
  if (header.columns < 1 || header.columns > most_rows || header.rows < 1 || header.rows > most_rows ||
      header.type < 1 || header.type > 4 || header.form < 1 || header.form > 15)
    fail("no header of a matrix: expected columns, rows, form and type (1 to 4) as whole numbers");
  Op4Matrix matrix{header.name, {}, header.single(), 17, {}};
  if (header.complex()) {
    matrix.fault = "is complex (type " + std::to_string(header.type) + "); expected real numbers";
  } else if (header.rows != header.columns) {
    matrix.fault = "is " + std::to_string(header.rows) + " x " + std::to_string(header.columns) +
                   "; expected a square matrix";
  } else if (header.form != 1 && header.form != 2 && header.form != 6) {
    matrix.fault = "has form " + std::to_string(header.form) + "; expected 1 (square) or 6 (symmetric)";
  } else if (header.rows > limits::matrix_rows) {
    matrix.fault = "has " + std::to_string(header.rows) + " rows; matrices of up to " +
                   std::to_string(limits::matrix_rows) + " rows can be imported";
  } else if (wanted(header.name)) {
    matrix.values = Matrix::Zero(header.rows, header.columns);
  }
  return matrix;
}

}  // namespace eigentrail
