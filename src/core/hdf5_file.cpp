#include "core/hdf5_file.hpp"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "core/hdf5_check/check.hpp"

namespace eigentrail {
namespace {

/// An HDF5 identifier with its closing function.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close, const std::string& action) : id_(id), close_(close) {
    if (id < 0) throw Hdf5Error("HDF5 could not " + action);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }  // NOLINT: used wherever HDF5 takes an identifier

 private:
  hid_t id_;
  Close close_;
};

void check(herr_t code, const std::string& action) {
  if (code < 0) throw Hdf5Error("HDF5 could not " + action);
}

/// Errors are reported by our exceptions; HDF5's own stack dump on stderr is switched off.
void silence_error_stack() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  check(H5Tset_size(type, H5T_VARIABLE), "make a text type");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "make a text type");
  return type;
}

/// Before the names of all complex datasets in the order of the alphabet, in which netCDF reads.
constexpr const char* complex_type_name = "complex128";

Handle complex_type() {
  Handle type(H5Tcreate(H5T_COMPOUND, sizeof(Complex)), H5Tclose, "make a complex type");
  check(H5Tinsert(type, "r", 0, H5T_NATIVE_DOUBLE), "make a complex type");
  check(H5Tinsert(type, "i", sizeof(double), H5T_NATIVE_DOUBLE), "make a complex type");
  return type;
}

Handle memory_type(ElementType type) {
  switch (type) {
    case ElementType::complex:
      return complex_type();
    case ElementType::text:
      return text_type();
    case ElementType::integer:
      return {H5Tcopy(H5T_NATIVE_INT64), H5Tclose, "make an integer type"};
    default:
      return {H5Tcopy(H5T_NATIVE_DOUBLE), H5Tclose, "make a real type"};
  }
}

/// The type of a dataset. That of complex numbers has a name in the file: netCDF passes over compounds
/// without one.
Handle stored_type(hid_t file, ElementType type) {
  if (type != ElementType::complex) return memory_type(type);
  const std::string action = "name the type of complex numbers";
  if (H5Lexists(file, complex_type_name, H5P_DEFAULT) > 0)
    return {H5Topen2(file, complex_type_name, H5P_DEFAULT), H5Tclose, action};
  Handle named = complex_type();
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
  write_attribute(object, name, text_type(), &text);
}

/// Rows per chunk for about 16 KiB, at least one: files have some thirty growing datasets, and most are
/// small.
hsize_t chunk_rows(const Shape& shape, std::size_t element_size) {
  std::uint64_t row = element_size;
  for (std::size_t i = 1; i < shape.size(); ++i) row *= shape[i];
  return std::clamp<std::uint64_t>(16384 / std::max<std::uint64_t>(row, 1), 1, 1024);
}

/// Opens an attribute that holds one value; an array would be read past the end of that value.
Handle open_scalar_attribute(hid_t object, const std::string& name) {
  Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "open attribute " + name);
  const Handle space(H5Aget_space(attribute), H5Sclose, "read the shape of attribute " + name);
  if (H5Sget_simple_extent_npoints(space) != 1)
    throw Hdf5Error("HDF5 attribute " + name + " is not a single value");
  return attribute;
}

std::string read_text_attribute(hid_t object, const std::string& name) {
  const Handle attribute = open_scalar_attribute(object, name);
  const Handle stored(H5Aget_type(attribute), H5Tclose, "read the type of attribute " + name);
  if (H5Tget_class(stored) != H5T_STRING || H5Tis_variable_str(stored) <= 0) {
    throw Hdf5Error("HDF5 attribute " + name + " is not a text");
  }
  const Handle type = text_type();
  char* text = nullptr;
  check(H5Aread(attribute, type, &text), "read attribute " + name);
  std::string result = text == nullptr ? "" : text;
  H5free_memory(text);
  return result;
}

template <class Number>
Number read_number_attribute(hid_t object, const std::string& name, hid_t type) {
  const Handle attribute = open_scalar_attribute(object, name);
  const Handle stored(H5Aget_type(attribute), H5Tclose, "read the type of attribute " + name);
  if (H5Tget_class(stored) != H5Tget_class(type))
    throw Hdf5Error("HDF5 attribute " + name + " is of another type");
  Number value{};
  check(H5Aread(attribute, type, &value), "read attribute " + name);
  return value;
}

/// Most elements that are read from one dataset; more is refused before memory is asked for.
constexpr std::uint64_t max_elements = std::uint64_t{1} << 31U;

}  // namespace

struct Hdf5File::Implementation {
  std::string path;
  Handle file;

  Handle dataset(const std::string& name) const {
    return {H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, "open dataset " + name + " of " + path};
  }

