// Shared by reading and writing of HDF5 files: identifiers that are closed automatically, and element types.
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

#include "core/hdf5_file.hpp"

namespace eigentrail {

/// Owns an HDF5 identifier and closes it with the given function.
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

/// Throws Hdf5Error if a call returned a negative (error) code.
inline void check(herr_t code, const std::string& action) {
  if (code < 0) throw Hdf5Error("HDF5 could not " + action);
}

Handle text_type();
Handle complex_type();
/// The HDF5 type of an element in memory.
Handle memory_type(ElementType type);

struct Hdf5File::Implementation {
  std::string path;
  Handle file;

  Handle dataset(const std::string& name) const {
    return {H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, "open dataset " + name + " of " + path};
  }

  /// Writes `count` elements, a whole number of rows, from `first_row` on; extends the dataset if necessary.
  void write(const std::string& name, std::uint64_t first_row, ElementType type, std::size_t count,
             const void* data);

  Shape shape(const std::string& name) const;

  /// Reads all elements, or those of one row.
  template <class Element>
  std::vector<Element> read(const std::string& name, ElementType type) const;
  template <class Element>
  std::vector<Element> read_row(const std::string& name, std::uint64_t row, ElementType type) const;
};

}  // namespace eigentrail
