#include "model/read_sparse_family.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/core/text.hpp"
#include "eigentrail/model/affine_family.hpp"
#include "eigentrail/scene/limits.hpp"
#include "model/family_tables.hpp"

namespace eigentrail {
namespace {

using Terms = std::vector<AffineTerm<SparseMatrix>>;

const std::vector<std::string> matrix_names = {"M", "C", "K", "E", "A"};

class SparseReader {
 public:
  SparseReader(TableReader& table, const Hdf5File& file, int variable, std::set<int>& used)
      : table_(table), file_(file), variable_(variable), used_(used) {
    if (table.has("factors")) {
      TableReader factors = table.table("factors");
      for (const std::string& name : factors.keys()) factors_.emplace_back(name, factors.expression(name));
    }
  }

  /// The terms of one matrix; none if the file does not have it.
  Terms terms(const std::string& key) {
    Terms result;
    if (!file_.has("/" + key)) return result;
    for (const std::string& name : file_.members("/" + key)) {
      const std::string path = "/" + key + "/" + name;
      result.push_back({factor(path, name), matrix(path), name});
    }
    return result;
  }

  void reject_unknown_groups() const {
    std::vector<std::string> known = matrix_names;
    known.emplace_back("state_names");
    if (const std::string fault = unknown_member(file_, known); !fault.empty()) fail(fault);
  }

  /// Every factor of the scene must have a matrix: a misspelt one would change nothing.
  void reject_unused_factors() const {
    for (const auto& [name, factor] : factors_) {
      if (std::find(named_.begin(), named_.end(), name) == named_.end())
        table_.fail("factors", "'" + name + "' is the name of no matrix in the file; it has " + names_text());
    }
  }

  Eigen::Index size() const { return size_; }

  [[noreturn]] void fail(const std::string& message) const { table_.fail("file", message); }

 private:
  std::string names_text() const {
    std::string text;
    for (const std::string& name : named_) text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "powers of the parameter only" : text;
  }

  Expression factor(const std::string& path, const std::string& name) {
    if (const std::optional<int> power = power_in(name)) {
      if (*power < 0 || *power > limits::matrix_power)
        fail("matrix " + path + ": expected a power from 0 to " + std::to_string(limits::matrix_power));
      if (*power > 0) used_.insert(variable_);
      return power_of_parameter(variable_, *power);
    }
    named_.push_back(name);
    for (const auto& [known, expression] : factors_) {
      if (known == name) return expression;
    }
    fail("matrix " + path +
         ": neither a power of the parameter (0, 1, ...) nor a name with a factor; give it "
         "one: factors = { " +
         name + " = \"...\" }");
  }

  SparseMatrix matrix(const std::string& path) {
    const std::vector<std::string> members =
        is_sparse(path) ? file_.members(path) : std::vector<std::string>();
    return members.empty() ? dense(path) : compressed_rows(path);
  }

  bool is_sparse(const std::string& path) const { return file_.has(path + "/indptr"); }

  void take_size(const std::string& path, std::uint64_t rows) {
    if (rows == 0 || rows > limits::sparse_rows)
      fail("matrix " + path + " has " + std::to_string(rows) + " rows; expected 1 to " +
           std::to_string(limits::sparse_rows));
    if (size_ == 0) {
      size_ = static_cast<Eigen::Index>(rows);
      first_ = path;
    }
    if (size_ != static_cast<Eigen::Index>(rows))
      fail("matrix " + path + " has " + std::to_string(rows) + " rows, " + first_ + " has " +
           std::to_string(size_) + "; all have the same size");
  }

  void count(std::uint64_t numbers) {
    numbers_ += numbers;
    if (numbers_ > limits::matrix_numbers)
      fail("more than " + std::to_string(limits::matrix_numbers) + " entries in all matrices together");
  }

