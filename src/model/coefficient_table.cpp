#include "model/coefficient_table.hpp"

#include <algorithm>
#include <cmath>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "model/draft.hpp"
#include "model/sample_interpolation.hpp"

namespace eigentrail {
namespace {

void check_ascending(const CsvTable& csv, const std::vector<double>& values) {
  const CsvColumn& first = csv.columns.front();
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!(values[i] > values[i - 1]))
      throw InputError(csv.path + ":" + std::to_string(csv.lines[i]) + ": " + first.name +
                       " must ascend; found " + exact_text(first.values[i]) + " behind " +
                       exact_text(first.values[i - 1]));
  }
}

/// The columns as diagonal matrices of samples, for the choice of the interpolant.
SampledData samples_of(const std::vector<double>& nodes, const std::vector<std::vector<double>>& columns) {
  SampledData data;
  data.values = nodes;
  const auto n = static_cast<Eigen::Index>(columns.size());
  for (std::size_t row = 0; row < nodes.size(); ++row) {
    Matrix sample = Matrix::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) sample(i, i) = columns[static_cast<std::size_t>(i)][row];
    data.K.push_back(std::move(sample));
  }
  return data;
}

/// What the interpolant of all other rows misses at a row, over all inner rows, relative to the column.
double error_left_out(const SamplePiece& piece, const std::vector<double>& column) {
  const RationalInterpolant& interpolant = piece.interpolant;
  const std::vector<double>& nodes = interpolant.nodes();
  if (nodes.size() < 4) return std::nan("");
  double largest = 0.0, worst = 0.0;
  for (const double value : column) largest = std::max(largest, std::abs(value));
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
    const Vector missed = leave_one_out(nodes, interpolant.degree(), i,
                                        piece.without_one.empty() ? Denominator{} : piece.without_one[i]);
    double error = 0.0;
    for (std::size_t j = 0; j < nodes.size(); ++j) error += missed[static_cast<Eigen::Index>(j)] * column[j];
    worst = std::max(worst, std::abs(error));
  }
  return largest > 0.0 ? worst / largest : 0.0;
}

/// Checks the size of the table and the names of its columns.
void check_columns(const CsvTable& csv, const TableColumns& columns) {
  const std::vector<std::string> known = names_of(columns.known);
  const std::string& first = csv.columns.front().name;
  if (std::find(known.begin(), known.end(), first) != known.end())
    throw InputError(csv.path + ": the first column is " + columns.argument + "; found '" + first + "'");
  if (csv.columns.size() < 2)
    throw InputError(csv.path + ": has no column of a coefficient, such as " + known.front());
  for (std::size_t i = 1; i < csv.columns.size(); ++i) {
    const std::string& name = csv.columns[i].name;
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(csv.path + ": unknown column '" + name + "'; " + suggestion(name, known));
  }
  if (csv.rows() > limits::samples)
    throw InputError(csv.path + ": has " + std::to_string(csv.rows()) + " rows; at most " +
                     std::to_string(limits::samples) + " are read");
  if (csv.rows() < 2) throw InputError(csv.path + ": has one row; expected two at least");
}

std::vector<std::vector<double>> coefficients_of(const CsvTable& csv, const TableColumns& columns) {
  std::vector<std::vector<double>> coefficients;
  for (std::size_t i = 1; i < csv.columns.size(); ++i) {
    const auto known = std::find_if(columns.known.begin(), columns.known.end(),
                                    [&](const KnownColumn& one) { return one.name == csv.columns[i].name; });
    coefficients.push_back(si_values(csv, csv.columns[i], known->unit));
  }
  return coefficients;
}

CoefficientTable tabulate(const CsvTable& csv, const Expression& argument, const TableColumns& known) {
  check_columns(csv, known);
  const CsvColumn& first = csv.columns.front();
  CoefficientTable table;
  table.path = csv.path;
  table.argument = argument;
  table.first_name = first.name;
  table.first_unit = first.unit;
  table.factor = si_factor(csv, first, known.unit.empty() ? WantedUnit() : WantedUnit(known.unit));
  std::vector<double> nodes = first.values;
  for (double& node : nodes) node *= table.factor;
  check_ascending(csv, nodes);
  const std::vector<std::vector<double>> columns = coefficients_of(csv, known);
  std::optional<int> degree = known.degree;
  if (degree) degree = std::min(*degree, static_cast<int>(nodes.size()) - 1);
  std::vector<SamplePiece> pieces = interpolate_samples(samples_of(nodes, columns), nodes, {}, degree);
  table.piece = std::make_shared<const SamplePiece>(std::move(pieces.front()));
  table.error = std::nan("");
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const double error = error_left_out(*table.piece, columns[i]);
    if (!(error <= table.error)) {
      table.error = error;
      table.worst = csv.columns[i + 1].name;
    }
    table.columns[csv.columns[i + 1].name] =
        std::make_shared<const TabulatedFactor>(table.piece, columns[i], known.exact);
  }
  return table;
}

}  // namespace

std::shared_ptr<const TabulatedFactor> CoefficientTable::find(const std::string& key) const {
  const auto found = columns.find(key);
  return found == columns.end() ? nullptr : found->second;
}

std::string CoefficientTable::outside(double at) const {
  const std::vector<double>& nodes = piece->interpolant.nodes();
  const double slack = 1e-12 * (nodes.back() - nodes.front());
  if (at >= nodes.front() - slack && at <= nodes.back() + slack) return "";
  const std::string unit = first_unit.empty() ? "" : " " + first_unit;
  return "its rows go from " + first_name + " = " + exact_text(nodes.front() / factor) + " to " +
         exact_text(nodes.back() / factor) + unit + ", and nothing is extrapolated; " + first_name + " is " +
         exact_text(at / factor) + unit;
}

std::string CoefficientTable::in_words() const {
  const std::vector<double>& nodes = piece->interpolant.nodes();
  std::string text = "table of " + std::to_string(nodes.size()) + " rows, " + first_name + " = " +
                     short_text(nodes.front() / factor, 3) + " to " + short_text(nodes.back() / factor, 3) +
                     (first_unit.empty() ? "" : " " + first_unit) + ", interpolant of degree " +
                     std::to_string(piece->interpolant.degree());
  if (columns.begin()->second->is_exact()) return text + ", taken as exact";
  if (std::isnan(error)) return text + "; too few rows to tell its error";
  return text + "; a row that is left out is missed by " + short_text(error, 3) + " of the largest " + worst +
         " at most";
}

CoefficientTable read_coefficient_table(const Scene& scene, TableReader& table, const std::string& key,
                                        const Expression& argument, const TableColumns& columns) {
  return read_csv(scene, table, key, [&](const CsvTable& csv) { return tabulate(csv, argument, columns); });
}

}  // namespace eigentrail
