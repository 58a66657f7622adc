#include "eigentrail/model/sampled_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "core/hdf5_file.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "model/family_tables.hpp"
#include "model/sampled_family.hpp"

namespace eigentrail {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What users keep beside the matrices of the equations. The program does not read it.
const std::vector<std::string> kept = {"B", "D", "F", "x_op", "u_op", "y_op", "xdot_op", "kept"};

[[noreturn]] void fail(const std::string& message) {
  throw std::invalid_argument(message);
}

std::string plural(std::size_t count, const std::string& what) {
  const std::string many = what.ends_with('y') ? what.substr(0, what.size() - 1) + "ies" : what + "s";
  return std::to_string(count) + " " + (count == 1 ? what : many);
}

/// Whether a dataset is a list: of one dimension, or a row or column, as MATLAB has them.
bool is_list(const Shape& shape) {
  return shape.size() <= 1 || (shape.size() == 2 && (shape[0] == 1 || shape[1] == 1));
}

void check_samples(const std::string& name, const std::vector<Matrix>& list, std::size_t count,
                   Eigen::Index n) {
  if (list.empty()) return;
  if (list.size() != count)
    fail(name + " has " + plural(list.size(), "sample") + " for " + plural(count, "value") +
         " of the parameter");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string which = name + ", sample " + std::to_string(i + 1);
    if (list[i].rows() != n || list[i].cols() != n)
      fail(which + " is " + std::to_string(list[i].rows()) + " x " + std::to_string(list[i].cols()) +
           "; expected " + std::to_string(n) + " x " + std::to_string(n));
    if (!list[i].allFinite()) fail(which + " has an entry that is not finite");
  }
}

void check_A_error(const SampledData& data, Eigen::Index n) {
  if (data.A_error.empty()) return;
  if (!data.first_order()) fail("A_error without A");
  check_samples("A_error", data.A_error, data.count(), n);
  for (const Matrix& error : data.A_error) {
    if ((error.array() < 0).any()) fail("A_error has a negative entry; its entries are bounds of errors");
  }
}

void check_form(const SampledData& data) {
  const bool second_order = !data.M.empty() || !data.C.empty() || !data.K.empty();
  if (data.first_order() && second_order) fail("A belongs to E x' = A x and cannot stand beside M, C or K");
  if (!data.E.empty() && !data.first_order()) fail("E without A; the equations are E x' = A x");
  if (!data.first_order() && (data.K.empty() || (data.M.empty() && data.C.empty())))
    fail("expected A (and optionally E), or K with M, C or both");
}

void check_values(const std::vector<double>& values) {
  if (values.empty()) fail("parameter has no values");
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  for (const double value : sorted) {
    if (!std::isfinite(value)) fail("parameter has a value that is not finite");
  }
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice == sorted.end()) return;
  const auto first = std::find(values.begin(), values.end(), *twice);
  const auto second = std::find(first + 1, values.end(), *twice);
  fail("parameter has the value " + exact_text(*twice) + " twice, at samples " +
       std::to_string(first - values.begin() + 1) + " and " + std::to_string(second - values.begin() + 1) +
       "; leave one of them out");
}

void check_length(const auto& list, const char* name, Eigen::Index n) {
  if (!list.empty() && static_cast<Eigen::Index>(list.size()) != n)
    fail(std::string(name) + " has " + plural(list.size(), "entry") + "; expected " + std::to_string(n));
}

/// Brings the rows and columns of a sample in the order `from`: entry i of the result is state from[i].
void reorder(Matrix& matrix, const std::vector<Eigen::Index>& from) {
  matrix = matrix(from, from).eval();
}

/// For each of `names` its place in `own`; an error names the sample and a state that is not in both.
std::vector<Eigen::Index> places(const std::vector<std::string>& names, const std::vector<std::string>& own,
                                 std::size_t sample) {
  std::vector<Eigen::Index> result;
  for (const std::string& name : names) {
    const auto found = std::find(own.begin(), own.end(), name);
    if (found == own.end() || std::find(found + 1, own.end(), name) != own.end())
      fail("state_names: sample " + std::to_string(sample + 1) + " has " +
           (found == own.end() ? "no state '" : "more than one state '") + name +
           "'; samples are matched by the names of their states");
    result.push_back(found - own.begin());
  }
  return result;
}

class SampleReader {
 public:
  explicit SampleReader(const Hdf5File& file) : file_(file) {}

