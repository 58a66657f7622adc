// Opening HDF5 files, on disk and in memory, and the types of their elements.
#include "core/hdf5_file.hpp"

#include <atomic>

#include "core/hdf5_check/check.hpp"
#include "core/hdf5_handle.hpp"

namespace eigentrail {

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

namespace {

/// Errors are reported by exceptions; HDF5's own error messages on stderr are switched off.
void silence_error_stack() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

}  // namespace

namespace {

std::recursive_mutex& turn() {
  static std::recursive_mutex mutex;
  return mutex;
}

}  // namespace

Hdf5Turn::Hdf5Turn() : lock_(turn()) {}

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

/// Access properties of a file that stays in memory and is never written to disk by HDF5, because HDF5 does
/// not recover from write errors. Memory grows in increments of 1 MiB.
Handle memory_access() {
  constexpr std::size_t increment = 1u << 20u;
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make properties of access");
  check(H5Pset_fapl_core(access, increment, false), "keep a file in memory");
  return access;
}

/// HDF5 treats files of equal name as the same file, so every name gets a running number.
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

void Hdf5File::flush() {
  check(H5Fflush(implementation_->file, H5F_SCOPE_GLOBAL), "flush " + implementation_->path);
}

}  // namespace eigentrail
