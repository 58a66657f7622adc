#include <algorithm>
#include <cmath>
#include <functional>

#include "core/hdf5_handle.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

/// Largest number of elements that is read from one dataset; larger ones are refused before memory is
/// allocated.
constexpr std::uint64_t max_elements = std::uint64_t{1} << 31U;

/// Opens an attribute that holds a single value. Reading an array into one value would write beyond its
/// memory.
Handle open_scalar_attribute(hid_t object, const std::string& name) {
  Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "open attribute " + name);
  const Handle space(H5Aget_space(attribute), H5Sclose, "read the shape of attribute " + name);
  if (H5Sget_simple_extent_npoints(space) != 1)
    throw Hdf5Error("attribute " + name + ": expected a single value");
  return attribute;
}

/// Reads texts of fixed length, as MATLAB and NumPy write them, or of variable length, as h5py does. `read`
/// fills memory of a given type; `shape` has the number of texts.
std::vector<std::string> read_stored_texts(hid_t stored, hid_t shape, std::size_t count,
                                           const std::function<herr_t(hid_t, void*)>& read,
                                           const std::string& action) {
  if (H5Tget_class(stored) != H5T_STRING) throw Hdf5Error("HDF5 could not " + action + ": it is not a text");
  const htri_t variable = H5Tis_variable_str(stored);
  check(variable, action);
  // A memory type of another character set would not be converted; bytes are taken as UTF-8.
  const Handle type(H5Tcopy(stored), H5Tclose, action);
  std::vector<std::string> texts;
  if (variable > 0) {
    std::vector<char*> raw(count, nullptr);
    check(read(type, raw.data()), action);
    for (const char* text : raw) texts.emplace_back(text == nullptr ? "" : text);
    H5Dvlen_reclaim(type, shape, H5P_DEFAULT, raw.data());
    return texts;
  }
  const std::size_t size = H5Tget_size(stored);
  const bool spaces = H5Tget_strpad(stored) == H5T_STR_SPACEPAD;
  if (size == 0 || count > max_elements / size) throw Hdf5Error("HDF5 could not " + action + ": too large");
  std::vector<char> raw(count * size);
  check(read(type, raw.data()), action);
  for (std::size_t i = 0; i < count; ++i) {
    std::string text(raw.data() + i * size, size);
    text.erase(std::min(text.find('\0'), text.size()));
    if (spaces) text.erase(text.find_last_not_of(' ') + 1);
    texts.push_back(std::move(text));
  }
  return texts;
}

std::string read_text_attribute(hid_t object, const std::string& name) {
  const Handle attribute = open_scalar_attribute(object, name);
  const Handle stored(H5Aget_type(attribute), H5Tclose, "read the type of attribute " + name);
  const Handle space(H5Aget_space(attribute), H5Sclose, "read the shape of attribute " + name);
  if (H5Tget_class(stored) != H5T_STRING) throw Hdf5Error("attribute " + name + ": expected a text");
  const auto read = [&](hid_t type, void* to) { return H5Aread(attribute, type, to); };
  return read_stored_texts(stored, space, 1, read, "read attribute " + name)[0];
}

/// Integers are read as real numbers, too; MATLAB writes every number as a real one.
double read_real_attribute(hid_t object, const std::string& name) {
  const Handle attribute = open_scalar_attribute(object, name);
  const Handle stored(H5Aget_type(attribute), H5Tclose, "read the type of attribute " + name);
  const H5T_class_t kind = H5Tget_class(stored);
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) throw Hdf5Error("attribute " + name + ": expected a number");
  double value = 0.0;
  check(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), "read attribute " + name);
  return value;
}

std::int64_t read_integer_attribute(hid_t object, const std::string& name) {
  const Handle attribute = open_scalar_attribute(object, name);
  const Handle stored(H5Aget_type(attribute), H5Tclose, "read the type of attribute " + name);
  if (H5Tget_class(stored) == H5T_INTEGER) {
    std::int64_t value = 0;
    check(H5Aread(attribute, H5T_NATIVE_INT64, &value), "read attribute " + name);
    return value;
  }
  constexpr double largest = 9007199254740992.0;  // up to here every whole number is a double
  const double value = read_real_attribute(object, name);
  if (!(std::abs(value) <= largest) || value != std::floor(value))
    throw Hdf5Error("attribute " + name + ": expected a whole number, found " + exact_text(value));
  return static_cast<std::int64_t>(value);
}

}  // namespace

std::uint64_t element_count(const Shape& shape) {
  std::uint64_t count = 1;
  for (const std::uint64_t dimension : shape) {
    if (dimension != 0 && count > max_elements / dimension) return max_elements + 1;
    count *= dimension;
  }
  return count;
}

Shape Hdf5File::Implementation::shape(const std::string& name) const {
  const Handle set = dataset(name);
  const Handle space(H5Dget_space(set), H5Sclose, "read the shape of " + name);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0) throw Hdf5Error("HDF5 could not read the shape of " + name);
  std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
  check(H5Sget_simple_extent_dims(space, dims.data(), nullptr), "read the shape of " + name);
  return {dims.begin(), dims.end()};
}

