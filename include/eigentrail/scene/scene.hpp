// A scene file as plain data, and the reader that turns its tables into typed values with helpful errors.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "eigentrail/scene/parameters.hpp"
#include "eigentrail/scene/value.hpp"

namespace eigentrail {

struct Scene {
  std::string path;  ///< as given by the user; names the file in messages and locates files beside it
  std::string text;  ///< the full text, kept for provenance
  std::string title;
  Table root;
  Parameters parameters;
};

/// Reads and parses a scene file. The parameter that a scene with [matrix_family] traces need not be
/// declared: it is added, with the value where the trace begins. Throws InputError for a file that cannot be
/// read or is no scene.
Scene read_scene(const std::string& path);

/// The same from memory; `path` names the text in messages.
Scene parse_scene(std::string text, const std::string& path);

/// An error at a place of the scene: "path:line:column: message".
InputError scene_error(const Scene& scene, SourceLocation where, const std::string& message);

/// A name, or a fixed place given by three coordinates.
using NameOrPosition = std::variant<std::string, std::array<Expression, 3>>;

/// Reads one table of a scene. Every key that is asked for becomes a known key; `finish` rejects all others.
/// All functions throw InputError with file, line, column and key.
class TableReader {
 public:
  /// `label` names the table in messages ("[[rod]] 2"); `used` collects the parameters that expressions name.
  TableReader(const Scene& scene, const Table& table, std::string label, std::set<int>& used);

  bool has(const std::string& key);

  /// An expression of the parameters: a number, or a text such as "2*pi*rpm/60".
  Expression expression(const std::string& key);
  Expression expression(const std::string& key, double otherwise);

  /// An expression, or a list of some.
  std::vector<Expression> list(const std::string& key);

  /// Three expressions: [x, y, z].
  std::array<Expression, 3> vector(const std::string& key);

  NameOrPosition name_or_position(const std::string& key);

  /// A matrix, a list of rows; a plain list of numbers is one row.
  std::vector<std::vector<Expression>> matrix(const std::string& key);

  /// Whether the value of a key is a table, and a reader of it.
  bool is_table(const std::string& key);
  TableReader table(const std::string& key);

  /// Keys of the table in the order of the file.
  std::vector<std::string> keys() const;

  std::string text(const std::string& key);

  /// true or false.
  bool flag(const std::string& key);

  /// List of matrices, each a list of rows of expressions: [matrix][row][column].
  std::vector<std::vector<std::vector<Expression>>> matrices(const std::string& key);

  /// Rejects keys that nobody asked for, naming the nearest known one.
  void finish() const;

  /// An error about `key` (its place when it is present, else the table's).
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;

  const std::string& label() const { return label_; }

 private:
  const Value* find(const std::string& key);
  const Value& require(const std::string& key, const std::string& expected);
  const Array& items(const Value& value, const std::string& key, const std::string& expected);
  Expression to_expression(const Value& value, const std::string& key);
  std::array<Expression, 3> to_vector(const Value& value, const std::string& key);

  const Scene& scene_;
  const Table& table_;
  std::string label_;
  std::set<int>& used_;
  std::vector<std::string> known_;
};

/// The tables of an array of tables ("[[rod]]"); a single "[rod]" counts as one. Empty when the key is
/// absent.
std::vector<const Table*> tables(const Scene& scene, const std::string& key);

/// Rejects parameters that neither an expression nor another used parameter names. `used` as TableReader
/// fills it.
void reject_unused_parameters(const Scene& scene, const std::set<int>& used);

}  // namespace eigentrail
