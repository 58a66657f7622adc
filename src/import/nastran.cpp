// Mass, damping and stiffness of Nastran from files of OUTPUT4 (.op4), or from DMIG in punch files (.pch):
// one operating point, or one per file.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <stdexcept>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "import/dmig.hpp"
#include "import/file_table.hpp"
#include "import/formats.hpp"
#include "import/op4.hpp"
#include "import/samples.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {
namespace {

constexpr int digits_of_single = 7;
constexpr int digits_of_double = 16;

struct Role {
  char letter;         ///< with which Nastran's names begin
  const char* option;  ///< that names the matrix
  std::vector<Matrix> SampledData::*samples;
};
const std::array<Role, 3> roles{
    {{'M', "mass", &SampledData::M}, {'B', "damping", &SampledData::C}, {'K', "stiffness", &SampledData::K}}};

/// A matrix of either kind of file.
struct NastranMatrix : DmigMatrix {
  std::string file;
  bool from_bulk = false;  ///< it is DMIG
};

/// The matrix of each role; null: none.
using Chosen = std::array<const NastranMatrix*, roles.size()>;

/// The matrices of one operating point.
struct PointFiles {
  std::vector<std::string> files;
  double value = 0.0;
};

class NastranImport {
 public:
  explicit NastranImport(const ImportRequest& request) : request_(request) {}

  Imported read() {
    SampledData& data = result_.samples;
    const std::vector<PointFiles> points = operating_points();
    for (const PointFiles& point : points) {
      data.values.push_back(point.value);
      add_sample(point);
    }
    finish(points);
    return std::move(result_);
  }

 private:
  std::vector<PointFiles> operating_points() {
    const std::vector<std::string>& files = request_.files;
    std::string parameter = "p", unit;
    std::vector<PointFiles> points;
    if (std::ranges::any_of(files, is_file_table)) {
      if (files.size() > 1 || request_.options.contains("values"))
        throw InputError("nastran: expected one table (.csv), or files of matrices and --values");
      const FileTable table = parse_file_table(read_text_file(files[0]), files[0]);
      parameter = table.parameter;
      unit = table.unit;
      for (std::size_t i = 0; i < table.values.size(); ++i)
        points.push_back({table.files[i], table.values[i]});
    } else if (request_.options.contains("values")) {
      const std::vector<double> values = listed_values();
      if (values.size() != files.size())
        throw InputError("--values: has " + std::to_string(values.size()) + " numbers for " +
                         std::to_string(files.size()) + " files; expected one for each");
      for (std::size_t i = 0; i < files.size(); ++i) points.push_back({{files[i]}, values[i]});
    } else {
      points.push_back({files, 0.0});
    }
    result_.title = std::filesystem::path(files[0]).stem().string();
    result_.parameter = parameter_option(request_, parameter);
    result_.samples.parameter_unit = request_.option("unit", unit);
    return points;
  }

  std::vector<double> listed_values() const {
    std::vector<double> values;
    const std::string text = request_.option("values");
    for (const std::string& part : split(text, ',')) {
      const auto value = number_of(trimmed(part));
      if (!value || !std::isfinite(*value))
        throw InputError("--values: expected numbers separated by commas, found '" + printable(text) + "'");
      if (std::ranges::find(values, *value) != values.end())
        throw InputError("--values: has " + exact_text(*value) + " twice");
      values.push_back(*value);
      if (values.size() > limits::samples)
        throw InputError("--values: more than " + std::to_string(limits::samples) + " numbers");
    }
    return values;
  }

  /// Whether a matrix may have a role: the name that the option says or, without one, the first letter. K4...
  /// is structural damping, which belongs to responses at one frequency.
  bool may_be(const Role& role, const std::string& name) const {
    const auto asked = request_.options.find(role.option);
    if (asked != request_.options.end()) return equal_words(asked->second, name);
    return !name.empty() && std::toupper(static_cast<unsigned char>(name[0])) == role.letter &&
           !name.starts_with("K4");
  }

  bool wanted(const std::string& name) const {
    return std::ranges::any_of(roles, [&](const Role& role) { return may_be(role, name); });
  }

  std::vector<NastranMatrix> matrices_in(const std::string& file) const {
    const std::string bytes = read_text_file(file);
    std::vector<NastranMatrix> result;
    const std::string_view begin = std::string_view(bytes).substr(0, 16);
    const bool binary = begin.find('\0') != std::string_view::npos;
    const bool op4 = binary || equal_words(std::filesystem::path(file).extension().string(), ".op4");
    if (op4) {
      for (Op4Matrix& one : parse_op4(bytes, file, [this](const std::string& name) { return wanted(name); }))
        result.push_back({{std::move(one)}, file});
      return result;
    }
    for (DmigMatrix& one : parse_dmig(bytes, file)) result.push_back({std::move(one), file, true});
    if (result.empty())
      throw InputError(file +
                       ": has no matrices: no entries DMIG; files of OUTPUT4 are known by their name, .op4");
    return result;
  }

