// Writes complete datasets with the labels that all files of eigentrail have: units, a long name, and a
// dimension scale for every dimension.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "core/hdf5_writer.hpp"

namespace eigentrail {

struct DatasetLabel {
  std::string name;
  std::string units;  ///< "1" if there is none
  std::string long_name;
};

template <class Element>
constexpr ElementType element_type() {
  if constexpr (std::is_same_v<Element, double>) {
    return ElementType::real;
  } else if constexpr (std::is_same_v<Element, Complex>) {
    return ElementType::complex;
  } else if constexpr (std::is_same_v<Element, std::int64_t>) {
    return ElementType::integer;
  } else {
    static_assert(std::is_same_v<Element, std::string>, "no type of HDF5 files");
    return ElementType::text;
  }
}

/// Writes `data` (row-major) over dimensions that exist already; the shape follows from them.
template <class Element>
void write_dataset(Hdf5Writer& file, const DatasetLabel& label, const std::vector<std::string>& dimensions,
                   const std::vector<Element>& data, std::map<std::string, std::string> attributes = {}) {
  Shape shape;
  for (const std::string& dimension : dimensions) shape.push_back(file.shape(dimension)[0]);
  attributes["units"] = label.units;
  attributes["long_name"] = label.long_name;
  file.create_dataset({label.name, element_type<Element>(), shape, data.empty(), attributes});
  if (!data.empty()) file.write_rows(label.name, 0, data);
  for (std::size_t d = 0; d < dimensions.size(); ++d)
    file.attach_scale(label.name, dimensions[d], static_cast<unsigned>(d));
}

/// Writes a one-dimensional dataset and makes it the scale of a dimension of the same name.
template <class Element>
void write_dimension(Hdf5Writer& file, const DatasetLabel& label, const std::vector<Element>& values) {
  file.create_dataset({label.name,
                       element_type<Element>(),
                       {values.size()},
                       values.empty(),
                       {{"units", label.units}, {"long_name", label.long_name}}});
  if (!values.empty()) file.write_rows(label.name, 0, values);
  file.make_scale(label.name, label.name);
}

/// The unit for labels from the declared unit of a parameter, which may be empty.
inline std::string label_unit(const std::string& declared) {
  return declared.empty() ? "1" : declared;
}

}  // namespace eigentrail
