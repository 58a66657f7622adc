#include "core/hdf5_writer.hpp"

#include <hdf5_hl.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <span>

#include "core/hdf5_handle.hpp"

namespace eigentrail {

struct Hdf5Writer::Implementation {
  std::string path;
  Handle file;
  mutable std::map<std::string, Handle> open = {};  ///< datasets that have been used

  hid_t dataset(const std::string& name) const {
    const auto known = open.find(name);
    if (known != open.end()) return known->second;
    Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, "open dataset " + name + " of " + path);
    return open.emplace(name, std::move(set)).first->second;
  }
};

namespace {

/// Errors are reported by exceptions; HDF5's own error messages on stderr are switched off.
void silence_error_stack() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

std::recursive_mutex& turn() {
  static std::recursive_mutex mutex;
  return mutex;
}

/// Access properties of a file that stays in memory and is never written to disk by HDF5, because HDF5 does
/// not recover from write errors. Memory grows in increments of 64 KiB.
Handle memory_access() {
  constexpr std::size_t increment = 1u << 16u;
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make properties of access");
  check(H5Pset_fapl_core(access, increment, false), "keep a file in memory");
  return access;
}

/// Properties of a new file: nodes of the index of a dataset's chunks have eight entries at most, not 64.
/// Each dataset has one of them at least, which would take more space than the values of a short trace.
Handle small_indices() {
  constexpr unsigned half_of_entries = 4;
  Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "make properties of a file");
  check(H5Pset_istore_k(creation, half_of_entries), "set the size of indices");
  return creation;
}

/// Properties of a transfer that converts elements in pieces of this size: HDF5 clears the whole buffer, by
/// default of 1 MiB, at every write of texts.
hid_t small_buffer() {
  static const Handle properties = [] {
    constexpr std::size_t bytes = 4096;
    Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose, "make properties of a transfer");
    check(H5Pset_buffer(transfer, bytes, nullptr, nullptr), "set the buffer of a transfer");
    return transfer;
  }();
  return properties;
}

/// HDF5 treats files of equal name as the same file, so every name gets a running number.
std::string unique_name(const std::string& name) {
  static std::atomic<std::uint64_t> count{0};
  return name + "#" + std::to_string(++count);
}

/// netCDF reads objects in alphabetical order. This name precedes those of all complex datasets, so netCDF
/// knows the type before it reads them.
constexpr const char* complex_type_name = "complex128";

/// The type of a dataset in the file. The complex type is stored as a named type, because netCDF ignores
/// datasets whose compound type has no name.
Handle stored_type(hid_t file, ElementType type) {
  if (type != ElementType::complex) return memory_type(type);
  const std::string action = "name the type of complex numbers";
  if (H5Lexists(file, complex_type_name, H5P_DEFAULT) > 0)
    return {H5Topen2(file, complex_type_name, H5P_DEFAULT), H5Tclose, action};
  Handle named = memory_type(type);
  const Handle properties(H5Pcreate(H5P_DATATYPE_CREATE), H5Pclose, action);
  check(H5Pset_obj_track_times(properties, false), action);
  check(H5Tcommit2(file, complex_type_name, named, H5P_DEFAULT, properties, H5P_DEFAULT), action);
  return named;
}

void write_attribute(hid_t object, const std::string& name, hid_t type, const void* value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "make a scalar space");
  if (H5Aexists(object, name.c_str()) > 0)
    check(H5Adelete(object, name.c_str()), "replace attribute " + name);
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "create attribute " + name);
  check(H5Awrite(attribute, type, value), "write attribute " + name);
}

void write_text_attribute(hid_t object, const std::string& name, const std::string& value) {
  const char* text = value.c_str();
  write_attribute(object, name, memory_type(ElementType::text), &text);
}

/// Rows per chunk: about 1 KiB, at least one. Files have about thirty growing datasets, most of them of few
/// rows, and each takes a whole chunk.
hsize_t chunk_rows(const Shape& shape, std::size_t element_size) {
  std::uint64_t row = element_size;
  for (std::size_t i = 1; i < shape.size(); ++i) row *= shape[i];
  return std::max<std::uint64_t>(1024 / std::max<std::uint64_t>(row, 1), 1);
}

}  // namespace

Hdf5Turn::Hdf5Turn() : lock_(turn()) {}

Hdf5Writer::Hdf5Writer(Implementation implementation)
    : implementation_(std::make_shared<const Implementation>(std::move(implementation))) {}

Hdf5Writer Hdf5Writer::create(const std::string& path) {
  silence_error_stack();
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_EXCL, small_indices(), H5P_DEFAULT), H5Fclose,
              "create " + path);
  return Hdf5Writer({path, std::move(file)});
}

Hdf5Writer Hdf5Writer::in_memory(const std::string& name) {
  silence_error_stack();
  Handle file(H5Fcreate(unique_name(name).c_str(), H5F_ACC_TRUNC, small_indices(), memory_access()), H5Fclose,
              "create " + name);
  return Hdf5Writer({name, std::move(file)});
}

Hdf5Writer Hdf5Writer::from_image(const std::string& name, std::string_view image) {
  silence_error_stack();
  const Handle access = memory_access();
  check(H5Pset_file_image(access, const_cast<char*>(image.data()), image.size()), "take " + name);
  Handle file(H5Fopen(unique_name(name).c_str(), H5F_ACC_RDWR, access), H5Fclose, "open " + name);
  return Hdf5Writer({name, std::move(file)});
}

