// Reading HDF5 files. Files come from anywhere, so another process reads them (core/reader_process.hpp).
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/hdf5_types.hpp"
#include "core/reader_process.hpp"

namespace eigentrail {

/// An HDF5 file that is open for reading. Not thread-safe. All functions throw Hdf5Error if the file is
/// damaged or has not what is asked for; the message begins with the name of the file.
class Hdf5File {
 public:
  static Hdf5File open(const std::string& path);
  /// From the bytes of a file; `name` is used in messages.
  static Hdf5File from_image(const std::string& name, std::string_view image);

  /// Throws Hdf5Error: contents that contradict each other.
  [[noreturn]] void fail(const std::string& reason) const { reader_.fail(reason); }
  void require_fit(bool fits, const std::string& dataset) const {
    if (!fits) fail(dataset + " does not fit the other datasets");
  }

  bool has(const std::string& path) const;
  /// Names of the members of a group in alphabetical order; "/" is the root group.
  std::vector<std::string> members(const std::string& group) const;
  Shape shape(const std::string& dataset) const;

  /// A whole dataset in the type in which it is stored; nothing for other objects, groups and named types.
  std::optional<StoredArray> read(const std::string& object) const;
  /// Real numbers may be stored as integers, and integers as real numbers, as MATLAB does.
  std::vector<double> read_real(const std::string& dataset) const;
  std::vector<Complex> read_complex(const std::string& dataset) const;
  /// Reads one row (first index).
  std::vector<Complex> read_complex_row(const std::string& dataset, std::uint64_t row) const;
  std::vector<std::int64_t> read_integers(const std::string& dataset) const;
  std::vector<std::string> read_texts(const std::string& dataset) const;

  /// The attributes of an object that are numbers or texts. DIMENSION_LIST has the names of a dataset's
  /// dimensions.
  std::map<std::string, StoredArray> attributes(const std::string& object) const;

  /// Attributes of the root group.
  bool has_attribute(const std::string& name) const { return attributes_.contains(name); }
  std::string text_attribute(const std::string& name) const;
  double real_attribute(const std::string& name) const;
  std::int64_t integer_attribute(const std::string& name) const;
  /// Those that are single values, as texts.
  std::map<std::string, std::string> attribute_texts() const;
  /// A text attribute of a dataset; empty if it does not exist.
  std::string text_attribute(const std::string& dataset, const std::string& name) const;

 private:
  Hdf5File(const std::string& name, ReaderRequest request, const std::string& what);
  std::optional<StoredArray> rows(const std::string& object, std::uint64_t first, std::uint64_t count) const;
  template <class Element>
  std::vector<Element> elements(std::optional<StoredArray> array, const std::string& name) const;
  template <class Element>
  Element attribute(const std::map<std::string, StoredArray>& attributes, const std::string& name) const;

  ReaderProcess reader_;
  std::map<std::string, StoredArray> attributes_;
};

}  // namespace eigentrail
