// Matrices from files of the Matrix Market: powers of the parameter (M0.mtx, K0.mtx, K2.mtx), or samples that
// a table of files lists.
#include <algorithm>
#include <filesystem>
#include <regex>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "import/file_table.hpp"
#include "import/formats.hpp"
#include "import/market_file.hpp"
#include "import/samples.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {
namespace {

/// A file and what its name says: "rotor_K2.mtx" is the coefficient of the square of the parameter in K.
struct Coefficient {
  std::string file;
  char letter = 'K';
  std::size_t power = 0;
  SystemMatrix matrix = {};
};

/// Sparse matrices with fewer rows are stored as dense ones.
constexpr Eigen::Index least_sparse_rows = 151;

std::string size_text(const SystemMatrix& matrix) {
  return std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols());
}

class MarketImport {
 public:
  explicit MarketImport(const ImportRequest& request) : request_(request) {}

  Imported read() {
    const bool table = std::ranges::any_of(request_.files, [](const auto& f) { return is_file_table(f); });
    if (table && request_.files.size() > 1)
      throw InputError("matrix-market: expected one table (.csv), or files of matrices (.mtx)");
    if (table) {
      read_table(parse_file_table(read_text_file(request_.files[0]), request_.files[0]));
    } else {
      read_powers();
    }
    return std::move(result_);
  }

 private:
  void refuse_options(std::initializer_list<const char*> names, const std::string& reason) const {
    for (const char* name : names) {
      if (request_.options.contains(name)) throw InputError("--" + std::string(name) + ": " + reason);
    }
  }

  std::vector<std::string> state_names(Eigen::Index n) const {
    const auto found = request_.options.find("state-names");
    if (found == request_.options.end()) return {};
    const std::string text = read_text_file(found->second);
    TextLines lines(text, found->second);
    std::vector<std::string> names;
    while (const auto line = lines.next()) {
      const std::string_view name = trimmed(*line);
      if (name.empty()) continue;
      if (name.size() > limits::text_length || static_cast<Eigen::Index>(names.size()) == n)
        lines.fail(static_cast<Eigen::Index>(names.size()) == n
                       ? "a name too many; the matrices have " + std::to_string(n) + " rows"
                       : "a name that is too long");
      names.emplace_back(name);
    }
    if (static_cast<Eigen::Index>(names.size()) != n)
      lines.fail("the file ends after " + std::to_string(names.size()) + " names; expected " +
                 std::to_string(n) + ", one per line");
    return names;
  }

  /// Counts the numbers of all matrices, before they are read or stored.
  void count(const std::string& file, std::size_t numbers) {
    numbers_ += numbers;
    if (numbers_ > limits::matrix_numbers)
      throw InputError(file + ": more than " + std::to_string(limits::matrix_numbers) +
                       " numbers in all matrices together, absent powers and zeros included");
  }

  static Coefficient named(const std::string& file) {
    static const std::regex pattern("(?:.*[._-])?([MCKEA])_?([0-9]{0,4})");
    const std::string stem = std::filesystem::path(file).stem().string();
    std::smatch match;
    constexpr std::size_t longest = 255;  // of names; longer ones are a burden for std::regex
    if (stem.size() > longest || !std::regex_match(stem, match, pattern))
      throw InputError(
          printable(file) +
          ": the name does not say which matrix this is; expected M0.mtx, C1.mtx, K2.mtx, E0.mtx "
          "or A0.mtx (matrix and power of the parameter), or a table of files (.csv)");
    const std::string power = match[2].str();
    Coefficient result{file, match[1].str()[0], power.empty() ? 0 : std::stoul(power)};
    if (result.power > limits::matrix_power)
      throw InputError(file + ": powers of the parameter up to " + std::to_string(limits::matrix_power) +
                       " can be imported");
    return result;
  }

  std::vector<Coefficient> read_coefficients() {
    std::vector<Coefficient> all;
    for (const std::string& file : request_.files) {
      Coefficient one = named(file);
      for (const Coefficient& other : all) {
        if (other.letter == one.letter && other.power == one.power)
          throw InputError(file + ": is power " + std::to_string(one.power) + " of " + one.letter +
                           ", and so is " + other.file);
      }
      one.matrix = parse_market_file(read_text_file(file), file);
      if (one.matrix.is_sparse() && one.matrix.cols() < least_sparse_rows) one.matrix = one.matrix.dense();
      all.push_back(std::move(one));
    }
    return all;
  }

  /// Whether there is this matrix, of any power.
  static bool has(const std::vector<Coefficient>& all, char letter) {
    return std::ranges::any_of(all, [&](const Coefficient& c) { return c.letter == letter; });
  }

