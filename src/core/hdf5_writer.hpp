// Writing HDF5 files, in this process. What they hold comes from it.
#pragma once

#include <concepts>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "core/hdf5_types.hpp"

namespace eigentrail {

/// Lets one thread after the other use HDF5 for a whole task. HDF5 has one lock for all files and passes it
/// on at every call: threads that write at the same time without turns wait for each other thousands of
/// times.
class Hdf5Turn {
 public:
  Hdf5Turn();

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

struct DatasetSpec {
  std::string name;
  ElementType type = ElementType::real;
  Shape shape;
  /// All dimensions are unlimited and the data are chunked; elements that were never written read as NaN
  /// (real, complex) or -1 (integer).
  bool growing = false;
  std::map<std::string, std::string> attributes;
};

/// An HDF5 file that is being written. Copies are the same file. Not thread-safe.
class Hdf5Writer {
 public:
  /// Creates `path`. Throws Hdf5Error if it exists or cannot be created. Switches HDF5's own printing of
  /// errors off for the whole process; errors are reported by exceptions.
  static Hdf5Writer create(const std::string& path);
  /// Creates an empty file in memory; `name` is used in messages.
  static Hdf5Writer in_memory(const std::string& name);
  /// Goes on with a file in memory, from its bytes. They must be those that this class has given: HDF5 trusts
  /// them. `name` is used in messages.
  static Hdf5Writer from_image(const std::string& name, std::string_view image);

  void create_dataset(const DatasetSpec& spec);

  /// Extends a growing dataset along one dimension to `size`; new elements read as NaN or -1 until they are
  /// written.
  void extend(const std::string& dataset, unsigned dimension, std::uint64_t size);

  /// Writes whole rows (first index) from `first_row` on and extends the dataset if necessary. Data are
  /// row-major; without any nothing happens.
  template <class Element>
  void write_rows(const std::string& dataset, std::uint64_t first_row, const std::vector<Element>& data) {
    write(dataset, first_row, element_type<Element>(), data.size(), data.data());
  }

  /// Makes a one-dimensional dataset a dimension scale (the coordinates of a dimension); `label` is the name
  /// of the dimension.
  void make_scale(const std::string& dataset, const std::string& label);
  void attach_scale(const std::string& dataset, const std::string& scale, unsigned dimension);

  /// Attributes of the root group; an existing attribute is replaced.
  void set_attribute(const std::string& name, const std::string& value);
  void set_attribute(const std::string& name, double value);
  template <std::integral Integer>
  void set_attribute(const std::string& name, Integer value) {
    set_integer(name, static_cast<std::int64_t>(value));
  }

  void flush();

  /// The bytes of the file as they would be on disk.
  std::string image();

  bool has(const std::string& dataset) const;
  Shape shape(const std::string& dataset) const;

 private:
  struct Implementation;
  explicit Hdf5Writer(Implementation implementation);
  void set_integer(const std::string& name, std::int64_t value);
  void write(const std::string& dataset, std::uint64_t first_row, ElementType type, std::size_t count,
             const void* data);

  std::shared_ptr<const Implementation> implementation_;
};

}  // namespace eigentrail
