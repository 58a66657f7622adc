#include "model/read_matrix_family.hpp"

#include <algorithm>
#include <optional>

#include "core/hdf5_file.hpp"
#include "eigentrail/model/affine_family.hpp"
#include "eigentrail/scene/limits.hpp"
#include "model/affine_factor.hpp"
#include "model/beside_scene.hpp"
#include "model/draft.hpp"
#include "model/expression_terms.hpp"
#include "model/family_tables.hpp"
#include "model/read_sparse_family.hpp"

namespace eigentrail {
namespace {

constexpr Eigen::Index max_size = limits::matrix_rows;
constexpr int max_power = limits::matrix_power;

/// A matrix polynomial in the variable of the family: for every power a term with the constant entries, then
/// those of the entries that are expressions of parameters.
struct Polynomial {
  DenseTerms terms = {};
  int powers = 0;  ///< the highest, and one more

  bool empty() const { return terms.empty(); }
  /// Whether the matrix is given, but has no entries: it is absent.
  bool is_zero() const {
    return std::all_of(terms.begin(), terms.end(),
                       [](const AffineTerm<Matrix>& term) { return term.matrix.isZero(0.0); });
  }
};

struct FamilyReader {
  FamilyReader(const Scene& of, const ModelRequest& request)
      : scene(of),
        draft(of, request),
        table(draft.reader(only_table(of, "matrix_family"), "[matrix_family]")),
        variable(traced_index(
            of, "matrix_family",
            "the parameter whose powers multiply the matrices, also when another one is traced")) {}

  const Scene& scene;
  Draft draft;
  TableReader table;
  int variable;  ///< index of the parameter whose powers multiply the matrices
  std::size_t n_numbers = 0;

  [[noreturn]] void fail(const std::string& key, const std::string& message) const {
    table.fail(key, message);
  }

  /// The keys of the scene's matrices, or those of an empty form if it has none.
  bool is_first_order(bool has_M, bool has_C, bool has_K, bool has_E, bool has_A,
                      const std::string& key) const {
    const bool second_order = has_M || has_C || has_K;
    if (has_E && second_order)
      fail(key,
           "E and A stand for E x' = A x; beside M, C and K write E as C, and A as K with the other sign");
    if (has_E && !has_A) fail(key, "E without A; the equations are E x' = A x");
    return has_A && !second_order;
  }

  /// The polynomial as written in the scene.
  Polynomial from_scene(const std::string& key) {
    const auto matrices = table.matrices(key);
    if (matrices.empty()) fail(key, "expected at least one matrix");
    if (static_cast<int>(matrices.size()) > max_power + 1) {
      fail(key, "has powers beyond " + std::to_string(max_power));
    }
    Polynomial polynomial;
    DenseTerms of_expressions;
    for (const auto& rows : matrices) add_power(polynomial, of_expressions, rows, key);
    polynomial.terms.insert(polynomial.terms.end(), of_expressions.begin(), of_expressions.end());
    return polynomial;
  }