  void write(const std::string& name, std::uint64_t first_row, ElementType type, std::size_t count,
             const void* data) {
    if (count == 0) return;
    const std::string action = "write dataset " + name + " of " + path;
    const Handle set = dataset(name);
    std::vector<hsize_t> dims;
    {
      const Handle space(H5Dget_space(set), H5Sclose, action);
      dims.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
      check(H5Sget_simple_extent_dims(space, dims.data(), nullptr), action);
    }
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
    check(H5Dwrite(set, memory_type(type), memory, space, H5P_DEFAULT, data), action);
  }

  Shape shape(const std::string& name) const {
    const Handle set = dataset(name);
    const Handle space(H5Dget_space(set), H5Sclose, "read the shape of " + name);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 0) throw Hdf5Error("HDF5 could not read the shape of " + name);
    std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
    check(H5Sget_simple_extent_dims(space, dims.data(), nullptr), "read the shape of " + name);
    return {dims.begin(), dims.end()};
  }

  std::uint64_t checked_count(const std::string& name) const {
    const std::uint64_t count = element_count(shape(name));
    if (count > max_elements) throw Hdf5Error("dataset " + name + " of " + path + " is too large to read");
    return count;
  }

  template <class Element>
  std::vector<Element> read(const std::string& name, ElementType type) const {
    std::vector<Element> data(checked_count(name));
    if (data.empty()) return data;
    const Handle set = dataset(name);
    check(H5Dread(set, memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()),
          "read dataset " + name + " of " + path);
    return data;
  }

  template <class Element>
  std::vector<Element> read_row(const std::string& name, std::uint64_t row, ElementType type) const {
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
};

Hdf5File::Hdf5File(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;
Hdf5File& Hdf5File::operator=(Hdf5File&&) noexcept = default;
Hdf5File::~Hdf5File() = default;

Hdf5File Hdf5File::create(const std::string& path) {
  silence_error_stack();
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, "create " + path);
  return Hdf5File(std::make_unique<Implementation>(Implementation{path, std::move(file)}));
}

Hdf5File Hdf5File::open(const std::string& path) {
  silence_error_stack();
  try {
    check_hdf5_file(path);
  } catch (const Hdf5Error& error) {
    throw Hdf5Error(path + ": " + error.what());
  }
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open " + path);
  return Hdf5File(std::make_unique<Implementation>(Implementation{path, std::move(file)}));
}

namespace {

/// Properties of a file that never reaches the disk by itself. HDF5 does not bear errors of writing.
Handle memory_access() {
  constexpr std::size_t increment = 1u << 20u;
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make properties of access");
  check(H5Pset_fapl_core(access, increment, false), "keep a file in memory");
  return access;
}

/// HDF5 takes files of one name for one file.
std::string unique_name(const std::string& name) {
  static std::atomic<std::uint64_t> count{0};
  return name + "#" + std::to_string(++count);
}

}  // namespace

Hdf5File Hdf5File::in_memory(const std::string& name) {
  silence_error_stack();
  Handle file(H5Fcreate(unique_name(name).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, memory_access()), H5Fclose,
              "create " + name);
  return Hdf5File(std::make_unique<Implementation>(Implementation{name, std::move(file)}));
}

Hdf5File Hdf5File::from_image(const std::string& name, std::string_view image) {
  silence_error_stack();
  check_hdf5_bytes(image);
  const Handle access = memory_access();
  check(H5Pset_file_image(access, const_cast<char*>(image.data()), image.size()), "take " + name);
  Handle file(H5Fopen(unique_name(name).c_str(), H5F_ACC_RDWR, access), H5Fclose, "open " + name);
  return Hdf5File(std::make_unique<Implementation>(Implementation{name, std::move(file)}));
}

std::string Hdf5File::image() {
  const std::string action = "make an image of " + implementation_->path;
  flush();
  const ssize_t size = H5Fget_file_image(implementation_->file, nullptr, 0);
  if (size < 0) throw Hdf5Error("HDF5 could not " + action);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(implementation_->file, bytes.data(), bytes.size()) != size)
    throw Hdf5Error("HDF5 could not " + action);
  return bytes;
}

