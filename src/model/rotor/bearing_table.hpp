// Coefficients of a bearing over the speed, from a table, and how far their interpolants may be off.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "eigentrail/scene/expression.hpp"
#include "model/csv_table.hpp"
#include "model/rotor/tabulated_factor.hpp"

namespace eigentrail {

/// A fault of a table; the message names the file, and the line where there is one.
class TableFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct BearingTable {
  Expression argument;  ///< SI
  std::shared_ptr<const SamplePiece> piece;
  std::string first_name;  ///< of the argument's column
  std::string first_unit;
  double factor = 1.0;  ///< SI value = factor * value of the argument's column
  std::vector<std::pair<std::string, std::shared_ptr<const TabulatedFactor>>> columns;
  /// Largest error of a column at a row that is left out, relative to the largest value of the column; NaN
  /// with fewer than four rows.
  double error = 0.0;
  std::string worst;  ///< the column that has it

  std::shared_ptr<const TabulatedFactor> find(const std::string& key) const;
  /// Why the argument (SI) cannot be looked at; empty if it lies within the table.
  std::string outside(double at) const;
  /// "10 rows, speed 0 to 5000 rpm, degree 4; a row that is left out is missed by 2e-5 (kxy) at most"
  std::string in_words() const;
};

/// The first column is the argument, ascending, in `unit` (empty: any) or one of its dimension; all others
/// are coefficients. Throws TableFault.
BearingTable tabulate(const CsvTable& csv, const Expression& argument, const std::string& unit);

}  // namespace eigentrail
