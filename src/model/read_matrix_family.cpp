#include "model/model_readers.hpp"

#include <algorithm>
#include <optional>
#include <type_traits>

#include "core/hdf5_file.hpp"
#include "core/texts.hpp"
#include "eigentrail/model/affine_family.hpp"
#include "eigentrail/scene/limits.hpp"
#include "model/affine_factor.hpp"
#include "model/beside_scene.hpp"
#include "model/draft.hpp"
#include "model/expression_terms.hpp"
#include "model/family_tables.hpp"

namespace eigentrail {
namespace {

constexpr int max_power = limits::matrix_power;

template <class Storage>
constexpr bool is_sparse = std::is_same_v<Storage, SparseMatrix>;
template <class Storage>
constexpr Eigen::Index max_rows = is_sparse<Storage> ? limits::sparse_rows : limits::matrix_rows;

/// The terms of one matrix: with powers of the traced parameter, with factors that the scene gives, or with
/// those of its entries that are expressions of parameters.
template <class Storage>
using Terms = std::vector<AffineTerm<Storage>>;

bool has_finite_entries(const Matrix& matrix) {
  return matrix.allFinite();
}
bool has_finite_entries(const SparseMatrix& matrix) {
  return Eigen::Map<const Vector>(matrix.valuePtr(), matrix.nonZeros()).allFinite();
}

std::string path_of(const std::string& key, const std::string& name) {
  return "/" + key + "/" + name;
}

bool has_sparse_matrices(const Hdf5File& file) {
  for (const std::string key : {"M", "C", "K", "E", "A"}) {
    if (!file.has("/" + key)) continue;
    for (const std::string& name : file.members("/" + key)) {
      if (is_compressed(file, path_of(key, name))) return true;
    }
  }
  return false;
}

class FamilyReader {
 public:
  FamilyReader(const Scene& of, const ModelRequest& request)
      : scene(of),
        draft(of, request),
        table(draft.reader(only_table(of, "matrix_family"), "[matrix_family]")),
        variable_(traced_index(
            of, "matrix_family",
            "the parameter whose powers multiply the matrices, also when another one is traced")) {
    if (!table.has("factors")) return;
    if (!table.has("file")) fail("factors", "are those of matrices in a file; name it: file = \"...\"");
    TableReader factors = table.table("factors");
    for (const std::string& name : factors.keys()) factors_.emplace_back(name, factors.expression(name));
  }

  const Scene& scene;
  Draft draft;
  TableReader table;

  [[noreturn]] void fail(const std::string& key, const std::string& message) const {
    table.fail(key, message);
  }

  bool has_factors() { return table.has("factors"); }
  /// Every factor of the scene must have a matrix: a misspelt one would change nothing.
  void reject_unused_factors() const {
    for (const auto& [name, factor] : factors_) {
      if (std::find(named_.begin(), named_.end(), name) == named_.end())
        fail("factors", "'" + name + "' is the name of no matrix in the file; it has " +
                            (named_.empty() ? "powers of the parameter only" : joined(named_, ", ")));
    }
  }

  /// The terms of the matrices KEY/0, KEY/1, ... of a file or in memory; none if it has none.
  template <class Storage, class Source>
  Terms<Storage> terms(const Source& source, const std::string& key) {
    Terms<Storage> result;
    for (const std::string& name : names_in(source, key)) {
      result.push_back({factor(key, name), matrix<Storage>(source, key, name), name});
    }
    return result;
  }

  /// Those written in the scene: K and M or C must be there.
  template <class Storage>
  DenseTerms terms(TableReader& source, const std::string& key) {
    const bool needed = key == "K" || (key == "M" && !source.has("C"));
    if (!needed && !source.has(key)) return {};
    const auto matrices = source.matrices(key);
    if (matrices.empty()) fail(key, "expected at least one matrix");
    if (static_cast<int>(matrices.size()) > max_power + 1) {
      fail(key, "has powers beyond " + std::to_string(max_power));
    }
    DenseTerms result, of_expressions;
    for (const auto& rows : matrices) add_power(result, of_expressions, rows, key);
    result.insert(result.end(), of_expressions.begin(), of_expressions.end());
    return result;
  }