void Hdf5File::create_dataset(const DatasetSpec& spec) {
  const std::string action = "create dataset " + spec.name + " of " + implementation_->path;
  std::vector<hsize_t> dims(spec.shape.begin(), spec.shape.end());
  std::vector<hsize_t> limits = dims;
  const Handle type = stored_type(implementation_->file, spec.type);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, action);
  // Without the time of day the same results are the same bytes.
  check(H5Pset_obj_track_times(properties, false), action);
  if (spec.growing) {
    std::fill(limits.begin(), limits.end(), H5S_UNLIMITED);
    std::vector<hsize_t> chunk = dims;
    chunk[0] = chunk_rows(spec.shape, H5Tget_size(type));
    for (hsize_t& c : chunk) c = std::max<hsize_t>(c, 1);
    check(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()), action);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const Complex complex_fill(nan, nan);
    const double real_fill = nan;
    const std::int64_t integer_fill = -1;
    if (spec.type != ElementType::text) {
      const void* fill = spec.type == ElementType::complex   ? static_cast<const void*>(&complex_fill)
                         : spec.type == ElementType::integer ? static_cast<const void*>(&integer_fill)
                                                             : static_cast<const void*>(&real_fill);
      check(H5Pset_fill_value(properties, type, fill), action);
    }
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

void Hdf5File::extend(const std::string& dataset, unsigned dimension, std::uint64_t size) {
  Shape dims = shape(dataset);
  dims.at(dimension) = size;
  const std::vector<hsize_t> extent(dims.begin(), dims.end());
  check(H5Dset_extent(implementation_->dataset(dataset), extent.data()), "extend dataset " + dataset);
}

void Hdf5File::write_rows(const std::string& dataset, std::uint64_t first_row,
                          const std::vector<double>& data) {
  implementation_->write(dataset, first_row, ElementType::real, data.size(), data.data());
}

void Hdf5File::write_rows(const std::string& dataset, std::uint64_t first_row,
                          const std::vector<Complex>& data) {
  implementation_->write(dataset, first_row, ElementType::complex, data.size(), data.data());
}

void Hdf5File::write_rows(const std::string& dataset, std::uint64_t first_row,
                          const std::vector<std::int64_t>& data) {
  implementation_->write(dataset, first_row, ElementType::integer, data.size(), data.data());
}

void Hdf5File::write_rows(const std::string& dataset, std::uint64_t first_row,
                          const std::vector<std::string>& data) {
  std::vector<const char*> texts;
  texts.reserve(data.size());
  for (const std::string& text : data) texts.push_back(text.c_str());
  implementation_->write(dataset, first_row, ElementType::text, texts.size(), texts.data());
}

void Hdf5File::make_scale(const std::string& dataset, const std::string& label) {
  const Handle set = implementation_->dataset(dataset);
  check(H5DSset_scale(set, label.c_str()), "make " + dataset + " a dimension scale");
}

void Hdf5File::attach_scale(const std::string& dataset, const std::string& scale, unsigned dimension) {
  const Handle set = implementation_->dataset(dataset);
  const Handle scale_set = implementation_->dataset(scale);
  check(H5DSattach_scale(set, scale_set, dimension), "attach scale " + scale + " to " + dataset);
}

void Hdf5File::set_attribute(const std::string& name, const std::string& value) {
  write_text_attribute(implementation_->file, name, value);
}
void Hdf5File::set_attribute(const std::string& name, double value) {
  write_attribute(implementation_->file, name, H5T_NATIVE_DOUBLE, &value);
}
void Hdf5File::set_attribute(const std::string& name, std::int64_t value) {
  write_attribute(implementation_->file, name, H5T_NATIVE_INT64, &value);
}

void Hdf5File::flush() {
  check(H5Fflush(implementation_->file, H5F_SCOPE_GLOBAL), "flush " + implementation_->path);
}

bool Hdf5File::has(const std::string& dataset) const {
  // A path exists when every part of it does.
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

Shape Hdf5File::shape(const std::string& dataset) const {
  return implementation_->shape(dataset);
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
  std::vector<char*> raw = implementation_->read<char*>(dataset, ElementType::text);
  std::vector<std::string> texts;
  for (char* text : raw) {
    texts.emplace_back(text == nullptr ? "" : text);
    H5free_memory(text);
  }
  return texts;
}

bool Hdf5File::has_attribute(const std::string& name) const {
  return H5Aexists(implementation_->file, name.c_str()) > 0;
}
std::string Hdf5File::text_attribute(const std::string& name) const {
  return read_text_attribute(implementation_->file, name);
}
double Hdf5File::real_attribute(const std::string& name) const {
  return read_number_attribute<double>(implementation_->file, name, H5T_NATIVE_DOUBLE);
}
std::int64_t Hdf5File::integer_attribute(const std::string& name) const {
  return read_number_attribute<std::int64_t>(implementation_->file, name, H5T_NATIVE_INT64);
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

std::uint64_t element_count(const Shape& shape) {
  std::uint64_t count = 1;
  for (const std::uint64_t dimension : shape) {
    if (dimension != 0 && count > max_elements / dimension) return max_elements + 1;
    count *= dimension;
  }
  return count;
}

}  // namespace eigentrail
