// The part of HDF5 that eigentrail uses. Identifiers are closed automatically and every return code is
// checked.
#pragma once

#include <complex>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// A failed HDF5 call. The message says what was tried, on which object and in which file.
class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Lets one thread after the other use HDF5 for a whole task. HDF5 has one lock for all files and passes it
/// on at every call: threads that write at the same time without turns wait for each other thousands of
/// times.
class Hdf5Turn {
 public:
  Hdf5Turn();

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

/// Complex numbers are stored as the compound {r, i}, which h5py reads as complex128.
enum class ElementType { real, complex, integer, text };

using Shape = std::vector<std::uint64_t>;

struct DatasetSpec {
  std::string name;
  ElementType type = ElementType::real;
  Shape shape;
  /// All dimensions are unlimited and the data are chunked; elements that were never written read as NaN
  /// (real, complex) or -1 (integer).
  bool growing = false;
  std::map<std::string, std::string> attributes;
};

/// An open HDF5 file. Not thread-safe.
class Hdf5File {
 public:
  /// Creates `path`. Throws Hdf5Error if it exists or cannot be created. Switches HDF5's own printing of
  /// errors off for the whole process; errors are reported by exceptions.
  static Hdf5File create(const std::string& path);
  /// Creates an empty file in memory; `name` is used in messages.
  static Hdf5File in_memory(const std::string& name);
  /// Opens a file in memory for reading and writing, from the bytes `image`. Throws Hdf5Error if they are not
  /// a valid HDF5 file; `name` is used in messages.
  static Hdf5File from_image(const std::string& name, std::string_view image);
  /// Opens `path` for reading. Throws Hdf5Error if it does not exist or is not a valid HDF5 file.
  static Hdf5File open(const std::string& path);

  Hdf5File(Hdf5File&&) noexcept;
  Hdf5File& operator=(Hdf5File&&) noexcept;
  ~Hdf5File();

  void create_dataset(const DatasetSpec& spec);

  /// Extends a growing dataset along one dimension to `size`; new elements read as NaN or -1 until they are
  /// written.
  void extend(const std::string& dataset, unsigned dimension, std::uint64_t size);

  /// Writes whole rows (first index) from `first_row` on and extends the dataset if necessary. Data are
  /// row-major.
  void write_rows(const std::string& dataset, std::uint64_t first_row, const std::vector<double>& data);
  void write_rows(const std::string& dataset, std::uint64_t first_row, const std::vector<Complex>& data);
  void write_rows(const std::string& dataset, std::uint64_t first_row, const std::vector<std::int64_t>& data);
  void write_rows(const std::string& dataset, std::uint64_t first_row, const std::vector<std::string>& data);

  /// Makes a one-dimensional dataset a dimension scale (the coordinates of a dimension); `label` is the name
  /// of the dimension.
  void make_scale(const std::string& dataset, const std::string& label);
  void attach_scale(const std::string& dataset, const std::string& scale, unsigned dimension);

  /// Attributes of the root group; an existing attribute is replaced.
  void set_attribute(const std::string& name, const std::string& value);
  void set_attribute(const std::string& name, double value);
  void set_attribute(const std::string& name, std::int64_t value);

  void flush();

  /// The bytes of the file as they would be on disk.
  std::string image();

  bool has(const std::string& dataset) const;
  /// Names of the members of a group in alphabetical order; "/" is the root group.
  std::vector<std::string> members(const std::string& group) const;
  Shape shape(const std::string& dataset) const;
  /// Throws Hdf5Error for a type that eigentrail does not write.
  ElementType element_type(const std::string& dataset) const;
  std::vector<double> read_real(const std::string& dataset) const;
  std::vector<Complex> read_complex(const std::string& dataset) const;
  /// Reads one row (first index).
  std::vector<Complex> read_complex_row(const std::string& dataset, std::uint64_t row) const;
  std::vector<std::int64_t> read_integers(const std::string& dataset) const;
  std::vector<std::string> read_texts(const std::string& dataset) const;

  bool has_attribute(const std::string& name) const;
  bool is_text_attribute(const std::string& name) const;
  std::string text_attribute(const std::string& name) const;
  double real_attribute(const std::string& name) const;
  std::int64_t integer_attribute(const std::string& name) const;
  /// A text attribute of a dataset; empty if it does not exist.
  std::string text_attribute(const std::string& dataset, const std::string& name) const;
  std::vector<std::string> attribute_names() const;

 private:
  struct Implementation;
  explicit Hdf5File(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

/// Number of elements of a shape, limited to 2^31 + 1 so that large shapes do not overflow.
std::uint64_t element_count(const Shape& shape);

}  // namespace eigentrail