  /// The names of the matrices of a group; none if it is absent.
  static std::vector<std::string> names_in(TableReader& source, const std::string& key) {
    return source.has(key) ? std::vector<std::string>{key} : std::vector<std::string>();
  }
  static std::vector<std::string> names_in(const Hdf5File& file, const std::string& key) {
    return file.has("/" + key) ? file.members("/" + key) : std::vector<std::string>();
  }
  static std::vector<std::string> names_in(const MatricesInMemory& matrices, const std::string& key) {
    std::vector<std::string> names;
    const auto group = matrices.find(key);
    if (group == matrices.end()) return names;
    for (const auto& [name, matrix] : group->second) names.push_back(name);
    return names;
  }

 private:
  /// Adds the matrix of the next power.
  void add_power(DenseTerms& terms, DenseTerms& of_expressions,
                 const std::vector<std::vector<Expression>>& rows, const std::string& key) {
    const auto power = static_cast<int>(terms.size());
    const auto n_rows = static_cast<Eigen::Index>(rows.size());
    const auto n_columns = static_cast<Eigen::Index>(rows.empty() ? 0 : rows[0].size());
    Matrix constant = Matrix::Zero(n_rows, n_columns);
    ExpressionTerms expressions(n_rows, n_columns, scene.parameters);
    for (Eigen::Index r = 0; r < n_rows; ++r) {
      const auto& row = rows[static_cast<std::size_t>(r)];
      if (static_cast<Eigen::Index>(row.size()) != n_columns) {
        fail(key, "power " + std::to_string(power) + ": row " + std::to_string(r + 1) + " has " +
                      std::to_string(row.size()) + " entries, row 1 has " + std::to_string(n_columns));
      }
      for (Eigen::Index c = 0; c < n_columns; ++c) {
        const Expression& entry = row[static_cast<std::size_t>(c)];
        if (entry.is_constant()) {
          constant(r, c) = entry.value();
        } else {
          draft.check_range(table, key, entry, Range::any);
          expressions.add(r, c, entry);
        }
      }
    }
    const Expression factor = factor_of_power(power);
    terms.push_back({factor, std::move(constant)});
    for (AffineTerm<Matrix>& term : expressions.take(factor)) of_expressions.push_back(std::move(term));
  }

  Expression factor_of_power(int power) {
    if (power > 0) draft.used.insert(variable_);
    Expression result = 1.0;
    for (int i = 0; i < power; ++i) result = result * Expression::of_parameter(variable_);
    return result;
  }

  Expression factor(const std::string& key, const std::string& name) {
    const std::string path = path_of(key, name);
    if (const std::optional<int> power = parsed_number<int>(name)) {
      if (*power < 0 || *power > max_power)
        fail("file", "dataset " + path + ": expected a power from 0 to " + std::to_string(max_power));
      return factor_of_power(*power);
    }
    named_.push_back(name);
    for (const auto& [known, expression] : factors_) {
      if (known == name) return expression;
    }
    fail("file", "matrix " + path +
                     ": neither a power of the parameter (0, 1, ...) nor a name with a factor; give it one: "
                     "factors = { " +
                     name + " = \"...\" }");
  }

  template <class Storage>
  Storage matrix(const MatricesInMemory& matrices, const std::string& key, const std::string& name) {
    const MatrixInMemory& view = matrices.at(key).at(name);
    if (view.rows > max_rows<Storage> || view.columns > max_rows<Storage>)
      fail_size<Storage>(path_of(key, name));
    count(static_cast<std::size_t>(view.rows * view.columns));
    using Strides = Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>;
    return Eigen::Map<const Matrix, 0, Strides>(view.data, view.rows, view.columns,
                                                Strides(view.column_stride, view.row_stride));
  }

  template <class Storage>
  Storage matrix(const Hdf5File& file, const std::string& key, const std::string& name) {
    const std::string path = path_of(key, name);
    if constexpr (is_sparse<Storage>) {
      if (is_compressed(file, path)) {
        count(compressed_numbers(file, path));
        return read_compressed_rows(file, path, max_rows<Storage>, table);
      }
    }
    const Shape shape = file.shape(path);
    if (shape.size() != 2 || shape[0] > max_rows<Storage> || shape[1] > max_rows<Storage>)
      fail_size<Storage>(path);
    count(shape[0] * shape[1]);
    const std::vector<double> data = file.read_real(path);
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const RowMajor> rows(data.data(), static_cast<Eigen::Index>(shape[0]),
                                          static_cast<Eigen::Index>(shape[1]));
    if constexpr (is_sparse<Storage>)
      return rows.sparseView();
    else
      return rows;
  }

