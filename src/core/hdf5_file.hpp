// The part of HDF5 that eigentrail uses, with handles that close themselves and every return code checked.
#pragma once

#include <complex>
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// An HDF5 call that failed: what was tried, on which object, in which file.
class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Complex numbers are the compound {r, i} that h5py reads as complex128.
enum class ElementType { real, complex, integer, text };

using Shape = std::vector<std::uint64_t>;

struct DatasetSpec {
  std::string name;
  ElementType type = ElementType::real;
  Shape shape;
  bool growing = false;  ///< all dimensions are unlimited; the data are chunked; what was never written reads
                         ///< as NaN (numbers) or -1 (integers)
  std::map<std::string, std::string> attributes;
};

/// An open HDF5 file. Not thread-safe.
class Hdf5File {
 public:
  /// Creates `path`; throws Hdf5Error when it exists already or cannot be created. Switches off, for the
  /// whole process, HDF5's own printing of errors: they are reported by exceptions.
  static Hdf5File create(const std::string& path);
  /// Begins a file in memory; `name` is for messages.
  static Hdf5File in_memory(const std::string& name);
  /// Goes on with one, in memory, from its bytes. Throws Hdf5Error when they are none.
  static Hdf5File from_image(const std::string& name, std::string_view image);
  /// Opens `path` for reading. Throws Hdf5Error when it is missing or no HDF5 file.
  static Hdf5File open(const std::string& path);

  Hdf5File(Hdf5File&&) noexcept;
  Hdf5File& operator=(Hdf5File&&) noexcept;
  ~Hdf5File();

  void create_dataset(const DatasetSpec& spec);

  /// Makes a growing dataset longer along one dimension; what is new reads as NaN or -1 until it is written.
  void extend(const std::string& dataset, unsigned dimension, std::uint64_t size);

  /// Writes whole rows (first index) from `first_row` on, growing the dataset when it must. Data are
  /// row-major.
  void write_rows(const std::string& dataset, std::uint64_t first_row, const std::vector<double>& data);
  void write_rows(const std::string& dataset, std::uint64_t first_row, const std::vector<Complex>& data);
  void write_rows(const std::string& dataset, std::uint64_t first_row, const std::vector<std::int64_t>& data);
  void write_rows(const std::string& dataset, std::uint64_t first_row, const std::vector<std::string>& data);

  /// Makes a one-dimensional dataset the scale of a dimension; `label` is the dimension's name.
  void make_scale(const std::string& dataset, const std::string& label);
  void attach_scale(const std::string& dataset, const std::string& scale, unsigned dimension);

  /// Root attributes.
  void set_attribute(const std::string& name, const std::string& value);
  void set_attribute(const std::string& name, double value);
  void set_attribute(const std::string& name, std::int64_t value);

  void flush();

  /// The bytes of the file as it would be on disk.
  std::string image();

  bool has(const std::string& dataset) const;
  /// Names of what a group holds, in alphabetical order; "/" is the root.
  std::vector<std::string> members(const std::string& group) const;
  Shape shape(const std::string& dataset) const;
  std::vector<double> read_real(const std::string& dataset) const;
  std::vector<Complex> read_complex(const std::string& dataset) const;
  /// One row (first index).
  std::vector<Complex> read_complex_row(const std::string& dataset, std::uint64_t row) const;
  std::vector<std::int64_t> read_integers(const std::string& dataset) const;
  std::vector<std::string> read_texts(const std::string& dataset) const;

  bool has_attribute(const std::string& name) const;
  std::string text_attribute(const std::string& name) const;
  double real_attribute(const std::string& name) const;
  std::int64_t integer_attribute(const std::string& name) const;
  /// A text attribute of a dataset, empty when there is none.
  std::string text_attribute(const std::string& dataset, const std::string& name) const;
  std::vector<std::string> attribute_names() const;

 private:
  struct Implementation;
  explicit Hdf5File(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

/// Number of elements of a shape.
std::uint64_t element_count(const Shape& shape);

}  // namespace eigentrail