std::string Hdf5Writer::image() {
  const std::string action = "make an image of " + implementation_->path;
  flush();
  const ssize_t size = H5Fget_file_image(implementation_->file, nullptr, 0);
  if (size < 0) throw Hdf5Error("HDF5 could not " + action);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(implementation_->file, bytes.data(), bytes.size()) != size)
    throw Hdf5Error("HDF5 could not " + action);
  return bytes;
}

void Hdf5Writer::flush() {
  check(H5Fflush(implementation_->file, H5F_SCOPE_GLOBAL), "flush " + implementation_->path);
}

/// `count` elements, a whole number of rows.
void Hdf5Writer::write(const std::string& name, std::uint64_t first_row, ElementType type, std::size_t count,
                       const void* data) {
  if (count == 0) return;
  const std::string action = "write dataset " + name + " of " + implementation_->path;
  std::vector<const char*> texts;
  if (type == ElementType::text) {
    for (const std::string& text : std::span(static_cast<const std::string*>(data), count))
      texts.push_back(text.c_str());
    data = texts.data();
  }
  const hid_t set = implementation_->dataset(name);
  const Shape found = shape(name);
  std::vector<hsize_t> dims(found.begin(), found.end());
  hsize_t row = 1;
  for (std::size_t i = 1; i < dims.size(); ++i) row *= dims[i];
  if (row == 0 || count % row != 0) throw Hdf5Error(action + ": the data are no whole number of rows");
  std::vector<hsize_t> start(dims.size(), 0);
  std::vector<hsize_t> block = dims;
  start[0] = first_row;
  block[0] = count / row;
  if (start[0] + block[0] > dims[0]) {
    dims[0] = start[0] + block[0];
    check(H5Dset_extent(set, dims.data()), action);
  }
  const Handle space(H5Dget_space(set), H5Sclose, action);
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr), action);
  const Handle memory(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr), H5Sclose,
                      action);
  check(H5Dwrite(set, memory_type(type), memory, space, small_buffer(), data), action);
}

void Hdf5Writer::create_dataset(const DatasetSpec& spec) {
  const std::string action = "create dataset " + spec.name + " of " + implementation_->path;
  std::vector<hsize_t> dims(spec.shape.begin(), spec.shape.end());
  std::vector<hsize_t> limits = dims;
  const Handle type = stored_type(implementation_->file, spec.type);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, action);
  // Without time stamps, equal results give equal bytes.
  check(H5Pset_obj_track_times(properties, false), action);
  if (spec.growing) {
    std::fill(limits.begin(), limits.end(), H5S_UNLIMITED);
    std::vector<hsize_t> chunk = dims;
    chunk[0] = chunk_rows(spec.shape, H5Tget_size(type));
    for (hsize_t& c : chunk) c = std::max<hsize_t>(c, 1);
    check(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()), action);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const Complex not_known(nan, nan);
    const std::int64_t none = -1;
    const void* fill = &not_known;  // its first number is that of real elements
    if (spec.type == ElementType::integer) fill = &none;
    if (spec.type != ElementType::text) check(H5Pset_fill_value(properties, type, fill), action);
  }
  const Handle space(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), limits.data()), H5Sclose,
                     action);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, action);
  check(H5Pset_create_intermediate_group(links, 1), action);
  const Handle set(
      H5Dcreate2(implementation_->file, spec.name.c_str(), type, space, links, properties, H5P_DEFAULT),
      H5Dclose, action);
  for (const auto& [name, value] : spec.attributes) write_text_attribute(set, name, value);
}

void Hdf5Writer::extend(const std::string& dataset, unsigned dimension, std::uint64_t size) {
  Shape dims = shape(dataset);
  dims.at(dimension) = size;
  const std::vector<hsize_t> extent(dims.begin(), dims.end());
  check(H5Dset_extent(implementation_->dataset(dataset), extent.data()), "extend dataset " + dataset);
}

void Hdf5Writer::make_scale(const std::string& dataset, const std::string& label) {
  const hid_t set = implementation_->dataset(dataset);
  check(H5DSset_scale(set, label.c_str()), "make " + dataset + " a dimension scale");
}

void Hdf5Writer::attach_scale(const std::string& dataset, const std::string& scale, unsigned dimension) {
  const hid_t set = implementation_->dataset(dataset);
  const hid_t scale_set = implementation_->dataset(scale);
  check(H5DSattach_scale(set, scale_set, dimension), "attach scale " + scale + " to " + dataset);
}

void Hdf5Writer::set_attribute(const std::string& name, const std::string& value) {
  write_text_attribute(implementation_->file, name, value);
}
void Hdf5Writer::set_attribute(const std::string& name, double value) {
  write_attribute(implementation_->file, name, H5T_NATIVE_DOUBLE, &value);
}
void Hdf5Writer::set_integer(const std::string& name, std::int64_t value) {
  write_attribute(implementation_->file, name, H5T_NATIVE_INT64, &value);
}

bool Hdf5Writer::has(const std::string& dataset) const {
  return H5Lexists(implementation_->file, dataset.c_str(), H5P_DEFAULT) > 0;
}

Shape Hdf5Writer::shape(const std::string& dataset) const {
  const hid_t set = implementation_->dataset(dataset);
  return shape_of(Handle(H5Dget_space(set), H5Sclose, "read the shape of " + dataset), dataset);
}

}  // namespace eigentrail