  template <class Storage>
  [[noreturn]] void fail_size(const std::string& path) const {
    fail("file", "dataset " + path + ": expected a matrix of at most " + std::to_string(max_rows<Storage>) +
                     " rows" + (is_sparse<Storage> ? ", or a group with data, indices and indptr" : ""));
  }

  /// Counts the numbers of all matrices, zeros of dense ones included.
  void count(std::size_t numbers) {
    n_numbers_ += numbers;
    if (n_numbers_ > limits::matrix_numbers) {
      fail("file",
           "more than " + std::to_string(limits::matrix_numbers) + " numbers in all matrices together");
    }
  }

  int variable_;  ///< index of the parameter whose powers multiply the matrices
  std::vector<std::pair<std::string, Expression>> factors_;
  std::vector<std::string> named_;  ///< matrices that are no powers
  std::size_t n_numbers_ = 0;
};

/// A family of M x'' + C x' + K x = 0 with A x = 0.
template <class Storage>
struct Equations : AffinePencil<Storage> {
  bool first_order = false;  ///< C and K are E and -A of E x' = A x
};

/// Whether the matrices of the scene or file are those of E x' = A x. `key` is named where they do not fit.
bool is_first_order(const FamilyReader& reader, bool second_order, bool has_E, bool has_A,
                    const std::string& key) {
  if (has_E && second_order)
    reader.fail(
        key, "E and A stand for E x' = A x; beside M, C and K write E as C, and A as K with the other sign");
  if (has_E && !has_A) reader.fail(key, "E without A; the equations are E x' = A x");
  return has_A && !second_order;
}

/// The equations of the scene's table, of a file or in memory. The shapes are checked later.
template <class Storage, class Source>
Equations<Storage> equations_in(FamilyReader& reader, Source& source, const std::string& key) {
  const auto has = [&](const char* matrix) { return !reader.names_in(source, matrix).empty(); };
  const auto terms = [&](const char* matrix) { return reader.terms<Storage>(source, matrix); };
  if (!is_first_order(reader, has("M") || has("C") || has("K"), has("E"), has("A"), key)) {
    if (is_sparse<Storage> && has("A"))
      reader.fail(key, "A beside M, C and K: constraints are for dense matrices without factors");
    return {{terms("M"), terms("C"), terms("K"), terms("A")}};
  }
  Equations<Storage> result{{{}, terms("E"), terms("A")}, true};
  for (AffineTerm<Storage>& term : result.K) term.matrix = -term.matrix;
  if (result.C.empty()) {
    const Eigen::Index n = result.K[0].matrix.cols();
    result.C.push_back({1.0, Storage(n, n), "0"});
    result.C[0].matrix.setIdentity();
  }
  return result;
}

/// `first`: the key of the matrix that gives the size n. `constraints`: rows of the matrix are constraints.
template <class Storage>
void check_shape(const FamilyReader& reader, const Terms<Storage>& terms, const std::string& key,
                 Eigen::Index n, const std::string& first, bool constraints) {
  for (const AffineTerm<Storage>& term : terms) {
    const Storage& matrix = term.matrix;
    const std::string which = term.name.empty() ? "" : " (" + path_of(key, term.name) + ")";
    const bool square = constraints || matrix.rows() == n;
    if (matrix.cols() != n || !square || matrix.rows() != terms[0].matrix.rows()) {
      const std::string size = "is " + std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols());
      if (key == first && &term == &terms[0]) reader.fail(key, size + "; expected a square matrix" + which);
      reader.fail(key, size + ", " + first + " is " + std::to_string(n) + " x " + std::to_string(n) + "; " +
                           (constraints ? "A needs as many columns, and the same rows for every power"
                                        : "all have the same size") +
                           which);
    }
    if (!has_finite_entries(matrix)) reader.fail(key, "has an entry that is not finite" + which);
  }
}

std::vector<Effect> effects_of(const Equations<Matrix>& p) {
  const auto count = [](const DenseTerms& terms) {
    const bool is_zero =
        std::all_of(terms.begin(), terms.end(), [](const auto& term) { return term.matrix.isZero(0.0); });
    return is_zero ? 0 : static_cast<int>(terms.size());
  };
  if (p.first_order) {
    return {{"M", "mass matrix", 0, {.inertia = true}},
            {"E", "matrix of the derivatives", count(p.C), {.dissipative = true, .gyroscopic = true}},
            {"A", "state matrix", count(p.K), {.conservative = true, .circulatory = true}},
            {"constraints", "constraint matrix", 0, {.constraint = true}}};
  }
  return {{"M", "mass matrix, polynomial in the traced parameter", count(p.M), {.inertia = true}},
          {"C", "damping and gyroscopic matrix", count(p.C), damping_parts(p.C)},
          {"K", "stiffness matrix", count(p.K), stiffness_parts(p.K)},
          {"A", "constraint matrix", count(p.A), {.constraint = true}}};
}
/// Those of the family itself.
std::vector<Effect> effects_of(const Equations<SparseMatrix>&) {
  return {};
}

template <class Storage>
std::unique_ptr<Model> family_of(FamilyReader& reader, Equations<Storage> p, std::vector<std::string> names) {
  reader.reject_unused_factors();
  if (reader.table.has("state_names")) names = reader.table.texts("state_names");
  reader.table.finish();
  const std::string first = p.first_order ? "A" : p.M.empty() ? "K" : "M";
  const Eigen::Index n = (p.M.empty() ? p.K : p.M)[0].matrix.rows();
  if (n == 0 || n > max_rows<Storage>)
    reader.fail(first,
                "has " + std::to_string(n) + " rows; expected 1 to " + std::to_string(max_rows<Storage>));
  const std::string fault = fault_of_names(names, n);
  if (!fault.empty()) reader.fail("state_names", fault);
  std::vector<std::pair<const Terms<Storage>*, std::string>> all{
      {&p.M, "M"}, {&p.C, p.first_order ? "E" : "C"}, {&p.K, p.first_order ? "A" : "K"}, {&p.A, "A"}};
  // The matrix that gives the size is the first to be checked.
  std::stable_partition(all.begin(), all.end(), [&](const auto& one) { return one.second == first; });
  for (const auto& [terms, key] : all) check_shape(reader, *terms, key, n, first, terms == &p.A);
  ModelDescription description = describe_states(n, names);
  for (Eigen::Index i = 0; !p.A.empty() && i < p.A[0].matrix.rows(); ++i)
    description.constraint_names.push_back("A row " + std::to_string(i + 1));
  description.parameters = reader.scene.parameters;
  description.unused_parameters = unused_parameters(reader.scene, reader.draft.used);
  description.effects = effects_of(p);
  return std::make_unique<AffineFamily<Storage>>(std::move(description), std::move(p));
}

/// The family of the matrices in a file or in memory.
template <class Storage, class Source>
std::unique_ptr<Model> family_in(FamilyReader& reader, const Source& source, const std::string& name,
                                 std::vector<std::string> state_names) {
  for (const char* key : {"M", "C", "K", "A", "E"}) {
    if (reader.table.has(key)) reader.fail(key, "the matrices stand here or in the file, not both");
  }
  Equations<Storage> p = equations_in<Storage>(reader, source, "file");
  if (p.K.empty() || (p.M.empty() && p.C.empty()))
    reader.fail("file", name + " has no dataset /K/0, or neither /M/0 nor /C/0");
  return family_of(reader, std::move(p), std::move(state_names));
}

}  // namespace

