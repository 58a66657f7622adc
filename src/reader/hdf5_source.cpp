#include "reader/hdf5_source.hpp"

#include <hdf5_hl.h>

#include <algorithm>
#include <array>
#include <functional>

namespace eigentrail::reader {
namespace {

Handle opened(const std::string& path_or_bytes, bool is_image) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make properties of access");
  if (is_image) {
    check(H5Pset_fapl_core(access, 1U << 20U, false), "keep a file in memory");
    check(H5Pset_file_image(access, const_cast<char*>(path_or_bytes.data()), path_or_bytes.size()),
          "take a file");
  }
  return {H5Fopen(is_image ? "image" : path_or_bytes.c_str(), H5F_ACC_RDONLY, access), H5Fclose,
          "open it: it is no HDF5 file, or damaged"};
}

/// Nothing for a type that eigentrail does not write.
std::optional<ElementType> type_of(hid_t stored) {
  const H5T_class_t kind = H5Tget_class(stored);
  if (kind == H5T_FLOAT) return ElementType::real;
  if (kind == H5T_INTEGER) return ElementType::integer;
  if (kind == H5T_STRING) return ElementType::text;
  const bool is_complex = kind == H5T_COMPOUND && H5Tget_member_index(stored, "r") == 0 &&
                          H5Tget_member_index(stored, "i") == 1 && H5Tget_nmembers(stored) == 2;
  return is_complex ? std::optional(ElementType::complex) : std::nullopt;
}

/// Fills memory with elements of a given type.
using Read = std::function<herr_t(hid_t, void*)>;

/// Reads texts of fixed length, as MATLAB and NumPy write them, or of variable length, as h5py does. `shape`
/// has the number of texts. Bytes are taken as UTF-8.
std::vector<std::string> read_texts(hid_t stored, hid_t shape, std::size_t count, const Read& read,
                                    const std::string& action) {
  // A memory type of another character set would not be converted.
  const Handle type(H5Tcopy(stored), H5Tclose, action);
  std::vector<std::string> texts;
  if (count == 0) return texts;
  if (H5Tis_variable_str(stored) > 0) {
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

StoredElements read_elements(ElementType type, hid_t stored, hid_t shape, std::size_t count, const Read& read,
                             const std::string& action) {
  if (type == ElementType::text) return read_texts(stored, shape, count, read, action);
  StoredElements numbers = no_elements(type);
  const auto fill = [&](auto& list) {
    list.resize(count);
    if (count > 0) check(read(memory_type(type), list.data()), action);
  };
  std::visit(fill, numbers);
  return numbers;
}

/// Refuses data that are elsewhere or compressed in a way that is not HDF5's own, and shapes far larger than
/// what is stored: a few bytes of damage could otherwise make a reader take all memory. Up to 64 KiB (small
/// empty datasets), or sixteen times what is stored (modes that were added late in a trace), may be
/// unwritten; they read as fill values. What is compressed may unpack to 2 GiB, or sixteen times what is
/// stored.
void check_storage(hid_t set, hid_t space, const Shape& shape, std::size_t element, const std::string& name) {
  const Handle properties(H5Dget_create_plist(set), H5Pclose, "read how " + name + " is stored");
  const H5D_layout_t layout = H5Pget_layout(properties);
  if (layout == H5D_VIRTUAL || H5Pget_external_count(properties) != 0)
    throw Hdf5Error("the data of " + name + " are in another file or dataset; copy them into this one");
  for (int i = 0; i < H5Pget_nfilters(properties); ++i) {
    std::array<char, 64> filter{};
    std::size_t values = 0;
    if (H5Zfilter_avail(H5Pget_filter2(properties, static_cast<unsigned>(i), nullptr, &values, nullptr,
                                       filter.size() - 1, filter.data(), nullptr)) <= 0)
      throw Hdf5Error(name + " is compressed by '" + filter.data() + "'; write it with deflate (gzip)");
  }
  const hsize_t packed = H5Dget_storage_size(set);
  hsize_t stored = packed;
  if (layout == H5D_CHUNKED) {
    std::vector<hsize_t> chunk(shape.size());
    check(H5Pget_chunk(properties, static_cast<int>(chunk.size()), chunk.data()),
          "read the chunks of " + name);
    check(H5Dget_num_chunks(set, space, &stored), "count the chunks of " + name);
    stored *= element * element_count({chunk.begin(), chunk.end()});
  }
  constexpr std::uint64_t unwritten_multiple = 16, unwritten_bytes = 1U << 16U, compressed_bytes = 1U << 31U;
  const std::uint64_t count = element_count(shape);
  const bool unpacks_to_too_much =
      count * element > compressed_bytes && count * element / unwritten_multiple > packed;
  if (count > max_elements || unpacks_to_too_much ||
      count * element / unwritten_multiple > stored + unwritten_bytes / unwritten_multiple)
    throw Hdf5Error(name + " is too large: more elements than the file holds");
}

/// Adds the name of a link or an attribute to a list of names.
constexpr auto collect_name = [](hid_t, const char* name, const auto*, void* list) -> herr_t {
  static_cast<std::vector<std::string>*>(list)->emplace_back(name);
  return 0;
};

constexpr std::uint64_t most_in_attribute = 1U << 16U;

std::optional<StoredArray> read_attribute(hid_t object, const char* name) {
  const std::string action = "read attribute " + std::string(name);
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, action);
  const Handle stored(H5Aget_type(attribute), H5Tclose, action);
  const Handle space(H5Aget_space(attribute), H5Sclose, action);
  const std::optional<ElementType> type = type_of(stored);
  if (!type || *type == ElementType::complex || H5Sget_simple_extent_type(space) == H5S_NULL)
    return std::nullopt;
  Shape shape = shape_of(space, action);
  const std::uint64_t count = element_count(shape);
  if (count > most_in_attribute) throw Hdf5Error("HDF5 could not " + action + ": too large");
  const Read read = [&](hid_t memory, void* to) { return H5Aread(attribute, memory, to); };
  return StoredArray{std::move(shape), read_elements(*type, stored, space, count, read, action)};
}

/// The names of the scales of a dataset's dimensions; fewer than it has dimensions where some have none.
std::vector<std::string> names_of_scales(hid_t set, unsigned rank) {
  std::vector<std::string> names;
  const auto take = [](hid_t, unsigned, hid_t scale, void* list) -> herr_t {
    std::string path(static_cast<std::size_t>(std::max<ssize_t>(H5Iget_name(scale, nullptr, 0), 0)), '\0');
    H5Iget_name(scale, path.data(), path.size() + 1);
    static_cast<std::vector<std::string>*>(list)->push_back(path.substr(path.rfind('/') + 1));
    return 1;  // the first scale only
  };
  for (unsigned i = 0; i < rank; ++i)
    check(H5DSiterate_scales(set, i, nullptr, take, &names), "read the names of the dimensions");
  return names;
}

}  // namespace

Hdf5Source::Hdf5Source(const std::string& path_or_bytes, bool is_image)
    : file_(opened(path_or_bytes, is_image)) {}

bool Hdf5Source::has(const std::string& path) const {
  // A path exists if all its leading parts exist.
  for (std::size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
    if (H5Lexists(file_, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    if (slash == std::string::npos) return true;
  }
}

std::vector<std::string> Hdf5Source::members(const std::string& group) const {
  const Handle handle(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose, "open group " + group);
  std::vector<std::string> names;
  check(H5Literate(handle, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names), "list group " + group);
  return names;
}

/// Null for objects that are no datasets.
const Hdf5Source::Dataset* Hdf5Source::dataset(const std::string& name) {
  if (last_ && last_->name == name) return &*last_;
  last_.reset();
  const std::string action = "open dataset " + name;
  Handle set(H5Oopen(file_, name.c_str(), H5P_DEFAULT), H5Oclose, action);
  if (H5Iget_type(set) != H5I_DATASET) return nullptr;
  Handle stored(H5Dget_type(set), H5Tclose, action);
  Handle space(H5Dget_space(set), H5Sclose, action);
  const std::optional<ElementType> type = type_of(stored);
  if (!type) throw Hdf5Error("dataset " + name + ": expected real or complex numbers, integers or texts");
  Shape shape = shape_of(space, name);
  check_storage(set, space, shape, H5Tget_size(stored), name);
  last_.emplace(Dataset{name, std::move(set), std::move(stored), std::move(space), *type, std::move(shape)});
  return &*last_;
}

std::optional<StoredArray> Hdf5Source::read(const std::string& name, std::uint64_t first,
                                            std::uint64_t rows) {
  const std::string action = "read dataset " + name;
  const Dataset* from = dataset(name);
  if (from == nullptr) return std::nullopt;
  Shape start(from->shape.size(), 0), block = from->shape;
  if (!block.empty()) {
    constexpr std::uint64_t elements_at_once = 1U << 20U;
    const std::uint64_t row = element_count(block) / std::max<std::uint64_t>(block[0], 1);
    start[0] = std::min(first, block[0]);
    const std::uint64_t fitting =
        std::max<std::uint64_t>(elements_at_once / std::max<std::uint64_t>(row, 1), 1);
    block[0] = std::min({rows, fitting, block[0] - start[0]});
  }
  const std::vector<hsize_t> from_row(start.begin(), start.end()), size(block.begin(), block.end());
  if (!size.empty())
    check(H5Sselect_hyperslab(from->space, H5S_SELECT_SET, from_row.data(), nullptr, size.data(), nullptr),
          action);
  const Handle memory(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose,
                      action);
  const Read read = [&](hid_t type, void* to) {
    return H5Dread(from->set, type, memory, from->space, H5P_DEFAULT, to);
  };
  const std::uint64_t count = element_count(block);
  return StoredArray{from->shape, read_elements(from->type, from->stored, memory, count, read, action)};
}

std::map<std::string, StoredArray> Hdf5Source::attributes(const std::string& name) const {
  const Handle object(H5Oopen(file_, name.c_str(), H5P_DEFAULT), H5Oclose, "open " + name);
  std::vector<std::string> names;
  check(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names),
        "list attributes of " + name);
  std::map<std::string, StoredArray> attributes;
  for (const std::string& attribute : names) {
    std::optional<StoredArray> value = read_attribute(object, attribute.c_str());
    if (attribute == "DIMENSION_LIST" && H5Iget_type(object) == H5I_DATASET) {
      const Handle space(H5Dget_space(object), H5Sclose, "read the shape of " + name);
      std::vector<std::string> scales =
          names_of_scales(object, static_cast<unsigned>(shape_of(space, name).size()));
      value = StoredArray{{scales.size()}, std::move(scales)};
    }
    if (value) attributes.emplace(attribute, std::move(*value));
  }
  return attributes;
}

}  // namespace eigentrail::reader
