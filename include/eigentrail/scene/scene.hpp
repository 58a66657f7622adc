// A scene file as plain data, and a reader that converts its tables to typed values and reports errors.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "eigentrail/scene/parameters.hpp"
#include "eigentrail/scene/value.hpp"

namespace eigentrail {

/// A matrix in the memory of the caller: entry (r, c) is data[r row_stride + c column_stride].
struct MatrixInMemory {
  const double* data = nullptr;
  std::ptrdiff_t rows = 0, columns = 0, row_stride = 0, column_stride = 0;
  std::shared_ptr<const void> owner = {};  ///< keeps the data alive
};
/// The matrices of a family as their file would hold them: by group ("K") and name ("0").
using MatricesInMemory = std::map<std::string, std::map<std::string, MatrixInMemory>>;

struct Scene {
  std::string path;  ///< as the user gave it; used in messages and to find files relative to the scene
  std::string text;  ///< the full text, stored in result files
  std::string title;
  bool generated = false;  ///< the text is not what the user wrote: messages name no lines of it
  Table root;
  Parameters parameters;
  /// Files of matrices (HDF5) in memory, by the names by which the scene calls them: their bytes. They stand
  /// before files on the disk.
  std::map<std::string, std::shared_ptr<const std::string>> files = {};
  /// Dense matrices of [matrix_family] in memory, by the name of the file that would hold them.
  std::map<std::string, MatricesInMemory> matrices = {};
};

/// Reads and parses a scene file. With [matrix_family], the traced parameter need not be declared: it is
/// added with the value at which the trace begins. Throws InputError if the file cannot be read or is not a
/// valid scene.
Scene read_scene(const std::string& path);

/// The same from memory; `path` names the scene in messages, which name no lines of a text that was
/// `generated`.
Scene parse_scene(std::string text, const std::string& path, bool generated = false);

/// An error at a position in the scene: "path:line:column: message", or "path: message"
/// where the text was generated.
InputError scene_error(const Scene& scene, SourceLocation where, const std::string& message);

/// The unit in which a key wants its numbers; empty: any. "" is a number without unit.
using WantedUnit = std::optional<std::string_view>;

/// A name, or a fixed position given by three coordinates.
using NameOrPosition = std::variant<std::string, std::array<Expression, 3>>;

/// Reads one table of a scene. Every key that is requested becomes a known key; `finish` rejects all others.
/// All functions throw InputError with file, line, column and key.
class TableReader {
 public:
  /// `label` names the table in messages ("[[rod]] 2"); `used` collects the parameters that occur in
  /// expressions.
  TableReader(const Scene& scene, const Table& table, std::string label, std::set<int>& used)
      : scene_(scene), table_(table), label_(std::move(label)), used_(used) {}

  bool has(const std::string& key) { return find(key) != nullptr; }

  // Expressions whose dimension is known must have that of `unit`; plain numbers and parameters without a
  // unit are SI values of it.

  /// An expression of the parameters: a number, or a text such as "2*pi*rpm/60". `otherwise` is the value if
  /// the key is absent.
  Expression expression(const std::string& key, WantedUnit unit = {}) {
    return to_expression(require(key, "a number or an expression"), key, unit);
  }
  Expression expression_or(const std::string& key, double otherwise, WantedUnit unit = {});

  /// A list of expressions; a single expression counts as a list of one.
  std::vector<Expression> list(const std::string& key, WantedUnit unit = {});

  /// Three expressions: [x, y, z].
  std::array<Expression, 3> vector(const std::string& key, WantedUnit unit = {}) {
    return to_vector(require(key, "three numbers or expressions [x, y, z]"), key, unit);
  }

  NameOrPosition name_or_position(const std::string& key, WantedUnit unit = {});

  /// A matrix, a list of rows; a plain list of numbers is one row.
  std::vector<std::vector<Expression>> matrix(const std::string& key, WantedUnit unit = {});

  /// Whether the value of a key is a table; and a reader for it.
  bool is_table(const std::string& key);
  TableReader table(const std::string& key);

  /// Keys of the table in the order of the file.
  std::vector<std::string> keys() const;

  std::string text(const std::string& key);

  /// A list of texts; a single text counts as a list of one, and numbers as their texts.
  std::vector<std::string> texts(const std::string& key);

  /// true or false.
  bool flag(const std::string& key);

  /// The whole number of a key, which must be in the range.
  int whole_number(const std::string& key, int least, int most);

  /// List of matrices, each a list of rows of expressions: [matrix][row][column].
  std::vector<std::vector<std::vector<Expression>>> matrices(const std::string& key);

  /// Rejects keys that were not requested, and names the nearest known key.
  void finish() const;

  /// Throws an error about `key`, at its position or, if it is absent, at that of the table.
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;

  const std::string& label() const { return label_; }

 private:
  const Value* find(const std::string& key);
  const Value& require(const std::string& key, const std::string& expected);
  const Array& items(const Value& value, const std::string& key, const std::string& expected);
  Expression to_expression(const Value& value, const std::string& key, WantedUnit unit);
  void check_dimension(const Expression& expression, const std::string& key, const std::string& text,
                       WantedUnit unit) const;
  std::array<Expression, 3> to_vector(const Value& value, const std::string& key, WantedUnit unit);

  const Scene& scene_;
  const Table& table_;
  std::string label_;
  std::set<int>& used_;
  std::vector<std::string> known_;
};

/// The tables of an array of tables ("[[rod]]"); a single "[rod]" counts as one. Empty if the key is absent.
std::vector<const Table*> tables(const Scene& scene, const std::string& key);

/// Indices of the parameters that occur neither in `used` (filled by TableReader) nor in the definition of a
/// parameter in use. Throws InputError if the name of one looks like a misprint of one in use.
std::vector<int> unused_parameters(const Scene& scene, const std::set<int>& used);

/// The error, or warning, about a parameter that nothing uses.
InputError unused_error(const Scene& scene, int parameter);

}  // namespace eigentrail
