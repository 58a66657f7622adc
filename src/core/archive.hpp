// Serialization of values to bytes and back: for the state from which a trace is resumed, and between
// processes.
//
// A struct lists its members once, in fields(self, visit), a static member function or a function that is
// found by argument-dependent lookup, or says that all of them are archived. Writing and reading both use
// that. Reading does not trust its input: every count is checked against the number of bytes left, so damaged
// input raises an ArchiveError and never accesses memory out of bounds.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

class ArchiveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// T or const T: the type of `self` in a list of fields.
template <class Self, class T>
concept SameAs = std::is_same_v<std::remove_const_t<Self>, T>;

/// An aggregate all of whose members are archived, in their order, says how many it has, by the
/// declaration of a function beside it: Members<2> archived(const Pair*). Another number than its own does
/// not compile.
template <int count>
using Members = std::integral_constant<int, count>;

template <class T>
concept AllArchived = requires(const T* value) {
  archived(value);
};

/// Calls `visit` with all members of an aggregate.
template <class Self, class Visit>
void visit_members(Self& self, Visit& visit) {
  constexpr int count = decltype(archived(&self))::value;
  if constexpr (count == 1) {
    auto& [a] = self;
    visit(a);
  } else if constexpr (count == 2) {
    auto& [a, b] = self;
    visit(a, b);
  } else if constexpr (count == 3) {
    auto& [a, b, c] = self;
    visit(a, b, c);
  } else if constexpr (count == 4) {
    auto& [a, b, c, d] = self;
    visit(a, b, c, d);
  } else if constexpr (count == 5) {
    auto& [a, b, c, d, e] = self;
    visit(a, b, c, d, e);
  } else if constexpr (count == 6) {
    auto& [a, b, c, d, e, f] = self;
    visit(a, b, c, d, e, f);
  } else if constexpr (count == 7) {
    auto& [a, b, c, d, e, f, g] = self;
    visit(a, b, c, d, e, f, g);
  } else if constexpr (count == 13) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = self;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m);
  } else if constexpr (count == 14) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = self;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
  } else if constexpr (count == 15) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = self;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
  } else if constexpr (count == 16) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = self;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p);
  } else if constexpr (count == 17) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = self;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q);
  } else if constexpr (count == 18) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = self;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r);
  } else if constexpr (count == 19) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s] = self;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s);
  } else {
    static_assert(count == 1, "a size without a line here");
  }
}

template <class T>
inline constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, Complex>;