  SampledData read() {
    reject_unknown();
    read_values();
    const bool state_space = file_.has("/A");
    read_matrix_order();
    for (const SampledMatrix& named : sampled_matrices()) {
      // Beside A, a dataset C holds the outputs of a state-space model, which are kept and not read.
      if (state_space && named.name == std::string("C")) continue;
      if (file_.has("/" + std::string(named.name))) data_.*named.samples = read_matrices(named.name);
    }
    if (file_.has("/A_error")) data_.A_error = read_matrices("A_error");
    read_states();
    if (file_.has_attribute("digits")) data_.digits = static_cast<int>(file_.integer_attribute("digits"));
    if (file_.has_attribute("source")) data_.source = file_.text_attribute("source");
    check(data_);
    match_states(data_, names_);
    sort();
    return std::move(data_);
  }

 private:
  void reject_unknown() const {
    std::vector<std::string> known = {
        "parameter",        "M",    "C", "K", "E", "A", "A_error", "state_names", "state_units",
        "derivative_order", "frame"};
    known.insert(known.end(), kept.begin(), kept.end());
    if (const std::string fault = unknown_member(file_, known); !fault.empty()) fail(fault);
  }

  void read_matrix_order() {
    if (!file_.has_attribute("matrix_order")) return;
    const std::string order = file_.text_attribute("matrix_order");
    if (order != "rows" && order != "columns")
      fail(
          "attribute matrix_order: expected 'rows' or 'columns' (what the second index of k x n x n counts), "
          "found '" +
          order + "'");
    by_columns_ = order == "columns";
  }

  void read_values() {
    if (!file_.has("/parameter")) fail("no dataset /parameter with the values at which the matrices hold");
    const Shape shape = file_.shape("/parameter");
    if (!is_list(shape)) fail("parameter: expected a list of values");
    if (element_count(shape) > limits::samples)
      fail("parameter has more than " + std::to_string(limits::samples) + " values");
    data_.values = file_.read_real("/parameter");
    data_.parameter_unit = file_.text_attribute("/parameter", "units");
    data_.parameter_name = file_.text_attribute("/parameter", "name");
  }

  std::vector<Matrix> read_matrices(const std::string& name) {
    Shape shape = file_.shape("/" + name);
    // MATLAB drops the last dimension of n x n x 1.
    if (shape.size() == 2 && data_.count() == 1) shape.insert(shape.begin(), 1);
    if (shape.size() != 3 || shape[1] != shape[2] || shape[1] > limits::matrix_rows ||
        shape[0] > limits::samples)
      fail("dataset " + name + ": expected the shape samples x n x n with n up to " +
           std::to_string(limits::matrix_rows) + " and up to " + std::to_string(limits::samples) +
           " samples");
    numbers_ += shape[0] * shape[1] * shape[2];
    if (numbers_ > limits::matrix_numbers)
      fail("more than " + std::to_string(limits::matrix_numbers) + " numbers in all matrices together");
    const std::vector<double> all = file_.read_real("/" + name);
    const auto n = static_cast<Eigen::Index>(shape[1]);
    std::vector<Matrix> result;
    for (std::uint64_t i = 0; i < shape[0]; ++i) {
      const Eigen::Map<const RowMajor> rows(all.data() + static_cast<Eigen::Index>(i) * n * n, n, n);
      result.emplace_back(by_columns_ ? Matrix(rows.transpose()) : Matrix(rows));
    }
    return result;
  }

  void read_states() {
    if (file_.has("/state_names")) {
      Shape shape = file_.shape("/state_names");
      if (shape.empty() || shape.size() > 2) fail("state_names: expected n names, or n for each sample");
      const bool of_each = shape.size() == 2 && shape[0] == data_.count() &&
                           shape[1] == static_cast<std::uint64_t>(data_.size());
      if (is_list(shape) && !of_each) shape = {element_count(shape)};
      const std::vector<std::string> all = file_.read_texts("/state_names");
      const auto n = static_cast<std::ptrdiff_t>(shape.back());
      if (shape.size() == 2 && shape[0] != data_.count())
        fail("state_names has rows for " + plural(shape[0], "sample") + " of " +
             std::to_string(data_.count()));
      data_.state_names.assign(all.begin(), all.begin() + n);
      for (auto row = all.begin(); shape.size() == 2 && n > 0 && row != all.end(); row += n)
        names_.emplace_back(row, row + n);
    }
    if (file_.has("/state_units")) data_.state_units = file_.read_texts("/state_units");
    if (file_.has("/derivative_order")) {
      for (const std::int64_t order : file_.read_integers("/derivative_order")) {
        if (order < 0 || order > 2)
          fail("derivative_order: expected 0, 1 or 2, found " + std::to_string(order));
        data_.derivative_order.push_back(static_cast<int>(order));
      }
    }
    if (!file_.has("/frame")) return;
    for (const std::string& frame : file_.read_texts("/frame")) {
      if (frame != "fixed" && frame != "rotating")
        fail("frame: expected fixed or rotating, found '" + frame + "'");
      data_.state_frames.push_back(frame == "fixed" ? StateFrame::fixed : StateFrame::rotating);
    }
  }

