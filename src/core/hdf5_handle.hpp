// Shared by what reads and what writes HDF5: identifiers that are closed automatically, and element types.
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

#include "core/hdf5_types.hpp"

namespace eigentrail {

/// Throws Hdf5Error for the call that failed last, with the innermost reason that HDF5 gives.
[[noreturn]] void fail_hdf5(const std::string& action);

/// Owns an HDF5 identifier and closes it with the given function.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close, const std::string& action) : id_(id), close_(close) {
    if (id < 0) fail_hdf5(action);
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
  if (code < 0) fail_hdf5(action);
}

/// The HDF5 type of an element in memory.
Handle memory_type(ElementType type);

/// The extents of a space; `name` is that of its dataset or attribute.
Shape shape_of(hid_t space, const std::string& name);

}  // namespace eigentrail
