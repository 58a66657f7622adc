#include "import/named_arrays.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "import/openfast_states.hpp"
#include "import/samples.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {
namespace {

std::string shape_text(const std::vector<std::size_t>& shape) {
  if (shape.empty()) return "a single number";
  return joined(shape, " x ", [](std::size_t extent) { return std::to_string(extent); });
}

/// An array of two dimensions, or sample `i` along `axis` of one of three.
Matrix matrix_of(const NamedArray& array, std::size_t axis = 2, std::size_t i = 0) {
  const std::size_t row = axis == 0 ? 1 : 0, column = axis == 2 ? 1 : 2;
  const std::size_t begin = i == 0 ? 0 : i * array.strides[axis];
  Matrix result(array.shape[row], array.shape[column]);
  for (std::size_t r = 0; r < array.shape[row]; ++r) {
    for (std::size_t c = 0; c < array.shape[column]; ++c) {
      result(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
          array.numbers[begin + r * array.strides[row] + c * array.strides[column]];
    }
  }
  return result;
}

/// Arrays that differ by a number at the end of their names, A00, A01, ..., by number.
using Family = std::map<long, const NamedArray*>;

class ArrayReader {
 public:
  ArrayReader(const std::vector<NamedArray>& arrays, const ImportRequest& request, bool samples_first)
      : arrays_(arrays), request_(request), samples_first_(samples_first) {
    find_families();
  }

  Imported read() {
    result_.title = std::filesystem::path(request_.files.front()).stem().string();
    read_matrices();
    read_parameter();
    repeat_constants();
    read_states();
    SampledData& data = result_.samples;
    const std::string digits = note_digits(data, request_.options);
    data.source = result_.title + ", " + std::to_string(data.count()) + " samples";
    try {
      check(data);
      match_states(data, names_per_sample_);
    } catch (const std::invalid_argument& error) {
      fail(error.what());
    }
    read_gyroscopic();
    describe();
    if (!digits.empty() && !result_.family) result_.understood.push_back(digits);
    list_others();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(request_.files.front() + ": " + message);
  }

  const NamedArray* find(const std::string& name) const {
    const auto found = std::ranges::find(arrays_, name, &NamedArray::name);
    return found == arrays_.end() ? nullptr : &*found;
  }

  /// The same for an array that becomes part of the model; the others are listed.
  const NamedArray* take(const std::string& name) {
    const NamedArray* array = find(name);
    if (array != nullptr) taken_.insert(name);
    return array;
  }

  const Family* find_family(const std::string& stem) const {
    const auto found = families_.find(stem);
    return found == families_.end() ? nullptr : &found->second;
  }

  void find_families() {
    for (const NamedArray& array : arrays_) {
      const std::size_t end = array.name.find_last_not_of("0123456789");
      const std::string digits = end == std::string::npos ? "" : array.name.substr(end + 1);
      constexpr std::size_t most_digits = 9;
      if (digits.empty() || digits.size() > most_digits) continue;
      std::string stem = array.name.substr(0, end + 1);
      if (stem.size() > 1 && stem.back() == '_') stem.pop_back();
      families_[stem][std::stol(digits)] = &array;
    }
  }

  /// The samples of one matrix; empty if it is absent.
  std::vector<Matrix> matrices(const std::string& name) {
    if (const NamedArray* array = take(name)) return from_array(*array);
    const Family* family = find_family(name);
    std::vector<Matrix> result;
    if (family == nullptr) return result;
    for (const auto& [number, member] : *family) {
      taken_.insert(member->name);
      std::vector<Matrix> one = from_array(*member);
      if (one.size() != 1)
        fail("array " + member->name + " is " + shape_text(member->shape) + "; expected n x n");
      result.push_back(std::move(one[0]));
    }
    return result;
  }

  std::vector<Matrix> from_array(const NamedArray& array) const {
    const std::vector<std::size_t>& shape = array.shape;
    const bool plane = shape.size() == 2 && shape[0] == shape[1];
    const bool first = shape.size() == 3 && shape[1] == shape[2];
    const bool last = shape.size() == 3 && shape[0] == shape[1];
    if (array.is_text || (!plane && !first && !last))
      fail("array " + array.name + " is " + (array.is_text ? "text" : shape_text(shape)) +
           "; expected a matrix n x n, or samples " + (samples_first_ ? "k x n x n" : "n x n x k"));
    if (array.size() == 0) fail("array " + array.name + " is " + shape_text(shape) + ", without entries");
    const bool samples_first = first && (!last || samples_first_);
    const std::size_t rows = samples_first ? shape[1] : shape[0];
    const std::size_t count = plane ? 1 : samples_first ? shape[0] : shape[2];
    if (rows > limits::matrix_rows || count > limits::samples)
      fail("array " + array.name + " is " + shape_text(shape) + "; at most " +
           std::to_string(limits::matrix_rows) + " rows and " + std::to_string(limits::samples) +
           " samples are read");
    if (plane) return {matrix_of(array)};
    std::vector<Matrix> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(matrix_of(array, samples_first ? 0 : 2, i));
    return result;
  }

  void read_matrices() {
    SampledData& data = result_.samples;
    const bool state_space = find("A") != nullptr || find_family("A") != nullptr;
    for (const SampledMatrix& named : sampled_matrices()) {
      // Beside A, C holds the outputs of a state-space model.
      if (state_space && named.name == std::string("C")) continue;
      data.*named.samples = matrices(named.name);
      samples_ = std::max(samples_, (data.*named.samples).size());
    }
    data.A_error = matrices("A_error");
    if (samples_ > 0) return;
    const std::string list = joined(first_items(arrays_, 20), ", ", &NamedArray::name);
    fail("no matrices: expected arrays A (and E), or K with M or C; found " + (list.empty() ? "none" : list));
  }

  /// Whether the model is of second order and has a gyroscopic matrix.
  bool is_gyroscopic() const {
    const SampledData& data = result_.samples;
    return !data.K.empty() && data.A.empty() && (find("G") != nullptr || find_family("G") != nullptr);
  }

  /// The damping is C + speed G. One operating point becomes a family in the speed.
  void read_gyroscopic() {
    if (!is_gyroscopic()) return;
    const SampledData& data = result_.samples;
    const std::vector<Matrix> G = matrices("G");
    if (samples_ > 1 || G.size() > 1)
      fail("G, the gyroscopic matrix, is read of one operating point only; to samples add it: C + speed G");
    const Eigen::Index n = data.K[0].rows();
    PolynomialData& family = result_.family.emplace();
    if (!data.M.empty()) family.M = {data.M[0]};
    family.C = {data.C.empty() ? Matrix(Matrix::Zero(n, n)) : data.C[0], G[0]};
    family.K = {data.K[0]};
    family.state_names = data.state_names;
    family.parameter_unit = request_.option("unit", "rad/s");
    const bool named = data.values[0] != 0.0;
    if (named) family.to = data.values[0];
    if (!named) result_.parameter = "speed";
    result_.understood.push_back("G is the gyroscopic matrix: the damping is C + " + result_.parameter +
                                 " G, with " + result_.parameter + " in " + family.parameter_unit +
                                 "; trace has --from and --to for its range");
  }

  /// Says which arrays are no part of the model, and asks about those whose names differ from that of a
  /// matrix in their capitals only.
  void list_others() {
    std::string others;
    for (const NamedArray& array : arrays_) {
      if (taken_.contains(array.name)) continue;
      others += (others.empty() ? "" : ", ") + array.name;
      const std::string upper = upper_case(array.name);
      if (upper.size() == 1 && upper != array.name &&
          std::string_view("MCKGEA").find(upper) != std::string_view::npos)
        result_.warnings.push_back("array " + array.name + " is not read; did you mean " + upper + "?");
    }
    if (!others.empty()) result_.understood.push_back("not read: " + others);
  }

  /// A matrix that is given once holds for all samples.
  void repeat_constants() {
    SampledData& data = result_.samples;
    const auto repeat = [this](std::vector<Matrix>& list) {
      if (list.size() == 1) list.assign(samples_, list[0]);
    };
    for (const SampledMatrix& named : sampled_matrices()) repeat(data.*named.samples);
    repeat(data.A_error);
  }

  /// The numbers of an array or of numbered single ones, if there is one for each sample.
  std::optional<std::vector<double>> numbers_per_sample(const std::string& name) const {
    if (const NamedArray* array = find(name)) {
      const std::size_t longest = array->shape.empty() ? 1 : *std::ranges::max_element(array->shape);
      if (array->is_text || array->size() != samples_ || longest != samples_) return std::nullopt;
      return array->numbers;
    }
    const Family* family = find_family(name);
    if (family == nullptr || family->size() != samples_) return std::nullopt;
    std::vector<double> values;
    for (const auto& [number, member] : *family) {
      if (member->is_text || member->size() != 1) return std::nullopt;
      values.push_back(member->numbers[0]);
    }
    return values;
  }

  static bool describes_states(const std::string& name) {
    static const std::vector<std::string> names = {"state_names", "states",           "names", "state_units",
                                                   "units",       "derivative_order", "order", "frame"};
    return std::ranges::find(names, name) != names.end();
  }

  /// Arrays with one number per sample that rise or fall from sample to sample.
  std::vector<std::string> candidates() const {
    std::vector<std::string> names;
    for (const NamedArray& array : arrays_) names.push_back(array.name);
    for (const auto& [stem, family] : families_) names.push_back(stem);
    std::vector<std::string> result;
    for (const std::string& name : names) {
      const auto values = numbers_per_sample(name);
      const bool is_matrix =
          result_.samples.size() == 1 && name.size() == 1 && std::string("MCKEA").find(name) < 5;
      if (!values || is_matrix || describes_states(name)) continue;
      const auto all_are = [&](auto order) {
        return std::ranges::adjacent_find(*values, std::not_fn(order)) == values->end();
      };
      if (all_are(std::less<>()) || all_are(std::greater<>())) result.push_back(name);
    }
    return result;
  }

  void read_parameter() {
    std::string name = request_.option("parameter");
    if (name.empty()) name = chosen_parameter();
    if (name.empty()) {
      result_.parameter = "p";
      result_.samples.values = {0.0};
      if (!is_gyroscopic()) result_.understood.emplace_back("one sample, and no value of a parameter");
      return;
    }
    const auto values = numbers_per_sample(name);
    if (!values)
      fail("parameter '" + name + "': expected an array of " + std::to_string(samples_) +
           " numbers, one per sample" +
           (find(name) ? ", found " + shape_text(find(name)->shape) : "; " + suggestion(name, candidates())));
    result_.samples.values = *values;
    taken_.insert(name);
    if (const Family* numbered = find(name) == nullptr ? find_family(name) : nullptr)
      for (const auto& [number, member] : *numbered) taken_.insert(member->name);
    result_.parameter = is_identifier(name) && name != "parameter" ? name : "p";
    result_.samples.parameter_unit = request_.option("unit");
  }

  /// The array with the values of the parameter; empty if there is none and one sample.
  std::string chosen_parameter() const {
    if (numbers_per_sample("parameter")) return "parameter";
    const std::vector<std::string> found = candidates();
    if (samples_ == 1) return found.size() == 1 ? found[0] : "";
    if (found.size() == 1) return found[0];
    fail(found.empty() ? "no values of a parameter: expected an array 'parameter' of " +
                             std::to_string(samples_) + " numbers, one per sample" + nearly_a_parameter()
                       : "the parameter may be any of " + joined(found) + "; name it with --parameter");
  }

  /// What hinders arrays of one number per sample from being taken for the parameter; empty if there are
  /// none.
  std::string nearly_a_parameter() const {
    std::string text;
    for (const NamedArray& array : arrays_) {
      const auto values = numbers_per_sample(array.name);
      if (!values || array.shape.empty()) continue;
      std::vector<double> sorted = *values;
      std::ranges::sort(sorted);
      const auto twice = std::ranges::adjacent_find(sorted);
      text += "; array " + array.name +
              (twice != sorted.end()
                   ? " has the value " + exact_text(*twice) + " twice: leave one of the two samples out"
                   : " neither rises nor falls throughout: if it is the parameter, name it "
                     "with --parameter " +
                         array.name);
    }
    return text;
  }

  const NamedArray* texts(std::initializer_list<const char*> names) {
    for (const char* name : names) {
      const NamedArray* array = take(name);
      if (array == nullptr) continue;
      if (!array->is_text) fail(std::string(name) + ": expected texts, found numbers");
      return array;
    }
    return nullptr;
  }

  void read_states() {
    SampledData& data = result_.samples;
    const auto n = static_cast<std::size_t>(data.size());
    if (const NamedArray* names = texts({"state_names", "states", "names"})) {
      if (names->size() == n * samples_ && samples_ > 1 && names->shape.size() == 2)
        names_per_sample_ = rows_of_texts(*names, n);
      for (std::vector<std::string>& one : names_per_sample_) one = short_openfast_names(one);
      data.state_names =
          names_per_sample_.empty() ? short_openfast_names(names->texts) : names_per_sample_.front();
    }
    if (const NamedArray* units = texts({"state_units", "units"})) data.state_units = units->texts;
    for (const char* name : {"derivative_order", "order"}) {
      const NamedArray* orders = find(name);
      if (orders == nullptr || orders->is_text || orders->size() != n) continue;
      taken_.insert(name);
      for (const double order : orders->numbers) {
        if (order != 0.0 && order != 1.0 && order != 2.0)
          fail(std::string(name) + ": expected 0, 1 or 2 for each state, found " + exact_text(order));
        data.derivative_order.push_back(static_cast<int>(order));
      }
      break;
    }
    if (const NamedArray* frames = texts({"frame"})) {
      for (const std::string& frame : frames->texts) {
        if (frame != "fixed" && frame != "rotating")
          fail("frame: expected fixed or rotating for each state, found '" + printable(frame) + "'");
        data.state_frames.push_back(frame == "fixed" ? StateFrame::fixed : StateFrame::rotating);
      }
    }
  }

  /// Names k x n, one row per sample.
  std::vector<std::vector<std::string>> rows_of_texts(const NamedArray& array, std::size_t n) const {
    const bool rows = array.shape[0] == samples_ && array.shape[1] == n;
    std::vector<std::vector<std::string>> result(samples_, std::vector<std::string>(n));
    for (std::size_t i = 0; i < samples_; ++i) {
      for (std::size_t j = 0; j < n; ++j)
        result[i][j] = array.texts[(rows ? i : j) * array.strides[0] + (rows ? j : i) * array.strides[1]];
    }
    return result;
  }

  void describe() {
    const SampledData& data = result_.samples;
    const std::string matrices = matrices_in(data);
    const std::string size = std::to_string(data.size()) + " x " + std::to_string(data.size());
    const auto [least, most] = std::ranges::minmax_element(data.values);
    if (samples_ > 1 || *least != 0.0)
      result_.understood.push_back(count_of(samples_, "sample") + " of " + matrices + ", " + size + ", at " +
                                   result_.parameter + " = " + exact_text(*least) +
                                   (samples_ > 1 ? " to " + exact_text(*most) : "") +
                                   (data.parameter_unit.empty() ? "" : " " + data.parameter_unit));
    else
      result_.understood.push_back(matrices + ", " + size);
    if (!data.state_names.empty())
      result_.understood.push_back(std::to_string(data.size()) + " names of states");
  }

  const std::vector<NamedArray>& arrays_;
  const ImportRequest& request_;
  const bool samples_first_;
  std::map<std::string, Family> families_;  ///< by what their names begin with
  std::set<std::string> taken_;             ///< names of the arrays that are parts of the model
  std::vector<std::vector<std::string>> names_per_sample_;
  std::size_t samples_ = 0;
  Imported result_;
};

}  // namespace

std::map<std::string, std::string> array_options() {
  return {{"parameter", "array with the values of the parameter; default: the only one that fits"},
          {"unit", "unit of the parameter, such as \"m/s\""},
          digits_help()};
}

std::vector<ImportedItem> array_items(const std::string& cube) {
  return {{"A, E", "E x' = A x; " + cube + ", or n x n: the same for all samples"},
          {"M, C, K", "M x'' + C x' + K x = 0, likewise"},
          {"G", "of one operating point: the gyroscopic matrix, C + speed G"},
          {"A00, A01, ...", "the same, one array n x n per sample"},
          {"parameter",
           "its values, one per sample, or another array that is named by --parameter or is the "
           "only one that rises or falls throughout"},
          {"w00, w01, ...", "the same, one number per sample"},
          {"state_names, state_units", "n texts; names k x n: states are matched by name"},
          {"derivative_order", "2 or 1 for each state"},
          {"frame", "fixed or rotating for each state"},
          {"A_error", "bounds of the errors of the entries of A"}};
}

Imported from_arrays(const std::vector<NamedArray>& arrays, const ImportRequest& request,
                     bool samples_first) {
  return ArrayReader(arrays, request, samples_first).read();
}

}  // namespace eigentrail