  /// Adds the matrix of the next power.
  void add_power(Polynomial& polynomial, DenseTerms& of_expressions,
                 const std::vector<std::vector<Expression>>& rows, const std::string& key) {
    const int power = polynomial.powers++;
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
          constant(r, c) = entry.evaluate(std::span<const double>());
        } else {
          draft.check_range(table, key, entry, Range::any);
          expressions.add(r, c, entry);
        }
      }
    }
    const Expression factor = power_of_parameter(variable, power);
    polynomial.terms.push_back({factor, std::move(constant)});
    for (AffineTerm<Matrix>& term : expressions.take(factor)) of_expressions.push_back(std::move(term));
  }

  /// Counts the numbers of all matrices, zeros included.
  void count(std::size_t numbers) {
    n_numbers += numbers;
    if (n_numbers > limits::matrix_numbers) {
      fail("file",
           "more than " + std::to_string(limits::matrix_numbers) + " numbers in all matrices together");
    }
  }

  /// The polynomial in the matrices KEY/0, KEY/1, ... of a file or in memory.
  template <class Source>
  Polynomial polynomial_in(const Source& source, const std::string& key) {
    Polynomial polynomial;
    for (const std::string& name : names_in(source, key)) {
      const int power = power_of(name, key);
      polynomial.terms.push_back({power_of_parameter(variable, power), matrix(source, key, name)});
      polynomial.powers = std::max(polynomial.powers, power + 1);
    }
    return polynomial;
  }

  /// Of the scene: K and M or C must be there.
  Polynomial polynomial_in(TableReader& source, const std::string& key) {
    const bool needed = key == "K" || (key == "M" && !source.has("C"));
    return needed || source.has(key) ? from_scene(key) : Polynomial();
  }
  int power_of(const std::string& name, const std::string& key) const {
    const std::optional<int> power = power_in(name);
    if (!power || *power < 0 || *power > max_power)
      fail("file",
           "dataset /" + key + "/" + name + ": expected a power from 0 to " + std::to_string(max_power));
    return *power;
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

  Matrix matrix(const MatricesInMemory& matrices, const std::string& key, const std::string& name) {
    const MatrixInMemory& view = matrices.at(key).at(name);
    if (view.rows > max_size || view.columns > max_size)
      fail("file", key + "/" + name + ": expected a matrix of at most " + std::to_string(max_size) + " rows");
    count(static_cast<std::size_t>(view.rows * view.columns));
    using Strides = Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>;
    return Eigen::Map<const Matrix, 0, Strides>(view.data, view.rows, view.columns,
                                                Strides(view.column_stride, view.row_stride));
  }

  Matrix matrix(const Hdf5File& file, const std::string& key, const std::string& in_group) {
    const std::string name = "/" + key + "/" + in_group;
    const Shape shape = file.shape(name);
    if (shape.size() != 2 || shape[0] > max_size || shape[1] > max_size) {
      fail("file",
           "dataset " + name + ": expected a matrix of at most " + std::to_string(max_size) + " rows");
    }
    count(shape[0] * shape[1]);
    const std::vector<double> data = file.read_real(name);
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const RowMajor>(data.data(), static_cast<Eigen::Index>(shape[0]),
                                      static_cast<Eigen::Index>(shape[1]));
  }

  /// `first`: the key of the matrix that gives the size. `constraints`: rows of the matrix are constraints.
  void check_shape(const Polynomial& polynomial, const std::string& key, Eigen::Index n,
                   const std::string& first, bool constraints) const {
    for (const AffineTerm<Matrix>& term : polynomial.terms) {
      const Matrix& c = term.matrix;
      const bool square = constraints || c.rows() == n;
      if (c.cols() != n || !square || c.rows() != polynomial.terms[0].matrix.rows()) {
        const std::string size = "is " + std::to_string(c.rows()) + " x " + std::to_string(c.cols());
        if (key == first && &term == &polynomial.terms[0]) fail(key, size + "; expected a square matrix");
        fail(key, size + ", " + first + " is " + std::to_string(n) + " x " + std::to_string(n) + "; " +
                      (constraints ? "A needs as many columns, and the same rows for every power"
                                   : "all have the same size"));
      }
      if (!c.allFinite()) fail(key, "has an entry that is not finite");
    }
  }
};

/// The matrices of M x'' + C x' + K x = 0 with A x = 0.
struct Equations {
  Polynomial M = {}, C = {}, K = {}, A = {};
  bool first_order = false;  ///< C and K are E and -A of E x' = A x
  std::vector<std::string> state_names = {};
};

/// Writes E x' = A x, E the identity if it is absent, with the matrices of the second-order form. The shapes
/// are checked later.
Equations first_order(Polynomial E, Polynomial A) {
  const Eigen::Index n = A.terms[0].matrix.cols();
  if (E.empty()) E = {{{1.0, Matrix::Identity(n, n)}}, 1};
  for (AffineTerm<Matrix>& term : A.terms) term.matrix = -term.matrix;
  return {{}, std::move(E), std::move(A), {}, true};
}

const std::string expected_datasets =
    "; expected matrices in datasets /M/0, /C/0, /C/1, /K/0, ..., or /E/0, /A/0, ...";

/// The equations of the scene's table, of a file or in memory; `key` is named where matrices do not fit.
template <class Source>
Equations equations_in(FamilyReader& reader, Source& source, const std::string& key) {
  const auto has = [&](const char* matrix) { return !reader.names_in(source, matrix).empty(); };
  if (reader.is_first_order(has("M"), has("C"), has("K"), has("E"), has("A"), key))
    return first_order(reader.polynomial_in(source, "E"), reader.polynomial_in(source, "A"));
  return {reader.polynomial_in(source, "M"), reader.polynomial_in(source, "C"),
          reader.polynomial_in(source, "K"), reader.polynomial_in(source, "A")};
}