  /// The matrix of a role, or none.
  const NastranMatrix* chosen(const std::vector<NastranMatrix>& all, const Role& role) const {
    const NastranMatrix* result = nullptr;
    for (const NastranMatrix& one : all) {
      if (!may_be(role, one.name)) continue;
      if (result != nullptr)
        throw InputError(
            one.file + ": the " + role.option + " may be " + printable(result->name) +
            (result->file == one.file ? "" : " of " + result->file) + " or " + printable(one.name) +
            (equal_words(result->name, one.name) ? "; files of one operating point have each matrix once"
                                                 : "; name it with --" + std::string(role.option)));
      result = &one;
    }
    const std::string asked = request_.option(role.option);
    if (result == nullptr && !asked.empty() && asked != "none")
      throw InputError(all.front().file + ": --" + role.option + ": no matrix '" + printable(asked) + "'; " +
                       names_of(all));
    if (result != nullptr && !result->fault.empty())
      throw InputError(result->file + ": matrix " + printable(result->name) + " " + result->fault);
    return result;
  }

  static std::string names_of(const std::vector<NastranMatrix>& all) {
    constexpr std::size_t most = 20;
    const auto name = [](const NastranMatrix& one) { return printable(one.name); };
    return "found " + joined(first_items(all, most), ", ", name) + (all.size() > most ? ", ..." : "");
  }

  void add_sample(const PointFiles& point) {
    std::vector<NastranMatrix> all;
    for (const std::string& file : point.files) {
      for (NastranMatrix& one : matrices_in(file)) all.push_back(std::move(one));
    }
    Chosen own{};
    for (std::size_t i = 0; i < roles.size(); ++i) own[i] = chosen(all, roles[i]);
    if (own[2] == nullptr || (own[0] == nullptr && own[1] == nullptr))
      throw InputError(all.front().file + ": no " + (own[2] == nullptr ? "stiffness" : "mass") + "; " +
                       names_of(all) +
                       "; the name of a matrix may be given by --mass, --damping and --stiffness");
    note(all, own);
    check_kinds(own);
    own[2]->from_bulk ? add_bulk(own, point.files[0]) : add_dense(own);
    SampledData& data = result_.samples;
    for (std::size_t i = 0; i < roles.size(); ++i) {
      const std::size_t count = (data.*roles[i].samples).size();
      if (count != 0 && count != data.values.size())
        throw InputError(point.files[0] + ": " + (own[i] == nullptr ? "has no " : "has a ") +
                         roles[i].option + " matrix, unlike " + first_file_ +
                         "; all operating points need the same matrices");
    }
  }

  /// Keeps what is to be said, from the first operating point.
  void note(const std::vector<NastranMatrix>& all, const Chosen& own) {
    for (const NastranMatrix* one : own) {
      if (one == nullptr) continue;
      digits_ = std::min(digits_, one->digits);
      single_ = single_ || one->single;
    }
    if (!first_file_.empty()) return;
    first_file_ = all.front().file;
    for (std::size_t i = 0; i < roles.size(); ++i) {
      if (own[i] != nullptr) result_.understood.push_back(std::string(roles[i].option) + " " + own[i]->name);
    }
    std::string others;
    for (const NastranMatrix& one : all) {
      if (std::ranges::find(own, &one) == own.end()) others += (others.empty() ? "" : ", ") + one.name;
      if (one.name.starts_with("K4"))
        result_.warnings.push_back(one.name + " is structural damping, which is not read");
    }
    if (!others.empty()) result_.understood.push_back("not read: " + others);
  }

  static void check_kinds(const Chosen& own) {
    for (const NastranMatrix* one : own) {
      if (one != nullptr && one->from_bulk != own[2]->from_bulk)
        throw InputError(one->file + ": matrix " + printable(one->name) + " and " + printable(own[2]->name) +
                         " of " + own[2]->file +
                         " are DMIG and OUTPUT4; the order of their rows cannot be compared");
    }
  }

  /// Counts the numbers before they are stored.
  void count(const std::string& file, std::size_t rows) {
    numbers_ += rows * rows;
    if (numbers_ > limits::matrix_numbers)
      throw InputError(file + ": more than " + std::to_string(limits::matrix_numbers) +
                       " numbers in all matrices together");
  }

