#include <algorithm>

#include "core/hdf5_file.hpp"
#include "eigentrail/scene/limits.hpp"
#include "model/beside_scene.hpp"
#include "model/draft.hpp"
#include "model/family_tables.hpp"
#include "model/matrix_family.hpp"
#include "model/read_sparse_family.hpp"

namespace eigentrail {
namespace {

constexpr Eigen::Index max_size = limits::matrix_rows;
constexpr int max_power = limits::matrix_power;

struct FamilyReader {
  FamilyReader(const Scene& of, const ModelRequest& request)
      : scene(of),
        draft(of, request),
        table(draft.reader(only_table(of, "matrix_family"), "[matrix_family]")) {}

  const Scene& scene;
  Draft draft;
  TableReader table;
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

  /// The polynomial as written in the scene. Constants are stored in the coefficients, expressions as
  /// entries.
  MatrixPolynomial from_scene(const std::string& key) {
    const auto matrices = table.matrices(key);
    if (matrices.empty()) fail(key, "expected at least one matrix");
    if (static_cast<int>(matrices.size()) > max_power + 1) {
      fail(key, "has powers beyond " + std::to_string(max_power));
    }
    MatrixPolynomial polynomial;
    for (std::size_t power = 0; power < matrices.size(); ++power) {
      add_coefficient(polynomial, static_cast<int>(power), matrices[power], key);
    }
    return polynomial;
  }

  void add_coefficient(MatrixPolynomial& polynomial, int power,
                       const std::vector<std::vector<Expression>>& rows, const std::string& key) const {
    const auto n_rows = static_cast<Eigen::Index>(rows.size());
    const auto n_columns = static_cast<Eigen::Index>(rows.empty() ? 0 : rows[0].size());
    Matrix& coefficient = polynomial.coefficients.emplace_back(Matrix::Zero(n_rows, n_columns));
    for (Eigen::Index r = 0; r < n_rows; ++r) {
      const auto& row = rows[static_cast<std::size_t>(r)];
      if (static_cast<Eigen::Index>(row.size()) != n_columns) {
        fail(key, "power " + std::to_string(power) + ": row " + std::to_string(r + 1) + " has " +
                      std::to_string(row.size()) + " entries, row 1 has " + std::to_string(n_columns));
      }
      for (Eigen::Index c = 0; c < n_columns; ++c) {
        const Expression& entry = row[static_cast<std::size_t>(c)];
        if (entry.is_constant()) {
          coefficient(r, c) = entry.evaluate(std::span<const double>());
        } else {
          draft.check_range(table, key, entry, Range::any);
          polynomial.entries.push_back({power, r, c, entry});
        }
      }
    }
  }

  /// Counts the numbers of all matrices, zeros included.
  void count(std::size_t numbers) {
    n_numbers += numbers;
    if (n_numbers > limits::matrix_numbers) {
      fail("file", "more than " + std::to_string(limits::matrix_numbers) +
                       " numbers in all matrices together, those of absent powers among them");
    }
  }

  /// The polynomial in the matrices KEY/0, KEY/1, ... of a file or in memory; absent powers are zero.
  template <class Source>
  MatrixPolynomial polynomial_in(const Source& source, const std::string& key) {
    MatrixPolynomial polynomial;
    for (const std::string& name : names_in(source, key)) {
      const std::size_t power = power_of(name, key);
      if (power >= polynomial.coefficients.size()) polynomial.coefficients.resize(power + 1);
      polynomial.coefficients[power] = matrix(source, key, name);
    }
    for (Matrix& c : polynomial.coefficients) {
      if (c.size() != 0) continue;
      count(static_cast<std::size_t>(polynomial.coefficients.back().size()));
      c = Matrix::Zero(polynomial.coefficients.back().rows(), polynomial.coefficients.back().cols());
    }
    return polynomial;
  }

  std::size_t power_of(const std::string& name, const std::string& key) const {
    const std::optional<int> power = power_in(name);
    if (!power || *power < 0 || *power > max_power)
      fail("file",
           "dataset /" + key + "/" + name + ": expected a power from 0 to " + std::to_string(max_power));
    return static_cast<std::size_t>(*power);
  }