/// Reads the equations from the file, or from memory. Returns the family itself if the file has sparse
/// matrices or the scene gives factors of matrices; else null.
std::unique_ptr<Model> read_file(FamilyReader& reader, Equations& p) {
  TableReader& table = reader.table;
  const std::string name = table.text("file");
  const auto in_memory = reader.scene.matrices.find(name);
  const bool is_in_memory = in_memory != reader.scene.matrices.end();
  if (is_in_memory && table.has("factors"))
    reader.fail("factors", "are those of matrices in a file, not in memory");
  try {
    std::optional<const Hdf5File> file;
    if (!is_in_memory) file.emplace(open_beside_scene(reader.scene, table));
    if (file && (table.has("factors") || has_sparse_matrices(*file)))
      return read_sparse_family(reader.scene, table, *file, reader.variable, reader.draft.used);
    for (const char* key : {"M", "C", "K", "A", "E"}) {
      if (table.has(key)) reader.fail(key, "the matrices stand here or in the file, not both");
    }
    if (file) {
      const std::string fault = unknown_member(*file, {"M", "C", "K", "A", "E", "state_names"});
      if (!fault.empty()) reader.fail("file", fault);
      p = equations_in(reader, *file, "file");
      if (file->has("/state_names")) p.state_names = file->read_texts("/state_names");
    } else {
      p = equations_in(reader, in_memory->second, "file");
    }
  } catch (const Hdf5Error& error) {
    reader.fail("file", error.what() + expected_datasets);
  }
  if (p.K.empty() || (p.M.empty() && p.C.empty()))
    reader.fail("file", name + " has no dataset /K/0, or neither /M/0 nor /C/0");
  return nullptr;
}

std::vector<Effect> effects_of_equations(const Equations& p) {
  const auto count = [](const Polynomial& polynomial) {
    return polynomial.is_zero() ? 0 : polynomial.powers;
  };
  if (p.first_order) {
    return {{"M", "mass matrix", 0, {.inertia = true}},
            {"E", "matrix of the derivatives", count(p.C), {.dissipative = true, .gyroscopic = true}},
            {"A", "state matrix", count(p.K), {.conservative = true, .circulatory = true}},
            {"constraints", "constraint matrix", 0, {.constraint = true}}};
  }
  return {{"M", "mass matrix, polynomial in the traced parameter", count(p.M), {.inertia = true}},
          {"C", "damping and gyroscopic matrix", count(p.C), damping_parts(p.C.terms)},
          {"K", "stiffness matrix", count(p.K), stiffness_parts(p.K.terms)},
          {"A", "constraint matrix", count(p.A), {.constraint = true}}};
}

}  // namespace

std::unique_ptr<Model> read_matrix_family(const Scene& scene, const ModelRequest& request) {
  FamilyReader reader(scene, request);
  Equations p;
  if (reader.table.has("file")) {
    if (auto sparse = read_file(reader, p)) return sparse;
  } else if (reader.table.has("factors")) {
    reader.fail("factors", "are those of matrices in a file; name it: file = \"...\"");
  } else {
    p = equations_in(reader, reader.table, "E");
  }
  if (reader.table.has("state_names")) p.state_names = reader.table.texts("state_names");
  reader.table.finish();

  const std::string first = p.first_order ? "A" : p.M.empty() ? "K" : "M";
  const Eigen::Index n = (p.M.empty() || p.first_order ? p.K : p.M).terms[0].matrix.rows();
  if (n == 0 || n > max_size) {
    reader.fail(first, "has " + std::to_string(n) + " rows; expected 1 to " + std::to_string(max_size));
  }
  const std::string fault = fault_of_names(p.state_names, n);
  if (!fault.empty()) reader.fail("state_names", fault);
  const char* damping = p.first_order ? "E" : "C";
  const char* stiffness = p.first_order ? "A" : "K";
  std::vector<std::pair<const Polynomial*, std::string>> all{
      {&p.M, "M"}, {&p.C, damping}, {&p.K, stiffness}, {&p.A, "A"}};
  // The matrix that gives the size is the first to be checked.
  std::stable_partition(all.begin(), all.end(), [&](const auto& one) { return one.second == first; });
  for (const auto& [polynomial, key] : all) {
    reader.check_shape(*polynomial, key, n, first, polynomial == &p.A);
    if (polynomial->powers > 1) reader.draft.used.insert(reader.variable);
  }
  ModelDescription description = describe_states(n, p.state_names);
  for (Eigen::Index i = 0; !p.A.empty() && i < p.A.terms[0].matrix.rows(); ++i)
    description.constraint_names.push_back("A row " + std::to_string(i + 1));
  description.parameters = scene.parameters;
  description.unused_parameters = unused_parameters(scene, reader.draft.used);
  description.effects = effects_of_equations(p);
  return std::make_unique<AffineFamily<Matrix>>(
      std::move(description), AffinePencil<Matrix>{std::move(p.M.terms), std::move(p.C.terms),
                                                   std::move(p.K.terms), std::move(p.A.terms)});
}

}  // namespace eigentrail