  SparseMatrix compressed_rows(const std::string& path) {
    for (const char* part : {"/data", "/indices"}) {
      if (!file_.has(path + part))
        fail("matrix " + path + " has no dataset" + std::string(part).replace(0, 1, " ") +
             "; a sparse matrix has data, indices and indptr, as scipy.sparse.csr_matrix");
    }
    const Shape starts_shape = file_.shape(path + "/indptr"), data_shape = file_.shape(path + "/data");
    if (starts_shape.size() != 1 || starts_shape[0] < 2 || data_shape.size() != 1 ||
        file_.shape(path + "/indices") != data_shape)
      fail("matrix " + path +
           ": expected lists data and indices of one length, and indptr with one entry "
           "more than there are rows");
    take_size(path, starts_shape[0] - 1);
    count(data_shape[0]);
    const std::vector<double> data = file_.read_real(path + "/data");
    const std::vector<std::int64_t> indices = file_.read_integers(path + "/indices");
    const std::vector<std::int64_t> starts = file_.read_integers(path + "/indptr");
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(data.size());
    for (Eigen::Index row = 0; row < size_; ++row) {
      const auto r = static_cast<std::size_t>(row);
      if (starts[0] != 0 || starts[r + 1] < starts[r] ||
          starts[r + 1] > static_cast<std::int64_t>(data.size()))
        fail("matrix " + path + ": indptr does not ascend from 0 to the length of data at row " +
             std::to_string(row + 1));
      for (auto at = static_cast<std::size_t>(starts[r]); at < static_cast<std::size_t>(starts[r + 1]);
           ++at) {
        if (indices[at] < 0 || indices[at] >= size_)
          fail("matrix " + path + ": row " + std::to_string(row + 1) + " has an entry in column " +
               std::to_string(indices[at]) + " (from 0); it is square with " + std::to_string(size_) +
               " columns");
        check_finite(data[at], path);
        entries.emplace_back(row, static_cast<Eigen::Index>(indices[at]), data[at]);
      }
    }
    SparseMatrix result(size_, size_);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  SparseMatrix dense(const std::string& path) {
    const Shape shape = file_.shape(path);
    if (shape.size() != 2 || shape[0] != shape[1])
      fail("matrix " + path +
           ": expected a square matrix, or a sparse one: a group with data, indices and "
           "indptr");
    take_size(path, shape[0]);
    count(shape[0] * shape[1]);
    const std::vector<double> data = file_.read_real(path);
    for (const double value : data) check_finite(value, path);
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const RowMajor>(data.data(), size_, size_).sparseView();
  }

  void check_finite(double value, const std::string& path) const {
    if (!std::isfinite(value)) fail("matrix " + path + " has an entry that is not finite");
  }

  TableReader& table_;
  const Hdf5File& file_;
  int variable_;
  std::set<int>& used_;
  std::vector<std::pair<std::string, Expression>> factors_;
  std::vector<std::string> named_;  ///< matrices of the file that are no powers
  Eigen::Index size_ = 0;
  std::string first_;
  std::uint64_t numbers_ = 0;
};

Terms negated(Terms terms) {
  for (AffineTerm<SparseMatrix>& term : terms) term.matrix = -term.matrix;
  return terms;
}

SparseMatrix identity(Eigen::Index n) {
  SparseMatrix result(n, n);
  result.setIdentity();
  return result;
}

}  // namespace

bool has_sparse_matrices(const Hdf5File& file) {
  for (const std::string& key : matrix_names) {
    if (!file.has("/" + key)) continue;
    for (const std::string& name : file.members("/" + key)) {
      if (file.has("/" + key + "/" + name + "/indptr")) return true;
    }
  }
  return false;
}

std::unique_ptr<Model> read_sparse_family(const Scene& scene, TableReader& table, const Hdf5File& file,
                                          int variable, std::set<int>& used) {
  SparseReader reader(table, file, variable, used);
  reader.reject_unknown_groups();
  Terms M = reader.terms("M"), C = reader.terms("C"), K = reader.terms("K");
  Terms E = reader.terms("E"), A = reader.terms("A");
  if (A.empty() != (!M.empty() || !C.empty() || !K.empty()) || (A.empty() && !E.empty()))
    reader.fail("expected matrices M, C and K of M x'' + C x' + K x = 0, or E and A of E x' = A x");
  if (!A.empty()) {
    K = negated(std::move(A));
    C = std::move(E);
    if (C.empty()) C.push_back({1.0, identity(reader.size()), "0"});
  }
  if (K.empty() || (M.empty() && C.empty())) reader.fail("has no matrix K, or neither M nor C");
  reader.reject_unused_factors();
  std::vector<std::string> names;
  if (file.has("/state_names")) names = file.read_texts("/state_names");
  if (table.has("state_names")) names = table.texts("state_names");
  const std::string fault = fault_of_names(names, reader.size());
  if (!fault.empty()) table.fail("state_names", fault);
  table.finish();
  ModelDescription description = describe_states(reader.size(), names);
  description.parameters = scene.parameters;
  description.unused_parameters = unused_parameters(scene, used);
  return std::make_unique<SparseFamily>(std::move(description),
                                        AffinePencil<SparseMatrix>{std::move(M), std::move(C), std::move(K)});
}

}  // namespace eigentrail