  static void check_forms(const std::vector<Coefficient>& all) {
    const bool second = has(all, 'M') || has(all, 'C') || has(all, 'K');
    const auto fail = [](const std::string& message) { throw InputError("matrix-market: " + message); };
    if (second && has(all, 'E')) fail("E belongs to E x' = A x and cannot stand beside M, C or K");
    if (second && (!has(all, 'K') || (!has(all, 'M') && !has(all, 'C'))))
      fail("expected K with M, C or both, or A and optionally E; a file is missing");
    if (!second && !has(all, 'A')) fail("E without A; the equations are E x' = A x");
    const Coefficient& first =
        *std::ranges::find_if(all, [&](const Coefficient& c) { return !second || c.letter != 'A'; });
    const Eigen::Index n = first.matrix.cols();
    const Coefficient* constraints = nullptr;
    for (const Coefficient& one : all) {
      const bool constraint = second && one.letter == 'A';
      if (constraint && constraints == nullptr) constraints = &one;
      const Eigen::Index rows = constraint ? constraints->matrix.rows() : n;
      if (one.matrix.rows() != rows || one.matrix.cols() != n)
        throw InputError(one.file + ": the matrix is " + size_text(one.matrix) + "; expected " +
                         std::to_string(rows) + " x " + std::to_string(n) +
                         (&one == &first ? ", a square matrix" : ", as in " + first.file));
    }
  }

  void read_powers() {
    refuse_options({"digits"}, "holds for samples; powers of the parameter are taken as exact");
    const std::vector<Coefficient> all = read_coefficients();
    check_forms(all);
    std::size_t highest = 0;
    for (const Coefficient& one : all) highest = std::max(highest, one.power);
    set_title();
    const bool is_sample = highest == 0 && !(has(all, 'A') && has(all, 'K'));
    if (is_sample && sparse_entries(all) == 0) return one_sample(all);
    if (is_sample)
      throw InputError("matrix-market: sparse matrices of " + std::to_string(all.front().matrix.cols()) +
                       " rows, and no matrix has a power of the parameter; a large model needs one, such as "
                       "K1.mtx");
    if (highest == 0)
      throw InputError("matrix-market: no matrix has a power of the parameter; expected one such as K1.mtx");
    result_.parameter = parameter_option(request_, "p");
    PolynomialData& family = result_.family.emplace();
    for (const auto& [name, list] : polynomial_matrices) {
      std::string powers;
      for (const Coefficient& one : all) {
        if (one.letter != *name) continue;
        std::vector<SystemMatrix>& own = family.*list;
        const auto size = static_cast<std::size_t>(one.matrix.size());
        if (one.matrix.is_sparse()) {
          count(one.file, static_cast<std::size_t>(one.matrix.sparse().nonZeros()));
        } else if (own.size() <= one.power) {
          count(one.file, (one.power + 1 - own.size()) * size);
        }
        own.resize(std::max(own.size(), one.power + 1));
        own[one.power] = one.matrix;
        powers += (powers.empty() ? "" : ", ") + std::to_string(one.power);
      }
      if (!powers.empty())
        result_.understood.push_back(std::string(name) + ", power" + (powers.size() > 1 ? "s " : " ") +
                                     powers + " of " + result_.parameter);
    }
    if (const auto nonzeros = sparse_entries(all))
      result_.understood.push_back("sparse, " + std::to_string(nonzeros) + " entries");
    finish_family(family, all.front().matrix.cols());
  }

  /// Entries of the sparse matrices; zero if there are none.
  static Eigen::Index sparse_entries(const std::vector<Coefficient>& all) {
    Eigen::Index sum = 0;
    for (const Coefficient& one : all) sum += one.matrix.is_sparse() ? one.matrix.sparse().nonZeros() : 0;
    return sum;
  }

  void finish_family(PolynomialData& family, Eigen::Index n) {
    result_.understood.push_back(std::to_string(n) + " states");
    family.state_names = state_names(n);
    family.parameter_unit = request_.option("unit");
    family.from = number_option(request_, "from", 0.0, true);
    family.to = number_option(request_, "to", 1.0, true);
    if (family.from == family.to) throw InputError("--to: equals --from; expected a range");
    if (!request_.options.contains("to"))
      result_.warnings.push_back("files of powers have no range of the parameter; the scene has " +
                                 exact_text(family.from) + " to " + exact_text(family.to) +
                                 "; --from and --to give another");
  }