  /// The names of the matrices of a group; none if it is absent.
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
  void check_shape(const MatrixPolynomial& polynomial, const std::string& key, Eigen::Index n,
                   const std::string& first, bool constraints) const {
    for (const Matrix& c : polynomial.coefficients) {
      const bool square = constraints || c.rows() == n;
      if (c.cols() != n || !square || c.rows() != polynomial.coefficients[0].rows()) {
        const std::string size = "is " + std::to_string(c.rows()) + " x " + std::to_string(c.cols());
        if (key == first && &c == &polynomial.coefficients[0]) fail(key, size + "; expected a square matrix");
        fail(key, size + ", " + first + " is " + std::to_string(n) + " x " + std::to_string(n) + "; " +
                      (constraints ? "A needs as many columns, and the same rows for every power"
                                   : "all have the same size"));
      }
      if (!c.allFinite()) fail(key, "has an entry that is not finite");
    }
  }
};

/// Index of the parameter whose powers multiply the coefficients: the one that [trace] of the scene names.
int variable_index(const Scene& scene) {
  return traced_index(scene, "matrix_family",
                      "the parameter whose powers multiply the matrices, also when another one is traced");
}

struct Polynomials {
  MatrixPolynomial M, C, K, A;
  bool first_order = false;  ///< C and K are E and -A of E x' = A x
  std::vector<std::string> state_names = {};
};

MatrixPolynomial negated(MatrixPolynomial polynomial) {
  for (Matrix& c : polynomial.coefficients) c = -c;
  for (MatrixPolynomial::Entry& entry : polynomial.entries) entry.expression = -entry.expression;
  return polynomial;
}

MatrixPolynomial constant(const Matrix& matrix) {
  return {{matrix}, {}};
}

/// Writes E x' = A x, E the identity if it is absent, with the matrices of the second-order form. The shapes
/// are checked later.
Polynomials first_order(MatrixPolynomial E, MatrixPolynomial A) {
  const Eigen::Index n = A.coefficients[0].cols();
  if (E.empty()) E = constant(Matrix::Identity(n, n));
  return {{}, std::move(E), negated(std::move(A)), {}, true};
}

const std::string expected_datasets =
    "; expected matrices in datasets /M/0, /C/0, /C/1, /K/0, ..., or /E/0, /A/0, ...";

template <class Source>
Polynomials polynomials_in(FamilyReader& reader, const Source& source) {
  const auto has = [&](const char* key) { return !reader.names_in(source, key).empty(); };
  if (reader.is_first_order(has("M"), has("C"), has("K"), has("E"), has("A"), "file"))
    return first_order(reader.polynomial_in(source, "E"), reader.polynomial_in(source, "A"));
  return {reader.polynomial_in(source, "M"), reader.polynomial_in(source, "C"),
          reader.polynomial_in(source, "K"), reader.polynomial_in(source, "A")};
}

Polynomials read_file(FamilyReader& reader) {
  for (const char* key : {"M", "C", "K", "A", "E"}) {
    if (reader.table.has(key)) reader.fail(key, "the matrices stand here or in the file, not both");
  }
  Polynomials p;
  try {
    const auto in_memory = reader.scene.matrices.find(reader.table.text("file"));
    if (in_memory != reader.scene.matrices.end()) {
      p = polynomials_in(reader, in_memory->second);
    } else {
      const Hdf5File file = open_beside_scene(reader.scene, reader.table);
      const std::string fault = unknown_member(file, {"M", "C", "K", "A", "E", "state_names"});
      if (!fault.empty()) reader.fail("file", fault);
      p = polynomials_in(reader, file);
      if (file.has("/state_names")) p.state_names = file.read_texts("/state_names");
    }
  } catch (const Hdf5Error& error) {
    reader.fail("file", error.what() + expected_datasets);
  }
  if (p.K.empty() || (p.M.empty() && p.C.empty()))
    reader.fail("file", reader.table.text("file") + " has no dataset /K/0, or neither /M/0 nor /C/0");
  return p;
}

/// The family, if its file has sparse matrices or the scene gives factors of matrices; null otherwise.
std::unique_ptr<Model> read_if_sparse(FamilyReader& reader) {
  const bool has_factors = reader.table.has("factors");
  if (!reader.table.has("file")) {
    if (has_factors) reader.fail("factors", "are those of matrices in a file; name it: file = \"...\"");
    return nullptr;
  }
  if (reader.scene.matrices.contains(reader.table.text("file"))) {
    if (has_factors) reader.fail("factors", "are those of matrices in a file, not in memory");
    return nullptr;
  }
  try {
    const Hdf5File file = open_beside_scene(reader.scene, reader.table);
    if (!has_factors && !has_sparse_matrices(file)) return nullptr;
    return read_sparse_family(reader.scene, reader.table, file, variable_index(reader.scene),
                              reader.draft.used);
  } catch (const Hdf5Error& error) {
    reader.fail("file", error.what() + expected_datasets);
  }
}

Polynomials read_table(FamilyReader& reader) {
  TableReader& table = reader.table;
  Polynomials p;
  if (reader.is_first_order(table.has("M"), table.has("C"), table.has("K"), table.has("E"), table.has("A"),
                            "E")) {
    MatrixPolynomial E;
    if (table.has("E")) E = reader.from_scene("E");
    return first_order(std::move(E), reader.from_scene("A"));
  }
  if (table.has("M") || !table.has("C")) p.M = reader.from_scene("M");
  p.K = reader.from_scene("K");
  if (table.has("C")) p.C = reader.from_scene("C");
  if (table.has("A")) p.A = reader.from_scene("A");
  return p;
}

}  // namespace

std::unique_ptr<Model> read_matrix_family(const Scene& scene, const ModelRequest& request) {
  FamilyReader reader(scene, request);
  if (auto sparse = read_if_sparse(reader)) return sparse;
  Polynomials p = reader.table.has("file") ? read_file(reader) : read_table(reader);
  if (reader.table.has("state_names")) p.state_names = reader.table.texts("state_names");
  reader.table.finish();

  const std::string first = p.first_order ? "A" : p.M.empty() ? "K" : "M";
  const Eigen::Index n = (p.M.empty() || p.first_order ? p.K : p.M).coefficients[0].rows();
  if (n == 0 || n > max_size) {
    reader.fail(first, "has " + std::to_string(n) + " rows; expected 1 to " + std::to_string(max_size));
  }
  const std::string fault = fault_of_names(p.state_names, n);
  if (!fault.empty()) reader.fail("state_names", fault);
  const int variable = variable_index(scene);
  const char* damping = p.first_order ? "E" : "C";
  const char* stiffness = p.first_order ? "A" : "K";
  std::vector<std::pair<MatrixPolynomial*, std::string>> all{
      {&p.M, "M"}, {&p.C, damping}, {&p.K, stiffness}, {&p.A, "A"}};
  // The matrix that gives the size is the first to be checked.
  std::stable_partition(all.begin(), all.end(), [&](const auto& one) { return one.second == first; });
  for (const auto& [polynomial, key] : all) {
    reader.check_shape(*polynomial, key, n, first, polynomial == &p.A);
    if (polynomial->coefficients.size() > 1) reader.draft.used.insert(variable);
  }
  if (p.M.empty()) p.M = constant(Matrix::Zero(n, n));
  ModelDescription description = describe_states(n, p.state_names);
  for (Eigen::Index i = 0; !p.A.empty() && i < p.A.coefficients[0].rows(); ++i)
    description.constraint_names.push_back("A row " + std::to_string(i + 1));
  description.parameters = scene.parameters;
  description.unused_parameters = unused_parameters(scene, reader.draft.used);
  return std::make_unique<MatrixFamily>(std::move(description), variable, std::move(p.M), std::move(p.C),
                                        std::move(p.K), std::move(p.A),
                                        p.first_order ? FamilyForm::first_order : FamilyForm::second_order);
}

}  // namespace eigentrail
