// Coefficients over one number, from a table, and how far their interpolants may be off: of bearings over the
// speed, of airfoils over the angle of attack.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/scene/expression.hpp"
#include "model/csv_table.hpp"
#include "model/tabulated_factor.hpp"

namespace eigentrail {

struct CoefficientTable {
  std::string path;     ///< of the file
  Expression argument;  ///< SI
  std::shared_ptr<const SamplePiece> piece;
  std::string first_name;  ///< of the argument's column
  std::string first_unit;
  double factor = 1.0;  ///< SI value = factor * value of the argument's column
  std::map<std::string, std::shared_ptr<const TabulatedFactor>> columns;
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

struct KnownColumn {
  std::string name, unit;
};

/// What columns a table may have.
struct TableColumns {
  std::string argument;            ///< what the first column is, in words
  std::string unit;                ///< of the first column; empty: any
  std::vector<KnownColumn> known;  ///< coefficients and their units
  /// Degree of the interpolant, without poles, or that of all rows if they are fewer; absent: degree and
  /// poles with the least leave-one-out errors. These are deceived by functions that are odd or even over
  /// rows that are symmetric: a row that is left out then has a mirror image.
  std::optional<int> degree = std::nullopt;
  /// The interpolant is the function that is meant: no errors between the rows.
  bool exact = false;
};

/// The table in the file that a key of a scene's table names; the first column is the argument, ascending.
/// Throws InputError with the place in the scene, the file, and the line where there is one.
CoefficientTable read_coefficient_table(const Scene& scene, TableReader& table, const std::string& key,
                                        const Expression& argument, const TableColumns& columns);

}  // namespace eigentrail
