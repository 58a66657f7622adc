// Datasets as a whole. They are written with the labels that all files of eigentrail have: units, a long
// name, and a dimension scale for every dimension.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/hdf5_file.hpp"
#include "core/hdf5_writer.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

struct DatasetLabel {
  std::string name;
  std::string units;  ///< "1" if there is none
  std::string long_name;
};

/// Creates a dataset over dimensions that exist already; its shape follows from them. `growing`: it may be
/// extended later.
void create_dataset(Hdf5Writer& file, const DatasetLabel& label, ElementType type,
                    const std::vector<std::string>& dimensions, bool growing,
                    std::map<std::string, std::string> attributes);

/// Writes `data` (row-major) as such a dataset.
template <class Element>
void write_dataset(Hdf5Writer& file, const DatasetLabel& label, const std::vector<std::string>& dimensions,
                   const std::vector<Element>& data, std::map<std::string, std::string> attributes = {}) {
  create_dataset(file, label, element_type<Element>(), dimensions, data.empty(), std::move(attributes));
  file.write_rows(label.name, 0, data);
}

/// Writes a one-dimensional dataset and makes it the scale of a dimension of the same name. `growing`: it may
/// be extended later.
template <class Element>
void write_dimension(Hdf5Writer& file, const DatasetLabel& label, const std::vector<Element>& values,
                     bool growing = false) {
  file.create_dataset({label.name,
                       element_type<Element>(),
                       {values.size()},
                       growing || values.empty(),
                       {{"units", label.units}, {"long_name", label.long_name}}});
  file.write_rows(label.name, 0, values);
  file.make_scale(label.name, label.name);
}

/// `count` numbers from `first` on, the labels of a dimension without others.
std::vector<std::int64_t> counted(std::size_t count, std::size_t first = 0);

/// What a dataset holds of a value: whole numbers have 64 bits, and of vectors it holds the elements.
template <class Value>
auto element_of(const Value& value) {
  if constexpr (std::is_integral_v<Value>) {
    return std::int64_t{};
  } else if constexpr (std::is_convertible_v<Value, std::string>) {
    return std::string();
  } else if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, Complex>) {
    return Value{};
  } else {
    return element_of(*value.begin());
  }
}

/// What `field`, a member or a function, gives of every record, one after the other.
template <class Record, class Field>
auto column_of(std::span<const Record> records, Field field) {
  using Given = std::decay_t<std::invoke_result_t<Field, const Record&>>;
  using Element = decltype(element_of(std::declval<Given>()));
  std::vector<Element> column;
  for (const Record& record : records) {
    const Given value = std::invoke(field, record);
    if constexpr (std::is_convertible_v<Given, Element>) {
      column.push_back(static_cast<Element>(value));
    } else {
      for (const auto& element : value) column.push_back(static_cast<Element>(element));
    }
  }
  return column;
}

/// Writes a dataset with a row per record.
template <class Record, class Field>
void write_column(Hdf5Writer& file, const DatasetLabel& label, const std::vector<std::string>& dimensions,
                  const std::vector<Record>& records, Field field,
                  std::map<std::string, std::string> attributes = {}) {
  write_dataset(file, label, dimensions, column_of(std::span<const Record>(records), field),
                std::move(attributes));
}

/// The entries of a matrix, row by row.
template <class Scalar>
std::vector<Scalar> row_major(const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& matrix) {
  const auto entries = matrix.transpose().reshaped();
  return {entries.begin(), entries.end()};
}

/// A dataset of this size. Throws Hdf5Error if it has another one.
template <class Scalar = double>
Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> read_matrix(const Hdf5File& file,
                                                                  const std::string& name, std::size_t rows,
                                                                  std::size_t columns) {
  file.require_fit(file.shape(name) == Shape{rows, columns}, name);
  std::vector<Scalar> data;
  if (rows * columns > 0) {
    if constexpr (std::is_same_v<Scalar, double>)
      data = file.read_real(name);
    else
      data = file.read_complex(name);
  }
  using RowMajor = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return RowMajor::Map(data.data(), static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
}

/// Parameters of a plane with names that no scene can give: with a blank.
std::pair<Parameter, Parameter> parameters_of_other_names();

/// Throws InputError if one of these parameters has the name of a dataset of `written`, a file in which they
/// have other names. `of` and `file` are for the message: "plane", "the boundary file".
void require_other_names(const Scene& scene, const std::vector<std::string>& parameters,
                         const Hdf5Writer& written, const std::string& of, const std::string& file);

/// The unit for labels from the declared unit of a parameter, which may be empty.
inline std::string label_unit(const std::string& declared) {
  return declared.empty() ? "1" : declared;
}

}  // namespace eigentrail