  void one_sample(const std::vector<Coefficient>& all) {
    refuse_options({"from", "to"}, "the matrices do not depend on a parameter");
    SampledData& data = result_.samples;
    result_.parameter = parameter_option(request_, "p");
    data.values = {0.0};
    data.parameter_unit = request_.option("unit");
    for (const Coefficient& one : all) {
      for (const SampledMatrix& named : sampled_matrices()) {
        if (one.letter == named.name[0]) (data.*named.samples).push_back(one.matrix.dense());
      }
    }
    result_.understood.push_back("one sample, " + size_text(all.front().matrix) +
                                 ", and no value of a parameter");
    data.state_names = state_names(data.size());
    finish_samples(result_, request_, request_.files[0]);
  }

  /// What the names of the files have in common, or their folder.
  void set_title() {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::absolute(request_.files[0], error);
    result_.title = path.parent_path().filename().string();
    if (result_.title.empty()) result_.title = "matrices";
  }

  /// The columns of a table as matrices; their samples are empty.
  std::vector<std::vector<Matrix>*> columns_of(const FileTable& table) {
    std::vector<std::vector<Matrix>*> lists;
    for (const std::string& title : table.columns) {
      std::vector<Matrix>* list = nullptr;
      for (const SampledMatrix& named : sampled_matrices()) {
        if (title == named.name) list = &(result_.samples.*named.samples);
      }
      if (list == nullptr)
        throw InputError(table.path + ": column '" + printable(title) + "': expected M, C, K, E or A");
      if (std::ranges::find(lists, list) != lists.end())
        throw InputError(table.path + ": has two columns " + title);
      lists.push_back(list);
    }
    return lists;
  }

  /// Samples are interpolated entry by entry, as dense matrices.
  static Matrix dense_sample(const std::string& file) {
    const SystemMatrix matrix = parse_market_file(read_text_file(file), file);
    if (std::max(matrix.rows(), matrix.cols()) > limits::matrix_rows)
      throw InputError(file + ": the matrix is " + size_text(matrix) + "; samples have at most " +
                       std::to_string(limits::matrix_rows) +
                       " rows. Larger models come as powers of the parameter: M0.mtx, K0.mtx, K2.mtx");
    return matrix.dense();
  }

  void read_table(const FileTable& table) {
    refuse_options({"from", "to"}, "the table has the values of the parameter");
    const std::vector<std::vector<Matrix>*> lists = columns_of(table);
    SampledData& data = result_.samples;
    result_.title = std::filesystem::path(table.path).stem().string();
    result_.parameter = parameter_option(request_, table.parameter);
    data.values = table.values;
    data.parameter_unit = request_.option("unit", table.unit);
    for (std::size_t row = 0; row < table.values.size(); ++row) {
      for (std::size_t i = 0; i < lists.size(); ++i) {
        const std::string& file = table.files[row][i];
        const bool same = row > 0 && table.files[row - 1][i] == file;
        Matrix matrix = same ? lists[i]->back() : dense_sample(file);
        const Eigen::Index n = data.size() == 0 ? matrix.cols() : data.size();
        if (matrix.rows() != n || matrix.cols() != n)
          throw InputError(file + ": the matrix is " + size_text(matrix) + "; expected " + std::to_string(n) +
                           " x " + std::to_string(n) +
                           (data.size() == 0 ? "" : ", as in " + table.files[0][0]));
        count(file, static_cast<std::size_t>(matrix.size()));
        lists[i]->push_back(std::move(matrix));
      }
    }
    result_.understood.push_back(count_of(data.count(), "sample") + ", " + std::to_string(data.size()) +
                                 " states");
    data.state_names = state_names(data.size());
    finish_samples(result_, request_, table.path);
  }

  const ImportRequest& request_;
  std::size_t numbers_ = 0;
  Imported result_;
};

}  // namespace

Importer matrix_market_importer() {
  return {
      "matrix-market",
      "matrices from files of the Matrix Market (.mtx)",
      {{"M0.mtx, K0.mtx, K2.mtx", "coefficients of the powers of the parameter in M, C and K, or in E and A"},
       {"a table (.csv) with titles such as wind_speed [m/s],A,E",
        "samples: each row has a value of the parameter and the files of its matrices"},
       {"coordinate", "the other entries are zero; entries that are given twice are added"},
       {"array", "all entries, column by column"},
       {"real, integer, pattern", "numbers, or ones"},
       {"complex", "only if all imaginary parts are zero"},
       {"general, symmetric, skew-symmetric, hermitian", "one triangle stands for both"}},
      {{"parameter", "name of the parameter; default: p, or the title of the table's first column"},
       {"unit", "unit of the parameter, such as \"m/s\""},
       {"from", "powers: begin of its range; default 0"},
       {"to", "powers: end of its range; default 1"},
       {"state-names", "text file with one name per line"},
       digits_help()},
      [](const ImportRequest& request) { return MarketImport(request).read(); }};
}

}  // namespace eigentrail
