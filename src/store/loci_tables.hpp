// The datasets of a loci file that grow during a trace (loci_schema.hpp).
#pragma once

#include <map>
#include <optional>
#include <span>

#include "core/hdf5_writer.hpp"
#include "store/loci_schema.hpp"

namespace eigentrail {

/// Creates the datasets of all dimensions, and those that the model determines, in `file`, which must be
/// empty: for `modes` modes and power series of this order. `motions`: labels of the motions of the model's
/// masses.
void create_dimensions(Hdf5Writer& file, const Model& model, int order, std::size_t modes,
                       const std::vector<std::string>& motions);

/// Creates the datasets over them, and appends rows. Rows of the dimensions `node` and `step` are collected
/// before they are written.
class LociTables {
 public:
  /// For a file that has the dimensions, behind the rows that are written.
  LociTables(Hdf5Writer file, const Model& model, const TraceOptions& options);

  std::size_t modes() const { return sizes_.at("mode"); }

  /// Extends the datasets to more modes, or functions of the dense output. The new elements of existing rows
  /// read as NaN, or -1 for integers.
  void grow_modes(std::size_t wanted);
  void grow_functions(std::size_t wanted);

  /// Begins a row in all datasets along a dimension, `node` or `step`. Its elements are NaN, or -1 for
  /// integers, until they are set.
  void begin_row(const std::string& dimension);

  /// The elements of the row of a dataset that was begun last, row-major.
  template <class Element>
  std::span<Element> row(const std::string& dataset) {
    Column& column = column_called(dataset);
    return std::span(std::get<std::vector<Element>>(column.rows)).last(width(column));
  }

  /// Number of nodes that have been begun and not written.
  std::size_t pending() const { return begun_.at("node"); }
  /// `events`: how many there are, if neither rows nor events come later. Datasets that are created then have
  /// the size they need; others can grow, which takes chunks of space.
  void write_rows(std::optional<std::size_t> events = {});

  Hdf5Writer& file() { return file_; }

 private:
  /// A dataset and its rows that are not written yet.
  struct Column {
    LociDataset dataset;
    StoredElements rows;
  };

  Column& column_called(const std::string& dataset);
  std::size_t width(const Column& column) const;  ///< elements of a row
  void create_columns(std::optional<std::size_t> events);
  template <class Label>
  void grow(const std::string& dimension, const std::vector<Label>& added);

  Hdf5Writer file_;
  std::vector<Column> columns_;
  std::map<std::string, std::size_t> sizes_;                            ///< per dimension, as written
  std::map<std::string, std::size_t> begun_{{"node", 0}, {"step", 0}};  ///< rows that are not written
};

}  // namespace eigentrail