  void add_dense(const Chosen& own) {
    SampledData& data = result_.samples;
    for (std::size_t i = 0; i < roles.size(); ++i) {
      if (own[i] == nullptr) continue;
      const Matrix& values = own[i]->values;
      const Eigen::Index n = data.size() == 0 ? values.rows() : data.size();
      if (values.rows() != n)
        throw InputError(own[i]->file + ": matrix " + printable(own[i]->name) + " has " +
                         std::to_string(values.rows()) + " rows; expected " + std::to_string(n) + ", as in " +
                         first_file_);
      count(own[i]->file, static_cast<std::size_t>(n));
      (data.*roles[i].samples).push_back(values);
    }
  }

  /// Rows and columns are the points and components of all matrices, in ascending order.
  void add_bulk(const Chosen& own, const std::string& file) {
    std::vector<DmigFreedom> freedoms;
    for (const NastranMatrix* one : own) {
      if (one == nullptr) continue;
      for (const DmigEntry& entry : one->entries) {
        freedoms.push_back(entry.row);
        freedoms.push_back(entry.column);
      }
    }
    std::ranges::sort(freedoms);
    freedoms.erase(std::unique(freedoms.begin(), freedoms.end()), freedoms.end());
    if (freedoms.empty()) throw InputError(file + ": the matrices have no entries");
    if (freedoms.size() > limits::matrix_rows)
      throw InputError(file + ": the matrices have " + std::to_string(freedoms.size()) +
                       " rows; matrices of up to " + std::to_string(limits::matrix_rows) +
                       " rows can be imported");
    SampledData& data = result_.samples;
    if (freedoms_.empty()) {
      freedoms_ = freedoms;
      for (const DmigFreedom& one : freedoms) data.state_names.push_back(name_of(one));
    } else {
      check_freedoms(freedoms, file);
    }
    for (std::size_t i = 0; i < roles.size(); ++i) {
      if (own[i] == nullptr) continue;
      count(own[i]->file, freedoms.size());
      try {
        (data.*roles[i].samples).push_back(dense_matrix(*own[i], freedoms));
      } catch (const std::invalid_argument& error) {
        throw InputError(own[i]->file + ": " + error.what());
      }
    }
  }

  void check_freedoms(const std::vector<DmigFreedom>& own, const std::string& file) const {
    for (const bool missing : {true, false}) {
      const std::vector<DmigFreedom>& expected = missing ? freedoms_ : own;
      const std::vector<DmigFreedom>& found = missing ? own : freedoms_;
      std::vector<DmigFreedom> difference;
      std::set_difference(expected.begin(), expected.end(), found.begin(), found.end(),
                          std::back_inserter(difference));
      if (difference.empty()) continue;
      throw InputError(file + (missing ? ": lacks " : ": has ") + name_of(difference.front()) +
                       (missing ? ", which " + first_file_ + " has" : ", which " + first_file_ + " lacks") +
                       "; all operating points need the same rows");
    }
  }

  void finish(const std::vector<PointFiles>& points) {
    result_.understood.insert(result_.understood.begin(), count_of(points.size(), "operating point") + ", " +
                                                              std::to_string(result_.samples.size()) +
                                                              " states");
    // What a program has printed has many digits; few of them are what somebody has typed.
    std::optional<int> known;
    if (digits_ >= digits_of_single && digits_ < digits_of_double) known = digits_;
    if (single_) known = digits_of_single;
    finish_samples(result_, request_, first_file_, known);
  }

  const ImportRequest& request_;
  std::string first_file_;
  std::vector<DmigFreedom> freedoms_;  ///< rows of DMIG
  int digits_ = 17;
  bool single_ = false;
  std::size_t numbers_ = 0;
  Imported result_;
};

}  // namespace

Importer nastran_importer() {
  return {
      "nastran",
      "mass, damping and stiffness from Nastran (.op4, .pch)",
      {{"OUTPUT4 (.op4)", "text or binary, dense or sparse, single or double precision, any order of bytes"},
       {"DMIG in other files, such as .pch",
        "small, large or free fields; square or symmetric; states are named by point and component"},
       {"MAA, M2GG, ...; BAA, ...; KAA, ...",
        "mass, damping, stiffness: M x'' + B x' + K x = 0; options say which if there are several"},
       {"several files", "together one operating point, or one each with --values"},
       {"a table (.csv) with titles such as speed [rpm],file",
        "operating points: each row has a value of the parameter and one or more files"},
       {"K4AA, ...", "structural damping, not read"},
       {"complex matrices, loads", "not read"}},
      {{"mass", "name of the mass matrix, or none"},
       {"damping", "name of the matrix of viscous damping, or none"},
       {"stiffness", "name of the stiffness matrix"},
       {"parameter", "name of the parameter; default: p, or the title of the table's first column"},
       {"unit", "unit of the parameter, such as \"rpm\""},
       {"values", "values of the parameter, one per file, such as 0,100,200"},
       digits_help()},
      [](const ImportRequest& request) { return NastranImport(request).read(); }};
}

}  // namespace eigentrail
