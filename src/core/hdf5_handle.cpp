#include "core/hdf5_handle.hpp"

namespace eigentrail {
namespace {

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  check(H5Tset_size(type, H5T_VARIABLE), "make a text type");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "make a text type");
  return type;
}

Handle complex_type() {
  Handle type(H5Tcreate(H5T_COMPOUND, sizeof(Complex)), H5Tclose, "make a complex type");
  check(H5Tinsert(type, "r", 0, H5T_NATIVE_DOUBLE), "make a complex type");
  check(H5Tinsert(type, "i", sizeof(double), H5T_NATIVE_DOUBLE), "make a complex type");
  return type;
}

}  // namespace

void fail_hdf5(const std::string& action) {
  std::string reason;
  const auto take = [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
    if (error->desc != nullptr) *static_cast<std::string*>(text) = std::string(": ") + error->desc;
    return 1;  // the innermost only
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take, &reason);
  throw Hdf5Error("HDF5 could not " + action + reason);
}

Handle memory_type(ElementType type) {
  if (type == ElementType::complex) return complex_type();
  if (type == ElementType::text) return text_type();
  return {H5Tcopy(type == ElementType::integer ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE), H5Tclose,
          "make a type of numbers"};
}

Shape shape_of(hid_t space, const std::string& name) {
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0) fail_hdf5("read the shape of " + name);
  std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
  check(H5Sget_simple_extent_dims(space, dims.data(), nullptr), "read the shape of " + name);
  return {dims.begin(), dims.end()};
}

}  // namespace eigentrail