template <class Element>
std::vector<Element> Hdf5File::Implementation::read(const std::string& name, ElementType type) const {
  const std::uint64_t count = element_count(shape(name));
  if (count > max_elements) throw Hdf5Error("dataset " + name + " of " + path + " is too large to read");
  std::vector<Element> data(count);
  if (data.empty()) return data;
  const Handle set = dataset(name);
  check(H5Dread(set, memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()),
        "read dataset " + name + " of " + path);
  return data;
}

template <class Element>
std::vector<Element> Hdf5File::Implementation::read_row(const std::string& name, std::uint64_t row,
                                                        ElementType type) const {
  const std::string action = "read a row of dataset " + name + " of " + path;
  const Shape dims = shape(name);
  if (dims.empty() || row >= dims[0]) throw Hdf5Error(action + ": there is no such row");
  std::vector<hsize_t> start(dims.size(), 0);
  std::vector<hsize_t> block(dims.begin(), dims.end());
  start[0] = row;
  block[0] = 1;
  const std::uint64_t count = element_count({block.begin(), block.end()});
  if (count > max_elements) throw Hdf5Error(action + ": it is too large");
  std::vector<Element> data(count);
  if (data.empty()) return data;
  const Handle set = dataset(name);
  const Handle space(H5Dget_space(set), H5Sclose, action);
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr), action);
  const Handle memory(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr), H5Sclose,
                      action);
  check(H5Dread(set, memory_type(type), memory, space, H5P_DEFAULT, data.data()), action);
  return data;
}

Shape Hdf5File::shape(const std::string& dataset) const {
  return implementation_->shape(dataset);
}

ElementType Hdf5File::element_type(const std::string& dataset) const {
  const Handle set = implementation_->dataset(dataset);
  const Handle type(H5Dget_type(set), H5Tclose, "read the type of " + dataset);
  switch (H5Tget_class(type)) {
    case H5T_FLOAT:
      return ElementType::real;
    case H5T_COMPOUND:
      return ElementType::complex;
    case H5T_INTEGER:
      return ElementType::integer;
    case H5T_STRING:
      return ElementType::text;
    default:
      throw Hdf5Error("dataset " + dataset + ": expected real or complex numbers, integers or texts");
  }
}

bool Hdf5File::has(const std::string& dataset) const {
  // A path exists if all its leading parts exist.
  for (std::size_t slash = dataset.find('/', 1);; slash = dataset.find('/', slash + 1)) {
    if (H5Lexists(implementation_->file, dataset.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    if (slash == std::string::npos) return true;
  }
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
  const Handle handle(H5Gopen2(implementation_->file, group.c_str(), H5P_DEFAULT), H5Gclose,
                      "open group " + group);
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  check(H5Literate(handle, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "list group " + group);
  return names;
}

std::vector<double> Hdf5File::read_real(const std::string& dataset) const {
  return implementation_->read<double>(dataset, ElementType::real);
}

std::vector<Complex> Hdf5File::read_complex(const std::string& dataset) const {
  return implementation_->read<Complex>(dataset, ElementType::complex);
}

std::vector<Complex> Hdf5File::read_complex_row(const std::string& dataset, std::uint64_t row) const {
  return implementation_->read_row<Complex>(dataset, row, ElementType::complex);
}

std::vector<std::int64_t> Hdf5File::read_integers(const std::string& dataset) const {
  return implementation_->read<std::int64_t>(dataset, ElementType::integer);
}

std::vector<std::string> Hdf5File::read_texts(const std::string& dataset) const {
  const std::string action = "read dataset " + dataset + " of " + implementation_->path;
  const std::uint64_t count = element_count(shape(dataset));
  if (count > max_elements) throw Hdf5Error("HDF5 could not " + action + ": too large");
  if (count == 0) return {};
  const Handle set = implementation_->dataset(dataset);
  const Handle stored(H5Dget_type(set), H5Tclose, action);
  const Handle space(H5Dget_space(set), H5Sclose, action);
  const auto read = [&](hid_t type, void* to) {
    return H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, to);
  };
  return read_stored_texts(stored, space, count, read, action);
}

bool Hdf5File::has_attribute(const std::string& name) const {
  return H5Aexists(implementation_->file, name.c_str()) > 0;
}
bool Hdf5File::is_text_attribute(const std::string& name) const {
  const Handle attribute(H5Aopen(implementation_->file, name.c_str(), H5P_DEFAULT), H5Aclose,
                         "open attribute " + name);
  const Handle stored(H5Aget_type(attribute), H5Tclose, "read the type of attribute " + name);
  return H5Tget_class(stored) == H5T_STRING;
}
std::string Hdf5File::text_attribute(const std::string& name) const {
  return read_text_attribute(implementation_->file, name);
}
double Hdf5File::real_attribute(const std::string& name) const {
  return read_real_attribute(implementation_->file, name);
}
std::int64_t Hdf5File::integer_attribute(const std::string& name) const {
  return read_integer_attribute(implementation_->file, name);
}

std::string Hdf5File::text_attribute(const std::string& dataset, const std::string& name) const {
  const Handle set = implementation_->dataset(dataset);
  return H5Aexists(set, name.c_str()) > 0 ? read_text_attribute(set, name) : "";
}

std::vector<std::string> Hdf5File::attribute_names() const {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  check(H5Aiterate2(implementation_->file, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names),
        "list attributes");
  return names;
}

}  // namespace eigentrail