  void sort() {
    std::vector<std::size_t> order(data_.count());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return data_.values[a] < data_.values[b]; });
    const auto sorted = [&order](auto list) {
      auto result = list;
      for (std::size_t i = 0; i < list.size(); ++i) result[i] = std::move(list[order[i]]);
      return result;
    };
    data_.values = sorted(data_.values);
    for (const SampledMatrix& named : sampled_matrices())
      data_.*named.samples = sorted(std::move(data_.*named.samples));
    data_.A_error = sorted(std::move(data_.A_error));
  }

  const Hdf5File& file_;
  bool by_columns_ = false;
  std::size_t numbers_ = 0;
  std::vector<std::vector<std::string>> names_;  ///< of the states of each sample; empty: one order for all
  SampledData data_;
};

}  // namespace

const std::array<SampledMatrix, 5>& sampled_matrices() {
  static constexpr std::array<SampledMatrix, 5> all{{{"M", &SampledData::M},
                                                     {"C", &SampledData::C},
                                                     {"K", &SampledData::K},
                                                     {"E", &SampledData::E},
                                                     {"A", &SampledData::A}}};
  return all;
}

Eigen::Index SampledData::size() const {
  for (const SampledMatrix& named : sampled_matrices()) {
    if (!(this->*named.samples).empty()) return (this->*named.samples).front().rows();
  }
  return 0;
}

void check(const SampledData& data) {
  check_values(data.values);
  check_form(data);
  const Eigen::Index n = data.size();
  if (n == 0) fail("the matrices have no rows");
  for (const SampledMatrix& named : sampled_matrices())
    check_samples(named.name, data.*named.samples, data.count(), n);
  check_A_error(data, n);
  check_length(data.state_names, "state_names", n);
  // Names tell states apart: in the loci file, and where samples have their states in different orders.
  if (const std::string fault = fault_of_names(data.state_names, n); !fault.empty())
    fail("state_names " + fault);
  check_length(data.state_units, "state_units", n);
  check_length(data.derivative_order, "derivative_order", n);
  check_length(data.state_frames, "frame", n);
  if (data.digits && (*data.digits < 1 || *data.digits > 17))
    fail("digits: expected 1 to 17, found " + std::to_string(*data.digits));
}

void match_states(SampledData& data, const std::vector<std::vector<std::string>>& names) {
  for (std::size_t i = 1; i < names.size(); ++i) {
    const auto from = places(names.front(), names[i], i);
    for (const SampledMatrix& named : sampled_matrices()) {
      if (!(data.*named.samples).empty()) reorder((data.*named.samples)[i], from);
    }
    if (!data.A_error.empty()) reorder(data.A_error[i], from);
  }
}

std::string outside_samples(const std::string& name, double value, const std::vector<double>& samples) {
  const double least = samples.front(), most = samples.back();
  const double slack = same_value * std::max(std::abs(least), std::abs(most));
  if (value >= least - slack && value <= most + slack) return "";
  const std::string what = name + " = " + exact_text(value) + " lies outside the samples";
  if (samples.size() == 1)
    return what + ": there is one, at " + exact_text(least) +
           "; 'eigentrail spectrum' shows its eigenvalues, a trace needs at least two samples";
  return what + ", which reach from " + exact_text(least) + " to " + exact_text(most) +
         "; choose values between them";
}

bool holds_samples(const std::string& path) {
  const Hdf5File file = Hdf5File::open(path);
  return file.has("/parameter") && !file.has_attribute("format");
}

SampledData read_samples(const std::string& path) {
  return read_samples(Hdf5File::open(path));
}

SampledData read_samples(const Hdf5File& file) {
  return SampleReader(file).read();
}

}  // namespace eigentrail