class ArchiveWriter {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (write(values), ...);
  }

  const std::string& bytes() const { return bytes_; }

 private:
  void append(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
  void count(std::size_t n) { write(static_cast<std::uint64_t>(n)); }

  template <class T>
  void write(const T& value) {
    if constexpr (is_plain<T>) {
      append(&value, sizeof value);
    } else if constexpr (AllArchived<T>) {
      visit_members(value, *this);
    } else if constexpr (requires { T::fields(value, *this); }) {
      T::fields(value, *this);
    } else {
      fields(value, *this);
    }
  }
  void write(const std::string& text) {
    count(text.size());
    append(text.data(), text.size());
  }
  template <class T>
  void write(const std::vector<T>& items) {
    count(items.size());
    if constexpr (is_plain<T>) {
      append(items.data(), items.size() * sizeof(T));
    } else {
      for (const T& item : items) write(item);
    }
  }
  void write(const std::vector<bool>& items) {
    count(items.size());
    for (const bool item : items) write(item);
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& items) {
    for (const T& item : items) write(item);
  }
  template <class A, class B>
  void write(const std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <class Key, class T>
  void write(const std::map<Key, T>& items) {
    count(items.size());
    for (const auto& item : items) (*this)(item.first, item.second);
  }
  template <class T>
  void write(const std::optional<T>& value) {
    write(value.has_value());
    if (value) write(*value);
  }
  template <class... T>
  void write(const std::variant<T...>& value) {
    write(static_cast<std::uint8_t>(value.index()));
    std::visit([this](const auto& item) { write(item); }, value);
  }
  /// The shape of a matrix whose type does not have it, and the entries.
  template <class Scalar, int rows, int columns>
  void write(const Eigen::Matrix<Scalar, rows, columns>& matrix) {
    if constexpr (rows == Eigen::Dynamic || columns == Eigen::Dynamic)
      (*this)(static_cast<std::int64_t>(matrix.rows()), static_cast<std::int64_t>(matrix.cols()));
    append(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(Scalar));
  }
  void write(const SystemMatrix& matrix) {
    write(matrix.is_sparse());
    if (!matrix.is_sparse()) return write(matrix.dense());
    const SparseMatrix& sparse = matrix.sparse();
    (*this)(static_cast<std::int64_t>(sparse.rows()), static_cast<std::int64_t>(sparse.cols()));
    count(static_cast<std::size_t>(sparse.nonZeros()));
    for (Eigen::Index j = 0; j < sparse.outerSize(); ++j) {
      for (SparseMatrix::InnerIterator entry(sparse, j); entry; ++entry)
        (*this)(static_cast<std::int64_t>(entry.row()), static_cast<std::int64_t>(j), entry.value());
    }
  }

  std::string bytes_;
};

/// Reads values in the order in which ArchiveWriter wrote them. Throws ArchiveError if the bytes do not match
/// the types read.
class ArchiveReader {
 public:
  explicit ArchiveReader(std::string_view bytes) : left_(bytes) {}

  template <class... T>
  void operator()(T&... values) {
    (read(values), ...);
  }

  /// Throws ArchiveError if bytes are left.
  void finish() const {
    if (!left_.empty()) throw ArchiveError("more bytes than there are values");
  }

 private:
  void take(void* data, std::size_t size) {
    if (size > left_.size()) throw ArchiveError("fewer bytes than there are values");
    if (size > 0) std::memcpy(data, left_.data(), size);
    left_.remove_prefix(size);
  }

  /// Reads the number of items that follow, each of at least `size` bytes.
  std::size_t count(std::size_t size) {
    std::uint64_t n = 0;
    read(n);
    if (n > left_.size() / size) throw ArchiveError("a count that exceeds the bytes that are left");
    return static_cast<std::size_t>(n);
  }

  template <class T>
  void read(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      unsigned char byte = 0;
      take(&byte, 1);
      if (byte > 1) throw ArchiveError("neither true nor false");
      value = byte == 1;
    } else if constexpr (is_plain<T>) {
      take(&value, sizeof value);
    } else if constexpr (AllArchived<T>) {
      visit_members(value, *this);
    } else if constexpr (requires { T::fields(value, *this); }) {
      T::fields(value, *this);
    } else {
      fields(value, *this);
    }
  }
  void read(std::string& text) {
    text.resize(count(1));
    take(text.data(), text.size());
  }
  template <class T>
  void read(std::vector<T>& items) {
    // Items are appended one by one, so a damaged count cannot allocate more items than the bytes can hold.
    const std::size_t n = count(is_plain<T> ? sizeof(T) : 1);
    items.clear();
    if constexpr (is_plain<T>) {
      items.resize(n);
      take(items.data(), n * sizeof(T));
    } else {
      for (std::size_t i = 0; i < n; ++i) read(items.emplace_back());
    }
  }
  void read(std::vector<bool>& items) {
    items.assign(count(1), false);
    for (std::size_t i = 0; i < items.size(); ++i) {
      bool item = false;
      read(item);
      items[i] = item;
    }
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& items) {
    for (T& item : items) read(item);
  }
  template <class A, class B>
  void read(std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <class Key, class T>
  void read(std::map<Key, T>& items) {
    items.clear();
    for (std::size_t n = count(1); n > 0; --n) {
      Key key{};
      read(key);
      read(items[key]);
    }
  }
  template <class T>
  void read(std::optional<T>& value) {
    bool has_value = false;
    read(has_value);
    value.reset();
    if (!has_value) return;
    T item{};
    read(item);
    value = std::move(item);
  }
  template <class... T>
  void read(std::variant<T...>& value) {
    std::uint8_t index = 0;
    read(index);
    if (index >= sizeof...(T)) throw ArchiveError("none of the alternatives");
    std::uint8_t at = 0;
    ((at++ == index ? read(value.template emplace<T>()) : void()), ...);
  }
  std::pair<std::int64_t, std::int64_t> read_shape() {
    std::pair<std::int64_t, std::int64_t> shape;
    read(shape);
    constexpr std::int64_t most = 1 << 30;
    if (shape.first < 0 || shape.second < 0 || shape.first > most || shape.second > most)
      throw ArchiveError("no shape of a matrix");
    return shape;
  }
  template <class Scalar, int rows, int columns>
  void read(Eigen::Matrix<Scalar, rows, columns>& matrix) {
    if constexpr (rows == Eigen::Dynamic || columns == Eigen::Dynamic) {
      const auto [m, n] = read_shape();
      if (columns == 1 && n != 1) throw ArchiveError("no vector");
      if (static_cast<std::uint64_t>(m) * static_cast<std::uint64_t>(n) > left_.size() / sizeof(Scalar))
        throw ArchiveError("a matrix that exceeds the bytes that are left");
      matrix.resize(m, n);
    }
    take(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(Scalar));
  }
  void read(SystemMatrix& matrix) {
    bool is_sparse = false;
    read(is_sparse);
    if (!is_sparse) {
      Matrix dense;
      read(dense);
      matrix = std::move(dense);
      return;
    }
    const auto [rows, columns] = read_shape();
    std::vector<Eigen::Triplet<double>> entries(count(sizeof(double) + 2 * sizeof(std::int64_t)));
    for (auto& entry : entries) {
      std::int64_t row = 0, column = 0;
      double value = 0.0;
      (*this)(row, column, value);
      if (row < 0 || column < 0 || row >= rows || column >= columns)
        throw ArchiveError("an entry outside of its matrix");
      entry = {static_cast<int>(row), static_cast<int>(column), value};
    }
    SparseMatrix sparse(rows, columns);
    sparse.setFromTriplets(entries.begin(), entries.end());
    matrix = sparse;
  }

  std::string_view left_;
};

/// The bytes of values.
template <class... T>
std::string packed(const T&... values) {
  ArchiveWriter archive;
  archive(values...);
  return archive.bytes();
}

/// Reads values that are all that `bytes` hold. Throws ArchiveError.
template <class... T>
void unpack(std::string_view bytes, T&... values) {
  ArchiveReader archive(bytes);
  archive(values...);
  archive.finish();
}

}  // namespace eigentrail