std::unique_ptr<Model> read_matrix_family(const Scene& scene, const ModelRequest& request) {
  FamilyReader reader(scene, request);
  TableReader& table = reader.table;
  if (!table.has("file")) return family_of(reader, equations_in<Matrix>(reader, table, "E"), {});
  const std::string name = table.text("file");
  if (const auto in_memory = scene.matrices.find(name); in_memory != scene.matrices.end()) {
    if (reader.has_factors()) reader.fail("factors", "are those of matrices in a file, not in memory");
    return family_in<Matrix>(reader, in_memory->second, name, {});
  }
  try {
    const Hdf5File file = open_beside_scene(scene, table);
    const std::string fault = unknown_member(file, {"M", "C", "K", "A", "E", "state_names"});
    if (!fault.empty()) reader.fail("file", fault);
    std::vector<std::string> names;
    if (file.has("/state_names")) names = file.read_texts("/state_names");
    return reader.has_factors() || has_sparse_matrices(file)
               ? family_in<SparseMatrix>(reader, file, name, std::move(names))
               : family_in<Matrix>(reader, file, name, std::move(names));
  } catch (const Hdf5Error& error) {
    reader.fail("file", error.what() + std::string("; expected matrices in datasets /M/0, /C/0, /C/1, /K/0, "
                                                   "..., or /E/0, /A/0, ..."));
  }
}

}  // namespace eigentrail
