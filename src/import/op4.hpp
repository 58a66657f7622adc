// Matrices of Nastran in files of its module OUTPUT4 (.op4), text or binary (MSC Nastran, DMAP Programmer's
// Guide, OUTPUT4): dense columns, or strings of numbers between zeros, in two variants ("bigmat" and not).
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

struct Op4Matrix {
  std::string name;
  Matrix values;        ///< n x n; empty if the matrix is not wanted or has a fault
  bool single = false;  ///< single precision
  int digits = 17;      ///< as printed
  /// Why the matrix cannot be used: complex, not square, too large.
  std::string fault;
};

/// Says by name which matrices are read; the others are skipped.
using Op4Choice = std::function<bool(const std::string& name)>;

/// All matrices in the bytes of a file. Throws InputError that names file and place.
std::vector<Op4Matrix> parse_op4(std::string_view bytes, const std::string& path, const Op4Choice& wanted);

/// What stands in front of a matrix.
struct Op4Header {
  long columns = 0, rows = 0;
  bool bigmat = false;  ///< strings have length and row as two numbers, not packed into one
  long form = 0, type = 0;
  std::string name;

  /// Takes the number of rows, which is negative in the variant "bigmat".
  void set_rows(long signed_rows);
  bool complex() const { return type > 2; }
  bool single() const { return type == 1 || type == 3; }
};

/// More matrices in a file are a sign of another kind of file.
inline constexpr std::size_t most_op4_matrices = 1000;
/// Numbers that pack length and row of a string into one: length * 65536 + row.
inline constexpr long op4_packing = 65536;

/// The matrix without its values: zero if it can be used and is wanted. Calls `fail`, which throws, if the
/// header makes no sense.
Op4Matrix op4_matrix(const Op4Header& header, const Op4Choice& wanted,
                     const std::function<void(const std::string& message)>& fail);

/// The variants of parse_op4.
std::vector<Op4Matrix> parse_op4_text(std::string_view text, const std::string& path,
                                      const Op4Choice& wanted);
std::vector<Op4Matrix> parse_op4_binary(std::string_view bytes, const std::string& path,
                                        const Op4Choice& wanted);

}  // namespace eigentrail
